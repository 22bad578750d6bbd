// SPDX-License-Identifier: MIT
#include "sateen/matcap/support_function.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <utility>

#include "sateen/core/parallel.h"

// The inner loops exist twice, for any processor and for those with AVX2, chosen when the program runs. Both
// use the vector extension of GCC and Clang and no fused multiply-add (see CMakeLists.txt), so that they
// agree to the last bit.
#if defined(__x86_64__)
#define SATEEN_AVX2 __attribute__((target("avx2")))
#define SATEEN_HAS_AVX2() (__builtin_cpu_supports("avx2") != 0)
#else
#define SATEEN_AVX2
#define SATEEN_HAS_AVX2() false
#endif
#define SATEEN_INLINE inline __attribute__((always_inline))

namespace sateen {
namespace {

constexpr int kLanes = SphereTiles::kLanes;
constexpr int kGroup = 8;  // lanes in one vector
constexpr int kGroups = kLanes / kGroup;
constexpr int kLeafSide = 4;  // pixels along a leaf: four leaves make a tile
constexpr int kLeafPoints = kLeafSide * kLeafSide;
constexpr int kRemembered = 12;  // leaves that helped the packet before this one
constexpr std::size_t kStackDepth = 96;

using Floats = float __attribute__((vector_size(kGroup * sizeof(float))));
using Mask = std::int32_t __attribute__((vector_size(kGroup * sizeof(float))));

/// Points of a leaf, x then y then z; missing ones repeat another point.
struct Leaf {
  std::array<float, kLeafPoints> x, y, z;
};

struct Box {
  // z of a point is never negative and neither is z of a direction: its upper end is all that matters.
  float x0 = FLT_MAX, x1 = -FLT_MAX, y0 = FLT_MAX, y1 = -FLT_MAX, z1 = -FLT_MAX;
  bool empty() const { return x0 > x1; }
  void add(const Box& other) {
    x0 = std::min(x0, other.x0);
    x1 = std::max(x1, other.x1);
    y0 = std::min(y0, other.y0);
    y1 = std::max(y1, other.y1);
    z1 = std::max(z1, other.z1);
  }
};

/// A node's four children lie one after the other; leaves carry the index of their points.
struct Node {
  Box box;
  int first_child = -1;
  int leaf = -1;
};

struct Tree {
  std::vector<Node> nodes;  // root first
  std::vector<Leaf> leaves;
};

float bound(const Box& b, float x, float y, float z) {
  return (std::max(x * b.x0, x * b.x1) + std::max(y * b.y0, y * b.y1)) + z * b.z1;
}

class TreeBuilder {
 public:
  TreeBuilder(const SphereTiles& tiles, const LaneValues& scale) : tiles_(tiles), scale_(scale) {
    int side = 1;
    while (side < std::max(tiles.columns, tiles.rows)) side *= 2;
    tree_.nodes.reserve(static_cast<std::size_t>(tiles.count()) * 8 + 64);
    tree_.leaves.reserve(static_cast<std::size_t>(tiles.count()) * 4);
    tree_.nodes.emplace_back();
    fill(0, 0, 0, side);
  }
  Tree take() { return std::move(tree_); }

 private:
  void fill(std::size_t node, int column, int row, int side) {
    if (column >= tiles_.columns || row >= tiles_.rows) return;
    const int tile = side == 1 ? tiles_.tile_at[static_cast<std::size_t>(row * tiles_.columns + column)] : 0;
    if (tile < 0) return;
    const std::size_t first = tree_.nodes.size();
    tree_.nodes.resize(first + 4);
    Box box;
    for (std::size_t i = 0; i < 4; ++i) {
      const int dx = static_cast<int>(i % 2);
      const int dy = static_cast<int>(i / 2);
      if (side == 1) {
        fill_leaf(first + i, tile, dx, dy);
      } else {
        fill(first + i, column + dx * side / 2, row + dy * side / 2, side / 2);
      }
      box.add(tree_.nodes[first + i].box);
    }
    if (box.empty()) {
      tree_.nodes.resize(first);
      return;
    }
    tree_.nodes[node].box = box;
    tree_.nodes[node].first_child = static_cast<int>(first);
  }

