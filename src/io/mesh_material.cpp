// SPDX-License-Identifier: MIT
#include "sateen/io/mesh_material.h"

#include <charconv>

#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "sateen/io/image_memory.h"

namespace sateen::io {
namespace {

namespace fs = std::filesystem;

// An embedded picture as data. assimp keeps compressed files as bytes (height 0) and raw pixels as BGRA
// texels.
Image embedded(const aiTexture& texture, const std::string& name) {
  if (texture.mHeight == 0) {
    return read_data_from_memory({reinterpret_cast<const std::byte*>(texture.pcData), texture.mWidth}, name);
  }
  Image image(static_cast<int>(texture.mWidth), static_cast<int>(texture.mHeight), 4);
  for (std::size_t i = 0; i < image.data.size() / 4; ++i) {
    const aiTexel& texel = texture.pcData[i];
    const unsigned char values[4] = {texel.r, texel.g, texel.b, texel.a};
    for (std::size_t c = 0; c < 4; ++c) image.data[4 * i + c] = static_cast<float>(values[c]) / 255;
  }
  return image;
}

// One texture of a material, with its texture transform turned to v up (which assimp has done already).
Image read_texture(const aiScene& scene, const aiMaterial& material, aiTextureType type, const fs::path& path,
                   Vec2f& scale, Vec2f& offset) {
  aiString name;
  unsigned int uv_set = 0;
  if (material.GetTexture(type, 0, &name, nullptr, &uv_set) != aiReturn_SUCCESS || uv_set != 0) return {};
  aiUVTransform transform;
  if (material.Get(AI_MATKEY_UVTRANSFORM(type, 0), transform) == aiReturn_SUCCESS) {
    scale = {transform.mScaling.x, transform.mScaling.y};
    offset = {transform.mTranslation.x, transform.mTranslation.y};
  }
  if (const aiTexture* texture = scene.GetEmbeddedTexture(name.C_Str())) {
    return embedded(*texture, fmt::format("{}: embedded picture '{}'", path.string(), name.C_Str()));
  }
  return read_data(path.parent_path() / decoded_uri(name.C_Str()));
}

}  // namespace

std::string decoded_uri(const std::string& uri) {
  std::string result;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned int code = 0;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(uri.data() + i + 1, uri.data() + i + 3, code, 16).ptr == uri.data() + i + 3) {
      result += static_cast<char>(code);
      i += 2;
    } else {
      result += uri[i];
    }
  }
  return result;
}

MeshMaterial read_material(const aiScene& scene, const aiMaterial& material, const fs::path& path) {
  MeshMaterial result;
  aiString name;
  if (material.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) result.name = name.C_Str();
  const std::string extension = extension_of(path);
  if (extension != ".glb" && extension != ".gltf") return result;
  result.normal_map = read_texture(scene, material, aiTextureType_NORMALS, path, result.normal_uv_scale,
                                   result.normal_uv_offset);
  // assimp files glTF's occlusion texture under light maps.
  result.occlusion_map = read_texture(scene, material, aiTextureType_LIGHTMAP, path,
                                      result.occlusion_uv_scale, result.occlusion_uv_offset);
  return result;
}

}  // namespace sateen::io
