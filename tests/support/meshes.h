// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <functional>

#include "sateen/core/mesh.h"

namespace sateen::test {

/// A (columns x rows) grid of quads, two triangles each, over (u, v) in [0, 1]^2; `place` gives positions.
/// Counter-clockwise where place_u x place_v points outward. Vertices are not shared over a closed
/// parametrisation's seam.
inline Mesh make_grid(int columns, int rows, const std::function<Vec3(double u, double v)>& place) {
  Mesh mesh;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double u = static_cast<double>(i) / columns;
      const double v = static_cast<double>(j) / rows;
      mesh.positions.push_back(place(u, v).cast<float>());
      mesh.uvs.emplace_back(static_cast<float>(u), static_cast<float>(v));
    }
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const auto a = static_cast<std::uint32_t>(j * (columns + 1) + i);
      const auto b = a + static_cast<std::uint32_t>(columns) + 1;
      mesh.triangles.push_back({a, a + 1, b + 1});
      mesh.triangles.push_back({a, b + 1, b});
    }
  }
  return mesh;
}

inline Vec3 on_plane(double u, double v) {
  return {u, v, 0};
}

/// A point of the closed shapes takes angles from exactly wrapped parameters, so that seam vertices coincide
/// exactly.
inline double turn(double parameter) {
  return 2 * kPi * (parameter >= 1 ? 0 : parameter);
}

/// u around the y axis, v along it, height 2.
inline Vec3 on_cylinder(double u, double v, double radius) {
  return {radius * std::sin(turn(u)), 2 * v - 1, radius * std::cos(turn(u))};
}

/// u east, v north; poles at y = +-radius.
inline Vec3 on_sphere(double u, double v, double radius) {
  const double ring = v <= 0 || v >= 1 ? 0 : std::sin(kPi * v);
  return radius * Vec3(ring * std::sin(turn(u)), -std::cos(kPi * v), ring * std::cos(turn(u)));
}

/// u around the y axis, v around the tube.
inline Vec3 on_torus(double u, double v, double radius, double tube) {
  const double r = radius + tube * std::cos(turn(v));
  return {r * std::sin(turn(u)), tube * std::sin(turn(v)), r * std::cos(turn(u))};
}

}  // namespace sateen::test