  void fill_leaf(std::size_t node, int tile, int dx, int dy) {
    Leaf leaf{};
    Box box;
    std::size_t count = 0;
    for (int i = 0; i < kLeafPoints; ++i) {
      const int lane = (dy * kLeafSide + i / kLeafSide) * SphereTiles::kSide + dx * kLeafSide + i % kLeafSide;
      const std::size_t at = static_cast<std::size_t>(tile) * kLanes + static_cast<std::size_t>(lane);
      const float s = scale_[at];
      if (tiles_.pixel[at] < 0 || !(s > 0)) continue;
      const float x = s * tiles_.x[at];
      const float y = s * tiles_.y[at];
      const float z = s * tiles_.z[at];
      leaf.x[count] = x;
      leaf.y[count] = y;
      leaf.z[count] = z;
      box.add({x, x, y, y, z});
      ++count;
    }
    if (count == 0) return;
    for (std::size_t i = count; i < kLeafPoints; ++i) {
      leaf.x[i] = leaf.x[0];
      leaf.y[i] = leaf.y[0];
      leaf.z[i] = leaf.z[0];
    }
    tree_.nodes[node].box = box;
    tree_.nodes[node].leaf = static_cast<int>(tree_.leaves.size());
    tree_.leaves.push_back(leaf);
  }

  const SphereTiles& tiles_;
  const LaneValues& scale_;
  Tree tree_;
};

/// A tile of directions and the best product of each so far.
struct Packet {
  std::array<Floats, kGroups> x, y, z, best;
  float centre_x, centre_y, centre_z;
};

/// The leaves that improved a packet: the first to try for its neighbour.
struct Memory {
  std::array<int, kRemembered> leaves{};
  std::size_t count = 0;
  void remember(int leaf) {
    if (count < leaves.size()) leaves[count++] = leaf;
  }
};

SATEEN_INLINE bool any(const Mask& mask) {
  std::array<std::uint64_t, sizeof(Mask) / sizeof(std::uint64_t)> words;
  std::memcpy(words.data(), &mask, sizeof(Mask));
  return (words[0] | words[1] | words[2] | words[3]) != 0;
}

SATEEN_INLINE bool may_improve(const Packet& p, const Box& b) {
  Mask improved{};
  for (std::size_t g = 0; g < kGroups; ++g) {
    const Floats ax = p.x[g] * b.x0;
    const Floats bx = p.x[g] * b.x1;
    const Floats ay = p.y[g] * b.y0;
    const Floats by = p.y[g] * b.y1;
    const Floats upper = ((ax > bx ? ax : bx) + (ay > by ? ay : by)) + p.z[g] * b.z1;
    improved |= upper > p.best[g];
  }
  return any(improved);
}

SATEEN_INLINE bool visit_leaf(Packet& p, const Leaf& leaf) {
  Mask improved{};
  for (std::size_t g = 0; g < kGroups; ++g) {
    const Floats x = p.x[g];
    const Floats y = p.y[g];
    const Floats z = p.z[g];
    Floats best = p.best[g];
    for (std::size_t i = 0; i < kLeafPoints; ++i) {
      const Floats product = (x * leaf.x[i] + y * leaf.y[i]) + z * leaf.z[i];
      best = product > best ? product : best;
    }
    improved |= best > p.best[g];
    p.best[g] = best;
  }
  return any(improved);
}

SATEEN_INLINE void walk(const Tree& tree, Packet& p, Memory& memory) {
  Memory next;
  for (std::size_t i = 0; i < memory.count; ++i) {
    if (visit_leaf(p, tree.leaves[static_cast<std::size_t>(memory.leaves[i])]))
      next.remember(memory.leaves[i]);
  }
  std::array<int, kStackDepth> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = tree.nodes[static_cast<std::size_t>(stack[--size])];
    if (!may_improve(p, node.box)) continue;
    if (node.leaf >= 0) {
      if (visit_leaf(p, tree.leaves[static_cast<std::size_t>(node.leaf)])) next.remember(node.leaf);
      continue;
    }
    // The child that promises most to the middle of the packet goes on top of the stack.
    std::array<std::pair<float, int>, 4> order;
    std::size_t count = 0;
    for (int i = 0; i < 4; ++i) {
      const Box& box = tree.nodes[static_cast<std::size_t>(node.first_child + i)].box;
      if (box.empty()) continue;
      std::size_t at = count++;
      const std::pair<float, int> entry{bound(box, p.centre_x, p.centre_y, p.centre_z), node.first_child + i};
      for (; at > 0 && order[at - 1].first > entry.first; --at) order[at] = order[at - 1];
      order[at] = entry;
    }
    for (std::size_t i = 0; i < count; ++i) stack[size++] = order[i].second;
  }
  memory = next;
}

SATEEN_INLINE void answer_row(const Tree& tree, const SphereTiles& tiles, int row, LaneValues& result) {
  Memory memory;
  Packet p;
  for (int tile = tiles.row_begin[static_cast<std::size_t>(row)];
       tile < tiles.row_begin[static_cast<std::size_t>(row) + 1]; ++tile) {
    const std::size_t first = static_cast<std::size_t>(tile) * kLanes;
    std::memcpy(p.x.data(), &tiles.x[first], sizeof p.x);
    std::memcpy(p.y.data(), &tiles.y[first], sizeof p.y);
    std::memcpy(p.z.data(), &tiles.z[first], sizeof p.z);
    for (Floats& best : p.best) best = Floats{} - FLT_MAX;
    constexpr std::size_t kMiddle = kLanes / 2 + SphereTiles::kSide / 2;
    p.centre_x = tiles.x[first + kMiddle];
    p.centre_y = tiles.y[first + kMiddle];
    p.centre_z = tiles.z[first + kMiddle];
    walk(tree, p, memory);
    std::memcpy(&result[first], p.best.data(), sizeof p.best);
  }
}

void answer_row_any(const Tree& tree, const SphereTiles& tiles, int row, LaneValues& result) {
  answer_row(tree, tiles, row, result);
}

SATEEN_AVX2 void answer_row_avx2(const Tree& tree, const SphereTiles& tiles, int row, LaneValues& result) {
  answer_row(tree, tiles, row, result);
}

}  // namespace

