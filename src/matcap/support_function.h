// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/matcap/sphere_tiles.h"

namespace sateen::matcap {

/// max over q of n_p . (s_q n_q) for every lane p: the support function of the points s_q n_q in the
/// directions of the normals. A scale below or equal to 0 leaves the point out. Branch and bound over a
/// quadtree of the points (point_tree.h); every packet walks the tree once. The result is, bit for bit, the
/// largest of the single-precision products (n_p.x a.x + n_p.y a.y) + n_p.z a.z with a = s_q n_q. -FLT_MAX
/// where no point is left.
LaneValues support_of_scaled_normals(const SphereTiles& tiles, const LaneValues& scale);

}  // namespace sateen::matcap
