// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "sateen/core/progress.h"
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
  std::filesystem::path material;                          ///< what every material of the mesh is drawn with
  std::map<std::string, std::filesystem::path> materials;  ///< others, by the mesh's material names
  TangentSource tangents;
  OcclusionSource occlusion = OcclusionSource::file;
  std::filesystem::path occlusion_map;  ///< a picture by UV, multiplied in as well
  std::filesystem::path normal_map;     ///< in place of the file's own
  std::filesystem::path direction_map;
  float normal_scale = 1;
  std::filesystem::path environment;  ///< latitude-longitude picture that lights the materials; empty: none
  double environment_turn = 0;        ///< radians about the vertical (turned_environment)
  bool file_normal_maps = true;       ///< use those of the file's materials
  RenderSwitches switches;
  Progress progress;
};

/// Reads a mesh and the appearances it is to be drawn with, and computes what they need and the file lacks:
/// normals, tangents, curvature. Throws Error naming the file at fault, also when a material needs tangents
/// and there are neither UVs nor a procedural field, and for a material name that the mesh does not have.
Scene load_scene(const std::filesystem::path& mesh, const SceneOptions& options);

}  // namespace sateen::scene
