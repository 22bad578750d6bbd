// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "sateen/appearance/appearance.h"
#include "sateen/core/mesh.h"
#include "sateen/light/lighting.h"

namespace sateen::scene {

/// Where the tangent angle k comes from (Magri et al., section 6).
enum class TangentAngle {
  vertex,    ///< from the vertices, with the two-k trick of section 6.2
  naive,     ///< from the vertices as it is: shows the artefact of Figure 9
  fragment,  ///< the tangent is interpolated and its angle taken in the fragment; always so under normal and
             ///< direction maps
};

/// How normals and tangents are corrected for perspective. Orthographic views need no correction.
enum class Perspective {
  rotation,   ///< the full rotation that takes the view ray to z (direction.h, eye_frame)
  equation4,  ///< the paper's equation (4), which treats x and y apart
  none,       ///< view space as it is, as most MatCap renderers do
};

/// The parts of the paper's pipeline, to see the effect of each.
struct RenderSwitches {
  TangentAngle tangent_angle = TangentAngle::vertex;
  Perspective perspective = Perspective::rotation;
  bool renormalise = true;  ///< interpolated normals are made unit again
  bool occlusion = true;    ///< section 6.1
};

/// A picture laid over the surface at scale * uv + offset, v up, repeated; nothing without a picture.
struct SurfaceMap {
  std::shared_ptr<const TextureData> texture = nullptr;
  Vec2f scale{1, 1};
  Vec2f offset{0, 0};
};

/// What one material of the mesh is drawn with. Materials may share an appearance.
struct Material {
  std::shared_ptr<appearance::Appearance> appearance = nullptr;
  SurfaceMap normal_map = {};  ///< tangent space, data in [0, 1], green up
  float normal_scale = 1;      ///< factor on its x and y
  SurfaceMap direction_map =
      {};  ///< RG = 0.5 + 0.5 * direction along (tangent, bitangent): replaces the tangent
  SurfaceMap occlusion_map = {};  ///< first channel; multiplies the mesh's occlusion
};

/// What there is to draw.
struct Scene {
  Mesh mesh;  ///< with normals; with tangents and UVs where materials need them
  /// Tangents along u, the frame of the maps, when mesh.tangents point elsewhere; empty: the same.
  std::vector<Vec4f> map_tangents = {};
  double tangent_turn =
      0;  ///< radians, counter-clockwise seen from outside, by which all tangents are turned when drawn
  std::vector<Material> materials = {};  ///< as many as mesh.material_names, at least one
  light::Lighting lighting = {};         ///< of materials that are no baked light
  RenderSwitches switches = {};

  /// Whether all materials are lit by `lighting`, so that brightness means something only beside other light.
  bool lit() const;
};

/// What a mesh offers to materials.
struct MeshOffer {
  std::size_t materials = 1;  ///< as many appearances are needed
  bool tangents = false;
  bool uvs = false;
  bool curvature = false;
};

/// Throws Error when the mesh has no triangles or normals.
MeshOffer offer_of(const Mesh& mesh);

/// Throws Error that says what is missing when a mesh lacks what a material needs.
void check_material(const MeshOffer& mesh, const Material& material);

}  // namespace sateen::scene
