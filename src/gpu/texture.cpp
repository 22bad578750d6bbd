// SPDX-License-Identifier: MIT
#include "sateen/gpu/texture.h"

#include <algorithm>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "sateen/core/error.h"

namespace sateen::gpu {
namespace {

struct GlFormat {
  GLint internal;
  GLenum format;
  GLenum type;
  std::size_t bytes;  ///< a texel
};

GlFormat gl_format(TextureData::Format format) {
  switch (format) {
    case TextureData::Format::rgba8:
      return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4};
    case TextureData::Format::srgba8:
      return {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, 4};
    case TextureData::Format::rgba16f:
      return {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, 8};
    case TextureData::Format::rgba32f:
      return {GL_RGBA32F, GL_RGBA, GL_FLOAT, 16};
    case TextureData::Format::rg16f:
      return {GL_RG16F, GL_RG, GL_HALF_FLOAT, 4};
  }
  throw Error("unknown texture format");
}

GLenum gl_target(TextureData::Shape shape) {
  switch (shape) {
    case TextureData::Shape::image_2d:
      return GL_TEXTURE_2D;
    case TextureData::Shape::volume_3d:
      return GL_TEXTURE_3D;
    case TextureData::Shape::array_2d:
      return GL_TEXTURE_2D_ARRAY;
    case TextureData::Shape::cube:
      return GL_TEXTURE_CUBE_MAP;
  }
  throw Error("unknown texture shape");
}

GLint gl_wrap(TextureData::Wrap wrap) {
  return wrap == TextureData::Wrap::repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE;
}

void check_limits(const TextureData& data) {
  GLint flat = 0;
  GLint volume = 0;
  GLint layers = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &flat);
  glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &volume);
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
  const bool is_volume = data.shape == TextureData::Shape::volume_3d;
  const int side = is_volume ? volume : flat;
  const int depth = is_volume ? volume : layers;
  if (data.width < 1 || data.height < 1 || data.depth < 1 || data.width > side || data.height > side ||
      data.depth > depth) {
    throw Error(
        fmt::format("a texture of {} x {} x {} texels is more than this OpenGL driver takes ({} x {} x {})",
                    data.width, data.height, data.depth, side, side, depth));
  }
}

}  // namespace

Texture::Texture(const TextureData& data) : target_(gl_target(data.shape)) {
  check_limits(data);
  GLuint name = 0;
  glGenTextures(1, &name);
  handle_ = Handle(name, [](unsigned texture) { glDeleteTextures(1, &texture); });
  glBindTexture(target_, name);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  const GlFormat format = gl_format(data.format);
  const bool is_volume = data.shape == TextureData::Shape::volume_3d;
  for (std::size_t level = 0; level < data.levels.size(); ++level) {
    const int width = std::max(1, data.width >> level);
    const int height = std::max(1, data.height >> level);
    const int depth = is_volume ? std::max(1, data.depth >> level) : data.depth;
    const std::size_t layer =
        static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * format.bytes;
    const std::vector<std::byte>& bytes = data.levels[level];
    if (bytes.size() != layer * static_cast<std::size_t>(depth)) {
      throw Error(fmt::format("mip level {} of a texture holds {} bytes instead of {}", level, bytes.size(),
                              layer * static_cast<std::size_t>(depth)));
    }
    const GLint l = static_cast<GLint>(level);
    if (data.shape == TextureData::Shape::image_2d) {
      glTexImage2D(target_, l, format.internal, width, height, 0, format.format, format.type, bytes.data());
    } else if (data.shape == TextureData::Shape::cube) {
      for (unsigned face = 0; face < 6; ++face) {
        glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, l, format.internal, width, height, 0,
                     format.format, format.type, bytes.data() + layer * face);
      }
    } else {
      glTexImage3D(target_, l, format.internal, width, height, depth, 0, format.format, format.type,
                   bytes.data());
    }
  }
  const bool mipmaps = data.generate_mipmaps || data.levels.size() > 1;
  if (data.generate_mipmaps) {
    glGenerateMipmap(target_);
  } else {
    glTexParameteri(target_, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(data.levels.size()) - 1);
  }
  glTexParameteri(target_, GL_TEXTURE_MIN_FILTER, mipmaps ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
  glTexParameteri(target_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(target_, GL_TEXTURE_WRAP_S, gl_wrap(data.wrap_u));
  glTexParameteri(target_, GL_TEXTURE_WRAP_T, gl_wrap(data.wrap_v));
  glTexParameteri(target_, GL_TEXTURE_WRAP_R, gl_wrap(data.wrap_w));
  if (glGetError() == GL_OUT_OF_MEMORY) throw Error("not enough graphics memory for a texture");
}

void Texture::bind(int unit) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(target_, handle_.name());
}

}  // namespace sateen::gpu
