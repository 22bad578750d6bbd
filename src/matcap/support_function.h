// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "sateen/core/image.h"
#include "sateen/matcap/sphere_disc.h"

namespace sateen {

/// The pixels of a sphere picture in tiles of 8 x 8, each tile a packet of 64 neighbouring lanes. Lanes off
/// the sphere repeat a neighbour's normal and carry pixel -1; tiles without any sphere pixel are left out.
struct SphereTiles {
  static constexpr int kSide = 8;  ///< pixels along a tile
  static constexpr int kLanes = kSide * kSide;

  int columns = 0;  ///< tiles across the picture
  int rows = 0;
  std::vector<int> tile_at;    ///< rows x columns: index of the tile, -1 where there is none
  std::vector<int> row_begin;  ///< rows + 1: the tiles of a row of tiles are row_begin[r] .. row_begin[r + 1]
  std::vector<int> pixel;      ///< tile-major, kLanes each: y * width + x, or -1
  std::vector<float> x, y, z;  ///< unit normals, laid out as `pixel`

  int count() const { return row_begin.empty() ? 0 : row_begin.back(); }
};

SphereTiles tile_sphere(int width, int height, const Disc& disc);

/// One number for each lane of a SphereTiles.
using LaneValues = std::vector<float>;

/// max over q of n_p . (s_q n_q) for every lane p: the support function of the points s_q n_q in the
/// directions of the normals. A scale below or equal to 0 leaves the point out. Branch and bound over a
/// quadtree of the points with bounding boxes; every packet walks the tree once. The result is, bit for bit,
/// the largest of the single-precision products (n_p.x a.x + n_p.y a.y) + n_p.z a.z with a = s_q n_q:
/// rounding is monotone, so a box bounds its points' products in floating point too. -FLT_MAX where no point
/// is left.
LaneValues support_of_scaled_normals(const SphereTiles& tiles, const LaneValues& scale);

}  // namespace sateen
