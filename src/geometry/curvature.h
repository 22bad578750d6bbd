// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sateen/core/mesh.h"

namespace sateen::geometry {

/// Principal curvatures per vertex, in 1 / length unit of the mesh, positive where the surface is convex
/// (bends away from its outward normal). The directions are lines across the normal: a direction equals its
/// opposite. |k1| >= |k2|.
struct PrincipalCurvatures {
  std::vector<float> k1;  ///< the larger in magnitude
  std::vector<float> k2;
  std::vector<Vec3f> direction1;  ///< unit, object space, along which the surface bends by k1
  std::vector<Vec3f> direction2;
};

/// Estimates curvature from the change of the vertex normals over each triangle (Rusinkiewicz 2004,
/// Estimating Curvatures and Their Derivatives on Triangle Meshes), joined over seams, and fills
/// mesh.curvature with the mean curvature (k1 + k2) / 2 and mesh.curvature_forms. Computes normals if there
/// are none. A vertex of no triangle gets 0.
PrincipalCurvatures compute_curvature(Mesh& mesh);

}  // namespace sateen::geometry
