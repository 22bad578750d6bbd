// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "sateen/matcap/sphere_tiles.h"

namespace sateen::matcap {

/// Boxes of four sibling nodes, side by side. A box is a centre and three half axes h at right angles to each
/// other; for a unit direction n every point a of the node has
///   n . a <= n . centre + slack + |n . h_0| + |n . h_1| + |n . h_2|.
/// The slack makes this hold for the products and sums of single precision too, without fused multiply-add,
/// when terms are added up in the order (n.x a.x + n.y a.y) + n.z a.z and the right side in any order. The
/// bound of a node without points is minus infinity.
struct Siblings {
  using Four = std::array<float, 4>;
  std::array<Four, 3> centre{};  ///< x, y, z
  std::array<std::array<Four, 3>, 3> half{};
  Four reach{};  ///< half the diagonal
  Four slack{};
  std::array<int, 4> child{};  ///< index of the child's own siblings; ~leaf for a leaf
};

/// A quadtree over scaled normals, s_q n_q. The points of smooth pictures lie on smooth surfaces: boxes that
/// stand along them are thin, and their bounds far closer than those of boxes along x, y and z.
struct PointTree {
  static constexpr int kLeafPoints = SphereTiles::kQuadrantLanes;  ///< a leaf is a quadrant of a tile

  /// The points of leaf i at kLeafPoints * i; missing ones repeat another of the leaf or are 0.
  std::vector<float> x, y, z;
  std::vector<Siblings> nodes;  ///< those of tile i at i, then coarser ones; the root's children last
  bool empty = true;            ///< no point at all
};

/// A scale below or equal to 0 leaves the point out.
PointTree build_point_tree(const SphereTiles& tiles, const LaneValues& scale);

}  // namespace sateen::matcap
