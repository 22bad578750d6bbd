// SPDX-License-Identifier: MIT
#include "sateen/matcap/support_function.h"

#include <array>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "sateen/core/parallel.h"
#include "sateen/matcap/point_tree.h"

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

namespace sateen::matcap {
namespace {

constexpr std::size_t kLanes = SphereTiles::kLanes;
constexpr std::size_t kGroup = 8;  // lanes in one vector: 4 x 2 pixels
constexpr std::size_t kGroups = kLanes / kGroup;
constexpr std::size_t kLeafPoints = PointTree::kLeafPoints;
constexpr std::size_t kRemembered = 12;  // leaves that helped the packet before this one
constexpr std::size_t kStackDepth = 96;
constexpr float kAnchorError = 24 * 0x1p-24F;

using Floats = float __attribute__((vector_size(kGroup * sizeof(float))));
using Mask = std::int32_t __attribute__((vector_size(kGroup * sizeof(float))));
using Four = float __attribute__((vector_size(4 * sizeof(float))));
using FourMask = std::int32_t __attribute__((vector_size(4 * sizeof(float))));

/// A tile of directions and the best product of each so far.
struct Packet {
  std::array<Floats, kGroups> x, y, z, best;
  DirectionBox box;
  // Of the points every direction has taken into account, the best in the middle of the box.
  std::array<float, 3> anchor;
  float anchor_product;  // with the middle
  float anchor_error;    // bounds relative to it are inexact by this much
};

/// The leaves that improved a packet: the first to try for its neighbour.
struct Memory {
  std::array<int, kRemembered> leaves{};
  std::size_t count = 0;
  void remember(int leaf) {
    if (count < leaves.size()) leaves[count++] = leaf;
  }
  bool has(int leaf) const {
    for (std::size_t i = 0; i < count; ++i) {
      if (leaves[i] == leaf) return true;
    }
    return false;
  }
};

SATEEN_INLINE bool any(const Mask& mask) {
  std::array<std::uint64_t, sizeof(Mask) / sizeof(std::uint64_t)> words;
  std::memcpy(words.data(), &mask, sizeof(Mask));
  return ((words[0] | words[1]) | (words[2] | words[3])) != 0;
}

SATEEN_INLINE Floats absolute(const Floats& v) {
  Mask bits;
  std::memcpy(&bits, &v, sizeof bits);
  bits &= 0x7fffffff;
  Floats result;
  std::memcpy(&result, &bits, sizeof result);
  return result;
}

SATEEN_INLINE Four absolute(const Four& v) {
  FourMask bits;
  std::memcpy(&bits, &v, sizeof bits);
  bits &= 0x7fffffff;
  Four result;
  std::memcpy(&result, &bits, sizeof result);
  return result;
}

/// The bounds of the box of child `i` for one group of a packet.
SATEEN_INLINE Floats bounds(const Packet& p, std::size_t g, const Siblings& s, std::size_t i) {
  const Floats x = p.x[g];
  const Floats y = p.y[g];
  const Floats z = p.z[g];
  Floats upper = s.slack[i] + (x * s.centre[0][i] + y * s.centre[1][i] + z * s.centre[2][i]);
  for (const auto& half : s.half) upper += absolute(x * half[0][i] + y * half[1][i] + z * half[2][i]);
  return upper;
}

/// Products of the leaf's points with one group of directions; true when one of them is a new best.
SATEEN_INLINE bool visit_group(Packet& p, std::size_t g, const PointTree& tree, std::size_t leaf) {
  const float* px = tree.x.data() + leaf * kLeafPoints;
  const float* py = tree.y.data() + leaf * kLeafPoints;
  const float* pz = tree.z.data() + leaf * kLeafPoints;
  const Floats x = p.x[g];
  const Floats y = p.y[g];
  const Floats z = p.z[g];
  Floats best = p.best[g];
  for (std::size_t i = 0; i < kLeafPoints; ++i) {
    const Floats product = (x * px[i] + y * py[i]) + z * pz[i];
    best = product > best ? product : best;
  }
  const Mask improved = best > p.best[g];
  p.best[g] = best;
  return any(improved);
}

SATEEN_INLINE Four load(const Siblings::Four& values) {
  Four result;
  std::memcpy(&result, values.data(), sizeof result);
  return result;
}

using Vectors = std::array<Four, 3>;

SATEEN_INLINE Four dot(const std::array<float, 3>& n, const Vectors& v) {
  return n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
}

SATEEN_INLINE Vectors load(const std::array<Siblings::Four, 3>& v) {
  return {load(v[0]), load(v[1]), load(v[2])};
}

/// How much more than the anchor a point of each sibling could be worth, to any direction of the packet. Not
/// above 0 where no point can improve the packet: product n . a is linear in both, so that with n = m + d in
/// the packet's box and a = c + h in the sibling's,
///   n . (a - anchor) <= m . (c - anchor) + |d . (c - anchor)| + |m . h| + |d| |h|.
SATEEN_INLINE Four promises(const Packet& p, const Siblings& s) {
  Vectors v = load(s.centre);
  for (std::size_t axis = 0; axis < 3; ++axis) v[axis] -= p.anchor[axis];
  Four promise = (3 * load(s.slack) + p.anchor_error) + p.box.reach * load(s.reach);
  promise += dot(p.box.centre, v);
  for (const auto& half : p.box.half) promise += absolute(dot(half, v));
  for (const auto& half : s.half) promise += absolute(dot(p.box.centre, load(half)));
  return promise;
}

/// Makes a point of a leaf that all directions have taken into account the anchor if it is better.
SATEEN_INLINE void update_anchor(Packet& p, const PointTree& tree, std::size_t leaf) {
  const std::size_t first = leaf * kLeafPoints;
  for (std::size_t i = first; i < first + kLeafPoints; i += 4) {
    Vectors v;
    std::memcpy(&v[0], &tree.x[i], sizeof(Four));
    std::memcpy(&v[1], &tree.y[i], sizeof(Four));
    std::memcpy(&v[2], &tree.z[i], sizeof(Four));
    const Four product = dot(p.box.centre, v);
    for (std::size_t k = 0; k < 4; ++k) {
      if (!(product[k] > p.anchor_product)) continue;
      p.anchor_product = product[k];
      p.anchor = {v[0][k], v[1][k], v[2][k]};
      p.anchor_error = kAnchorError * (std::abs(v[0][k]) + std::abs(v[1][k]) + std::abs(v[2][k]));
    }
  }
}

/// Tries a leaf on the groups of directions that it may improve.
SATEEN_INLINE void try_leaf(const PointTree& tree, Packet& p, int leaf, Memory& helped) {
  const Siblings& s = tree.nodes[static_cast<std::size_t>(leaf / SphereTiles::kQuadrants)];
  const auto i = static_cast<std::size_t>(leaf % SphereTiles::kQuadrants);
  bool improved = false;
  for (std::size_t g = 0; g < kGroups; ++g) {
    if (!any(bounds(p, g, s, i) > p.best[g])) continue;
    improved |= visit_group(p, g, tree, static_cast<std::size_t>(leaf));
  }
  if (!improved) return;
  update_anchor(p, tree, static_cast<std::size_t>(leaf));
  helped.remember(leaf);
}

SATEEN_INLINE void walk(const PointTree& tree, Packet& p, Memory& memory) {
  Memory helped;
  for (std::size_t i = 0; i < memory.count; ++i) try_leaf(tree, p, memory.leaves[i], helped);
  std::array<int, kStackDepth> stack;  // siblings, or ~leaf
  std::size_t size = 0;
  stack[size++] = static_cast<int>(tree.nodes.size()) - 1;
  while (size > 0) {
    const int node = stack[--size];
    if (node < 0) {
      if (!memory.has(~node)) try_leaf(tree, p, ~node, helped);
      continue;
    }
    const Siblings& s = tree.nodes[static_cast<std::size_t>(node)];
    const Four promise = promises(p, s);
    // The child that promises most goes on top of the stack.
    std::array<std::size_t, 4> order;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      if (!(promise[i] > 0)) continue;
      std::size_t at = count++;
      for (; at > 0 && promise[order[at - 1]] > promise[i]; --at) order[at] = order[at - 1];
      order[at] = i;
    }
    for (std::size_t i = 0; i < count; ++i) stack[size++] = s.child[order[i]];
  }
  memory = helped;
}

SATEEN_INLINE void answer_row(const PointTree& tree, const SphereTiles& tiles, int row, LaneValues& result) {
  Memory memory;
  Packet p;
  for (int tile = tiles.row_begin[static_cast<std::size_t>(row)];
       tile < tiles.row_begin[static_cast<std::size_t>(row) + 1]; ++tile) {
    const std::size_t first = static_cast<std::size_t>(tile) * kLanes;
    std::memcpy(p.x.data(), &tiles.x[first], sizeof p.x);
    std::memcpy(p.y.data(), &tiles.y[first], sizeof p.y);
    std::memcpy(p.z.data(), &tiles.z[first], sizeof p.z);
    for (Floats& best : p.best) best = Floats{} - FLT_MAX;
    p.box = tiles.box[static_cast<std::size_t>(tile)];
    p.anchor = {};
    p.anchor_product = -FLT_MAX;
    p.anchor_error = INFINITY;
    walk(tree, p, memory);
    std::memcpy(&result[first], p.best.data(), sizeof p.best);
  }
}

void answer_row_any(const PointTree& tree, const SphereTiles& tiles, int row, LaneValues& result) {
  answer_row(tree, tiles, row, result);
}

SATEEN_AVX2 void answer_row_avx2(const PointTree& tree, const SphereTiles& tiles, int row,
                                 LaneValues& result) {
  answer_row(tree, tiles, row, result);
}

}  // namespace

LaneValues support_of_scaled_normals(const SphereTiles& tiles, const LaneValues& scale) {
  LaneValues result(tiles.pixel.size(), -FLT_MAX);
  const PointTree tree = build_point_tree(tiles, scale);
  if (tree.empty) return result;
  const auto answer = SATEEN_HAS_AVX2() ? answer_row_avx2 : answer_row_any;
  parallel_for(tiles.rows, [&](int row) { answer(tree, tiles, row, result); });
  return result;
}

}  // namespace sateen::matcap
