// SPDX-License-Identifier: MIT
#include "sateen/scene/load_scene.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sateen/core/error.h"
#include "sateen/core/picture_texture.h"
#include "sateen/geometry/curvature.h"
#include "sateen/geometry/occlusion.h"
#include "sateen/geometry/tangents.h"
#include "sateen/io/image.h"
#include "sateen/io/mesh.h"
#include "sateen/scene/registry.h"

namespace sateen::scene {
namespace {

namespace fs = std::filesystem;

SurfaceMap surface_map(const Image& picture, const Vec2f& scale = {1, 1}, const Vec2f& offset = {0, 0}) {
  if (picture.empty()) return {};
  return {std::make_shared<const TextureData>(picture_texture(picture, TextureData::Wrap::repeat, true)),
          scale, offset};
}

SurfaceMap read_map(const fs::path& path, int channels, const char* what) {
  if (path.empty()) return {};
  const Image picture = io::read_data(path);
  if (picture.channels < channels) {
    throw Error(fmt::format("{}: a {} needs {} channels, this has {}", path.string(), what, channels,
                            picture.channels));
  }
  return surface_map(picture);
}

/// The path of the appearance for each material of the mesh.
std::vector<fs::path> appearance_paths(const Mesh& mesh, const fs::path& file, const SceneOptions& options) {
  std::vector<fs::path> paths(std::max<std::size_t>(1, mesh.material_names.size()), options.material);
  for (const auto& [name, path] : options.materials) {
    bool found = false;
    for (std::size_t i = 0; i < mesh.material_names.size(); ++i) {
      if (mesh.material_names[i] != name) continue;
      paths[i] = path;
      found = true;
    }
    if (!found) {
      throw Error(fmt::format("{}: has no material \"{}\"; it has \"{}\"", file.string(), name,
                              fmt::join(mesh.material_names, "\", \"")));
    }
  }
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (paths[i].empty()) {
      throw Error(
          fmt::format("{}: nothing is said of the material \"{}\" and there is no material for the rest",
                      file.string(), mesh.material_names.at(i)));
    }
  }
  return paths;
}

/// The materials of the mesh; their files, each once, go to `loaded`.
std::vector<Material> load_materials(const io::Model& model, const fs::path& file,
                                     const SceneOptions& options, std::vector<LoadedMaterial>& loaded) {
  std::map<fs::path, std::size_t> known;
  const SurfaceMap normal_map = read_map(options.normal_map, 3, "normal map");
  const SurfaceMap direction_map = read_map(options.direction_map, 2, "direction map");
  const SurfaceMap occlusion_map = read_map(options.occlusion_map, 1, "occlusion map");
  std::vector<Material> materials;
  for (const fs::path& path : appearance_paths(model.mesh, file, options)) {
    const auto [place, fresh] = known.try_emplace(path, loaded.size());
    if (fresh) loaded.push_back(load_material(path));
    Material material{.appearance = loaded[place->second].appearance};
    material.normal_map = normal_map;
    material.normal_scale = options.normal_scale;
    material.direction_map = direction_map;
    material.occlusion_map = occlusion_map;
    if (materials.size() < model.materials.size()) {
      const io::MeshMaterial& own = model.materials[materials.size()];
      if (!normal_map.texture && options.file_normal_maps) {
        material.normal_map = surface_map(own.normal_map, own.normal_uv_scale, own.normal_uv_offset);
      }
      if (!occlusion_map.texture && options.occlusion == OcclusionSource::file) {
        material.occlusion_map =
            surface_map(own.occlusion_map, own.occlusion_uv_scale, own.occlusion_uv_offset);
      }
    }
    materials.push_back(std::move(material));
  }
  return materials;
}

Vec3f middle(const Mesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const Vec3f& p : mesh.positions) box.extend(p);
  return box.center();
}

bool is_mapped(const Material& material) {
  return material.normal_map.texture || material.direction_map.texture;
}

/// Fills mesh.tangents by `source` and scene.map_tangents, where maps need the frame of the UVs and it is
/// another.
void make_tangents(Scene& scene, const fs::path& file, const TangentSource& source) {
  Mesh& mesh = scene.mesh;
  const bool mapped = std::ranges::any_of(scene.materials, is_mapped);
  const bool needed = std::ranges::any_of(
      scene.materials, [](const Material& material) { return material.appearance->needs().tangents; });
  if (mapped && mesh.uvs.empty()) {
    throw Error(
        fmt::format("{}: has no texture coordinates (UVs), so maps cannot be laid on it", file.string()));
  }
  const bool procedural =
      source.kind == TangentSource::Kind::around || source.kind == TangentSource::Kind::along;
  const bool from_uvs = source.kind == TangentSource::Kind::uv || mesh.tangents.empty();
  if (from_uvs && !mesh.uvs.empty()) {
    geometry::compute_tangents(mesh);
  } else if (from_uvs && !procedural && (needed || source.kind == TangentSource::Kind::uv)) {
    throw Error(fmt::format(
        "{}: has no texture coordinates (UVs), and the material needs tangents; give it a procedural field "
        "with --tangents around:y or --tangents along:y",
        file.string()));
  }
  if (mapped && (procedural || source.angle != 0)) scene.map_tangents = mesh.tangents;
  if (source.kind == TangentSource::Kind::around)
    geometry::set_tangents_around(mesh, source.axis, middle(mesh));
  if (source.kind == TangentSource::Kind::along) geometry::set_tangents_along(mesh, source.axis);
  if (source.angle != 0 && !mesh.tangents.empty()) geometry::rotate_tangents(mesh, source.angle);
}

}  // namespace

Scene load_scene(const fs::path& file, const SceneOptions& options) {
  io::Model model = io::read_model(file);
  Scene scene;
  std::vector<LoadedMaterial> loaded;
  scene.materials = load_materials(model, file, options, loaded);
  scene.lighting = make_lighting(loaded, options.lighting);
  if (options.lighting.environment.empty() && names_several_lights(loaded)) {
    options.warn("the materials name different lights; a scene has one: that of the first is taken");
  }
  scene.mesh = std::move(model.mesh);
  scene.switches = options.switches;
  if (options.occlusion == OcclusionSource::none) scene.switches.occlusion = false;
  Mesh& mesh = scene.mesh;
  if (mesh.normals.empty()) geometry::compute_normals(mesh);
  make_tangents(scene, file, options.tangents);
  if (options.occlusion == OcclusionSource::compute)
    geometry::compute_occlusion(mesh, 128, 0, options.progress);
  for (const Material& material : scene.materials) {
    const appearance::Needs needs = material.appearance->needs();
    if (needs.curvature && mesh.curvature_forms.empty()) geometry::compute_curvature(mesh);
    if ((needs.uvs || material.occlusion_map.texture) && mesh.uvs.empty()) {
      throw Error(
          fmt::format("{}: has no texture coordinates (UVs), and the material needs them", file.string()));
    }
  }
  return scene;
}

}  // namespace sateen::scene
