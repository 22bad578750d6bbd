// SPDX-License-Identifier: MIT
#include "sateen/matcap/sphere_tiles.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/parallel.h"
#include "sateen/matcap/oriented_box.h"

namespace sateen::matcap {
namespace {

constexpr int kSide = SphereTiles::kSide;
constexpr int kLanes = SphereTiles::kLanes;
constexpr int kQuadrantSide = SphereTiles::kQuadrantSide;
constexpr int kQuadrantLanes = SphereTiles::kQuadrantLanes;

/// Column and row of a lane in its tile.
int lane_column(int lane) {
  return lane / kQuadrantLanes % 2 * kQuadrantSide + lane % kQuadrantSide;
}
int lane_row(int lane) {
  return lane / kQuadrantLanes / 2 * kQuadrantSide + lane % kQuadrantLanes / kQuadrantSide;
}

bool has_sphere(int column, int row, int width, int height, const Disc& disc) {
  for (int y = row * kSide; y < std::min(height, (row + 1) * kSide); ++y) {
    for (int x = column * kSide; x < std::min(width, (column + 1) * kSide); ++x) {
      if (on_disc(disc, x, y)) return true;
    }
  }
  return false;
}

void fill(SphereTiles& tiles, std::size_t first, int column, int row, int width, int height,
          const Disc& disc) {
  std::size_t filled = first;  // some lane with a normal
  for (int lane = 0; lane < kLanes; ++lane) {
    const int x = column * kSide + lane_column(lane);
    const int y = row * kSide + lane_row(lane);
    if (x >= width || y >= height || !on_disc(disc, x, y)) continue;
    const std::size_t i = first + static_cast<std::size_t>(lane);
    const Vec2 point = disc_point(disc, x + 0.5, y + 0.5);
    tiles.pixel[i] = y * width + x;
    tiles.x[i] = static_cast<float>(point.x());
    tiles.y[i] = static_cast<float>(point.y());
    tiles.z[i] = static_cast<float>(std::sqrt(std::max(0.0, 1 - point.squaredNorm())));
    filled = i;
  }
  for (std::size_t i = first; i < first + kLanes; ++i) {
    if (tiles.pixel[i] >= 0) continue;
    tiles.x[i] = tiles.x[filled];
    tiles.y[i] = tiles.y[filled];
    tiles.z[i] = tiles.z[filled];
  }
}

DirectionBox box_of(const SphereTiles& tiles, std::size_t first) {
  const auto normal = [&](std::size_t lane) {
    return Vec3(tiles.x[first + lane], tiles.y[first + lane], tiles.z[first + lane]);
  };
  QuarterMeans means;
  for (std::size_t lane = 0; lane < kLanes; ++lane) means.add(lane / kQuadrantLanes, normal(lane));
  BoxBuilder builder(means.frame());
  for (std::size_t lane = 0; lane < kLanes; ++lane) builder.add(normal(lane));
  const OrientedBox box = builder.box();
  DirectionBox result;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto c = static_cast<Eigen::Index>(i);
    result.centre[i] = static_cast<float>(box.centre[c]);
    for (std::size_t k = 0; k < 3; ++k) result.half[k][i] = static_cast<float>(box.half[k][c]);
  }
  result.reach = static_cast<float>(box.reach());
  return result;
}

}  // namespace

SphereTiles tile_sphere(int width, int height, const Disc& disc) {
  SphereTiles tiles;
  tiles.columns = (width + kSide - 1) / kSide;
  tiles.rows = (height + kSide - 1) / kSide;
  const auto at = [&](int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(tiles.columns) +
           static_cast<std::size_t>(column);
  };
  tiles.tile_at.assign(at(0, tiles.rows), -1);
  parallel_for(tiles.rows, [&](int row) {
    for (int column = 0; column < tiles.columns; ++column) {
      if (has_sphere(column, row, width, height, disc)) tiles.tile_at[at(column, row)] = 0;
    }
  });
  int count = 0;
  tiles.row_begin.push_back(0);
  for (int row = 0; row < tiles.rows; ++row) {
    for (int column = 0; column < tiles.columns; ++column) {
      int& tile = tiles.tile_at[at(column, row)];
      if (tile == 0) tile = count++;
    }
    tiles.row_begin.push_back(count);
  }
  const std::size_t lanes = static_cast<std::size_t>(count) * kLanes;
  tiles.pixel.assign(lanes, -1);
  for (auto* array : {&tiles.x, &tiles.y, &tiles.z}) array->resize(lanes);
  tiles.box.resize(static_cast<std::size_t>(count));
  parallel_for(tiles.rows, [&](int row) {
    for (int column = 0; column < tiles.columns; ++column) {
      const int tile = tiles.tile_at[at(column, row)];
      if (tile < 0) continue;
      const std::size_t first = static_cast<std::size_t>(tile) * kLanes;
      fill(tiles, first, column, row, width, height, disc);
      tiles.box[static_cast<std::size_t>(tile)] = box_of(tiles, first);
    }
  });
  return tiles;
}

}  // namespace sateen::matcap
