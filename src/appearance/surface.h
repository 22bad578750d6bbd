// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/vector.h"

namespace sateen::appearance {

/// A surface point as an appearance sees it. The `Surface` struct of shaders/surface.glsl has the same
/// fields.
struct Surface {
  Vec3 position{0, 0, 0};     ///< view space; the eye is at the origin under perspective
  Vec3 normal{0, 0, 1};       ///< view space, unit
  Vec3 mesh_normal{0, 0, 1};  ///< the same before any normal map
  Vec3 tangent{1, 0, 0};      ///< view space, unit, orthogonal to the normal
  double side = 1;            ///< 1 on the front; -1 on the back, whose normal is turned to the viewer
  double bitangent_sign = 1;  ///< bitangent = bitangent_sign * cross(normal, tangent)
  Vec3 view{0, 0, 1};         ///< view space, unit, from the point towards the eye
  Vec3 eye_normal{0, 0,
                  1};  ///< the normal in the eye frame (direction.h): its (x, y) indexes MatCap-like tables
  double tangent_angle =
      0;  ///< k in turns: angle of the eye-frame tangent in the picture plane, [0, 1) or a period more
  Vec2 uv{0, 0};         ///< v up
  double occlusion = 1;  ///< ambient occlusion, 1 is open
  double curvature = 0;  ///< 1 / view-space unit, positive where convex
  int material = 0;      ///< index of the mesh's material
};

}  // namespace sateen::appearance
