// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "sateen/matcap/sphere_disc.h"

namespace sateen::matcap {

/// An oriented box (oriented_box.h) around the directions of a tile, rounded to single precision.
struct DirectionBox {
  std::array<float, 3> centre{};
  std::array<std::array<float, 3>, 3> half{};
  float reach = 0;  ///< half the diagonal
};

/// The pixels of a sphere picture in tiles of 8 x 8, each tile a packet of 64 lanes: four quadrants of 4 x 4
/// pixels one after the other, each row by row. Lanes off the sphere repeat a neighbour's normal and carry
/// pixel -1; tiles without any sphere pixel are left out.
struct SphereTiles {
  static constexpr int kSide = 8;  ///< pixels along a tile
  static constexpr int kLanes = kSide * kSide;
  static constexpr int kQuadrants = 4;  ///< left upper, right upper, left lower, right lower
  static constexpr int kQuadrantSide = kSide / 2;
  static constexpr int kQuadrantLanes = kQuadrantSide * kQuadrantSide;

  int columns = 0;  ///< tiles across the picture
  int rows = 0;
  std::vector<int> tile_at;    ///< rows x columns: index of the tile, -1 where there is none
  std::vector<int> row_begin;  ///< rows + 1: the tiles of a row of tiles are row_begin[r] .. row_begin[r + 1]
  std::vector<int> pixel;      ///< tile-major, kLanes each: y * width + x, or -1
  std::vector<float> x, y, z;  ///< unit normals, laid out as `pixel`
  std::vector<DirectionBox> box;  ///< of each tile

  int count() const { return row_begin.empty() ? 0 : row_begin.back(); }
};

SphereTiles tile_sphere(int width, int height, const Disc& disc);

/// One number for each lane of a SphereTiles.
using LaneValues = std::vector<float>;

}  // namespace sateen::matcap
