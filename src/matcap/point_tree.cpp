// SPDX-License-Identifier: MIT
#include "sateen/matcap/point_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sateen/core/parallel.h"
#include "sateen/matcap/oriented_box.h"

namespace sateen::matcap {
namespace {

constexpr std::size_t kLeafPoints = PointTree::kLeafPoints;
constexpr int kLeafSide = SphereTiles::kQuadrantSide;
constexpr double kUnit = 0x1p-24;  // largest relative error of rounding to single precision
// In kUnit times the norm of a point: errors of its product with a direction, three roundings at most.
constexpr double kProductError = 4;
// In kUnit times the sum of the norms of centre and half axes: rounding them, and adding the bound up.
constexpr double kBoundError = 9;

/// An oriented box and what its bounds have to be raised by; minus infinity when there is no point.
struct Bounds {
  OrientedBox box;
  double slack = -std::numeric_limits<double>::infinity();
};

bool has_points(double slack) {
  return !std::isinf(slack);
}

OrientedBox box_of(const Siblings& siblings, std::size_t i) {
  const auto vector = [&](const std::array<Siblings::Four, 3>& v) { return Vec3(v[0][i], v[1][i], v[2][i]); };
  return {vector(siblings.centre),
          {vector(siblings.half[0]), vector(siblings.half[1]), vector(siblings.half[2])}};
}

void set_bounds(Siblings& siblings, std::size_t i, const Bounds& bounds) {
  const OrientedBox& box = bounds.box;
  double sum = box.centre.norm();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto c = static_cast<Eigen::Index>(axis);
    siblings.centre[axis][i] = static_cast<float>(box.centre[c]);
    for (std::size_t k = 0; k < 3; ++k) siblings.half[k][axis][i] = static_cast<float>(box.half[k][c]);
    sum += box.half[axis].norm();
  }
  siblings.reach[i] = static_cast<float>(box.reach());
  siblings.slack[i] = static_cast<float>(bounds.slack + kBoundError * kUnit * sum);
}

/// A box around the boxes of four siblings.
Bounds enclose(const Siblings& siblings) {
  Bounds result;
  std::array<OrientedBox, 4> boxes;
  QuarterMeans means;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!has_points(siblings.slack[i])) continue;
    boxes[i] = box_of(siblings, i);
    means.add(i, boxes[i].centre);
    result.slack = std::max(result.slack, static_cast<double>(siblings.slack[i]));
  }
  if (!has_points(result.slack)) return result;
  BoxBuilder builder(means.frame());
  for (std::size_t i = 0; i < 4; ++i) {
    if (has_points(siblings.slack[i])) builder.add(boxes[i]);
  }
  result.box = builder.box();
  return result;
}

/// Puts the points of a leaf in place.
Bounds fill_leaf(PointTree& tree, const SphereTiles& tiles, const LaneValues& scale, std::size_t leaf) {
  std::array<std::size_t, kLeafPoints> present;
  std::size_t count = 0;
  for (std::size_t i = 0; i < kLeafPoints; ++i) {
    const std::size_t at = leaf * kLeafPoints + i;
    const float s = scale[at];
    if (tiles.pixel[at] < 0 || !(s > 0)) continue;
    tree.x[at] = s * tiles.x[at];
    tree.y[at] = s * tiles.y[at];
    tree.z[at] = s * tiles.z[at];
    present[count++] = i;
  }
  if (count == 0) return {};
  const auto point = [&](std::size_t i) {
    const std::size_t at = leaf * kLeafPoints + i;
    return Vec3(tree.x[at], tree.y[at], tree.z[at]);
  };
  QuarterMeans means;
  double largest = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = present[k];
    const Vec3 p = point(i);
    means.add(i / kLeafSide / (kLeafSide / 2) * 2 + i % kLeafSide / (kLeafSide / 2), p);
    largest = std::max(largest, p.squaredNorm());
  }
  BoxBuilder builder(means.frame());
  for (std::size_t k = 0; k < count; ++k) builder.add(point(present[k]));
  if (count < kLeafPoints) {
    const std::size_t filled = leaf * kLeafPoints + present[0];
    for (std::size_t i = 0, k = 0; i < kLeafPoints; ++i) {
      if (k < count && present[k] == i) {
        ++k;
        continue;
      }
      const std::size_t at = leaf * kLeafPoints + i;
      tree.x[at] = tree.x[filled];
      tree.y[at] = tree.y[filled];
      tree.z[at] = tree.z[filled];
    }
  }
  return {builder.box(), kProductError * kUnit * std::sqrt(largest)};
}

/// The coarser levels, from a grid of the nodes below it, -1 where there is none.
void add_coarser_levels(PointTree& tree, std::vector<int> below, int columns, int rows) {
  while (columns > 1 || rows > 1) {
    const int coarse_columns = (columns + 1) / 2;
    const int coarse_rows = (rows + 1) / 2;
    const std::size_t first = tree.nodes.size();
    std::vector<int> grid(static_cast<std::size_t>(coarse_columns) * static_cast<std::size_t>(coarse_rows));
    for (std::size_t i = 0; i < grid.size(); ++i) grid[i] = static_cast<int>(first + i);
    tree.nodes.resize(first + grid.size());
    parallel_for(coarse_rows, [&](int row) {
      for (int column = 0; column < coarse_columns; ++column) {
        Siblings& siblings = tree.nodes[first + static_cast<std::size_t>(row * coarse_columns + column)];
        for (int i = 0; i < 4; ++i) {
          const int x = 2 * column + i % 2;
          const int y = 2 * row + i / 2;
          const int child = x < columns && y < rows ? below[static_cast<std::size_t>(y * columns + x)] : -1;
          const auto slot = static_cast<std::size_t>(i);
          siblings.child[slot] = child;
          set_bounds(siblings, slot,
                     child < 0 ? Bounds{} : enclose(tree.nodes[static_cast<std::size_t>(child)]));
        }
      }
    });
    below = std::move(grid);
    columns = coarse_columns;
    rows = coarse_rows;
  }
}

}  // namespace

PointTree build_point_tree(const SphereTiles& tiles, const LaneValues& scale) {
  PointTree tree;
  for (auto* array : {&tree.x, &tree.y, &tree.z}) array->resize(scale.size());
  tree.nodes.resize(static_cast<std::size_t>(tiles.count()));
  parallel_for(tiles.rows, [&](int row) {
    for (int tile = tiles.row_begin[static_cast<std::size_t>(row)];
         tile < tiles.row_begin[static_cast<std::size_t>(row) + 1]; ++tile) {
      Siblings& siblings = tree.nodes[static_cast<std::size_t>(tile)];
      for (std::size_t i = 0; i < SphereTiles::kQuadrants; ++i) {
        const std::size_t leaf = static_cast<std::size_t>(tile) * SphereTiles::kQuadrants + i;
        siblings.child[i] = ~static_cast<int>(leaf);
        set_bounds(siblings, i, fill_leaf(tree, tiles, scale, leaf));
      }
    }
  });
  add_coarser_levels(tree, tiles.tile_at, tiles.columns, tiles.rows);
  tree.empty = tree.nodes.empty() || std::ranges::none_of(tree.nodes.back().slack, has_points);
  return tree;
}

}  // namespace sateen::matcap
