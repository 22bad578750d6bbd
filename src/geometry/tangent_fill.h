// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sateen/core/mesh.h"

namespace sateen::geometry {

/// The part of `direction` orthogonal to the unit `normal`; not normalized.
inline Vec3 across(const Vec3& direction, const Vec3& normal) {
  return direction - normal.dot(direction) * normal;
}

/// Completes a tangent field: a vertex with known[i] == 0 takes the sum of its neighbours' tangents (over
/// triangle edges and among vertices at the same position), nearest known vertices first. Where those cancel,
/// one of them is taken; where there are none, some direction across the normal. Afterwards every tangent is
/// unit and orthogonal to its normal. mesh.normals and mesh.tangents are as long as mesh.positions; w of a
/// filled vertex is its neighbours', or 1.
void fill_tangents(Mesh& mesh, const std::vector<char>& known);

}  // namespace sateen::geometry
