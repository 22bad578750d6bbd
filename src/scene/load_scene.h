// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "sateen/core/progress.h"
#include "sateen/scene/lighting.h"
#include "sateen/scene/scene.h"

namespace sateen::scene {

/// Where a mesh's tangents come from.
struct TangentSource {
  enum class Kind {
    automatic,  ///< the file's own, else from its UVs
    uv,         ///< from the UVs, whatever the file has
    around,     ///< circles around `axis` through the middle of the bounding box
    along,      ///< `axis` projected to the surface
  };
  Kind kind = Kind::automatic;
  Vec3f axis{0, 1, 0};  ///< object space
  double angle =
      0;  ///< radians; every tangent is then turned about its normal, counter-clockwise seen from outside
};

enum class OcclusionSource {
  file,     ///< what the mesh file carries, per vertex or as its materials' textures
  none,     ///< open everywhere
  compute,  ///< traced per vertex, in place of the file's
};

struct SceneOptions {
  std::filesystem::path material = {};  ///< what every material of the mesh is drawn with
  std::map<std::string, std::filesystem::path> materials = {};  ///< others, by the mesh's material names
  TangentSource tangents = {};
  OcclusionSource occlusion = OcclusionSource::file;
  std::filesystem::path occlusion_map = {};  ///< a picture by UV, multiplied in as well
  std::filesystem::path normal_map = {};     ///< in place of the file's own
  std::filesystem::path direction_map = {};
  float normal_scale = 1;
  LightingOptions lighting = {};
  bool file_normal_maps = true;  ///< use those of the file's materials
  RenderSwitches switches = {};
  Progress progress = {};
  std::function<void(const std::string&)> warn = [](const std::string&) {};  ///< told what was left out
};

/// Reads a mesh and the appearances it is to be drawn with (each file once), lights them, and computes what
/// they need and the file lacks: normals, tangents, curvature. Throws Error naming the file at fault, also
/// when a material needs tangents and there are neither UVs nor a procedural field, and for a material name
/// that the mesh does not have.
Scene load_scene(const std::filesystem::path& mesh, const SceneOptions& options);

}  // namespace sateen::scene