SphereTiles tile_sphere(int width, int height, const Disc& disc) {
  constexpr int kSide = SphereTiles::kSide;
  SphereTiles tiles;
  tiles.columns = (width + kSide - 1) / kSide;
  tiles.rows = (height + kSide - 1) / kSide;
  tiles.row_begin.push_back(0);
  int count = 0;
  for (int row = 0; row < tiles.rows; ++row) {
    for (int column = 0; column < tiles.columns; ++column) {
      const std::size_t first = tiles.pixel.size();
      std::size_t filled = first;  // some lane with a normal, once there is one
      bool any_pixel = false;
      for (int lane = 0; lane < kLanes; ++lane) {
        const int x = column * kSide + lane % kSide;
        const int y = row * kSide + lane / kSide;
        const bool inside = x < width && y < height && on_disc(disc, x, y);
        const Vec2 point = disc_point(disc, x + 0.5, y + 0.5);
        const Vec3f n(static_cast<float>(point.x()), static_cast<float>(point.y()),
                      static_cast<float>(std::sqrt(std::max(0.0, 1 - point.squaredNorm()))));
        tiles.pixel.push_back(inside ? y * width + x : -1);
        tiles.x.push_back(n.x());
        tiles.y.push_back(n.y());
        tiles.z.push_back(n.z());
        if (inside && !any_pixel) filled = tiles.pixel.size() - 1;
        any_pixel = any_pixel || inside;
      }
      if (!any_pixel) {
        for (auto* array : {&tiles.x, &tiles.y, &tiles.z}) array->resize(first);
        tiles.pixel.resize(first);
        tiles.tile_at.push_back(-1);
        continue;
      }
      for (std::size_t i = first; i < tiles.pixel.size(); ++i) {
        if (tiles.pixel[i] >= 0) continue;
        tiles.x[i] = tiles.x[filled];
        tiles.y[i] = tiles.y[filled];
        tiles.z[i] = tiles.z[filled];
      }
      tiles.tile_at.push_back(count++);
    }
    tiles.row_begin.push_back(count);
  }
  return tiles;
}

LaneValues support_of_scaled_normals(const SphereTiles& tiles, const LaneValues& scale) {
  LaneValues result(tiles.pixel.size(), -FLT_MAX);
  const Tree tree = TreeBuilder(tiles, scale).take();
  if (tree.leaves.empty()) return result;
  const auto answer = SATEEN_HAS_AVX2() ? answer_row_avx2 : answer_row_any;
  parallel_for(tiles.rows, [&](int row) { answer(tree, tiles, row, result); });
  return result;
}

}  // namespace sateen
