// SPDX-License-Identifier: MIT
#include "sateen/io/triangulate.h"

#include <numeric>

namespace sateen::io {
namespace {

// Twice the signed area.
double area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

// The polygon along its largest axis' direction, seen so that it winds counter-clockwise.
std::vector<Vec2> flattened(std::span<const Vec3f> corners) {
  Vec3 normal = Vec3::Zero();  // Newell's
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 a = (corners[i] - corners[0]).cast<double>();
    const Vec3 b = (corners[(i + 1) % corners.size()] - corners[0]).cast<double>();
    normal += a.cross(b);
  }
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  int x = (axis + 1) % 3;
  int y = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(x, y);
  std::vector<Vec2> flat;
  for (const Vec3f& corner : corners) flat.emplace_back(corner[x], corner[y]);
  return flat;
}

// Whether the corner at place i of `ring` is convex with no other corner inside its triangle.
bool is_ear(const std::vector<Vec2>& flat, const std::vector<std::uint32_t>& ring, std::size_t i) {
  const std::uint32_t before = ring[(i + ring.size() - 1) % ring.size()];
  const std::uint32_t after = ring[(i + 1) % ring.size()];
  const Vec2& a = flat[before];
  const Vec2& b = flat[ring[i]];
  const Vec2& c = flat[after];
  if (!(area(a, b, c) > 0)) return false;
  for (const std::uint32_t other : ring) {
    if (other == before || other == ring[i] || other == after) continue;
    const Vec2& p = flat[other];
    if (area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0) return false;
  }
  return true;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3f> corners) {
  if (corners.size() < 3) return {};
  const std::vector<Vec2> flat = flattened(corners);
  std::vector<std::uint32_t> ring(corners.size());
  std::iota(ring.begin(), ring.end(), 0u);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::size_t i = 1;
  std::size_t tried = 0;
  while (ring.size() > 3) {
    // When no corner is an ear (collinear or crossing), one goes all the same so that the rest gets its
    // chance.
    if (!is_ear(flat, ring, i) && tried < ring.size()) {
      i = (i + 1) % ring.size();
      ++tried;
      continue;
    }
    triangles.push_back({ring[(i + ring.size() - 1) % ring.size()], ring[i], ring[(i + 1) % ring.size()]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
    i %= ring.size();
    tried = 0;
  }
  triangles.push_back({ring[0], ring[1], ring[2]});
  return triangles;
}

}  // namespace sateen::io
