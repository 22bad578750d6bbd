// SPDX-License-Identifier: MIT
#include "sateen/amc/lookup.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/direction.h"

namespace sateen::amc {
namespace {

/// Two neighbouring texels along an axis and how far the sample lies towards the second.
struct Neighbours {
  int first;
  int second;
  double fraction;
};

Neighbours clamped(double coordinate, int size) {
  const double x = std::clamp(coordinate, 0.0, size - 1.0);
  const int first = static_cast<int>(x);
  return {first, std::min(first + 1, size - 1), x - first};
}

Neighbours cyclic(double coordinate, int size) {
  const double x = wrap(coordinate, size);
  const int first = static_cast<int>(x);
  return {first, (first + 1) % size, x - first};
}

}  // namespace

Vec3 lookup(const AmcTable& table, const Vec3& normal, double tangent_angle) {
  const Neighbours i = clamped((normal.x() + 1) / 2 * table.size - 0.5, table.size);
  const Neighbours j = clamped((normal.y() + 1) / 2 * table.size - 0.5, table.size);
  const Neighbours k = cyclic(tangent_angle * table.symmetry * table.slices, table.slices);
  const auto row = [&](int y, int f) -> Vec3 {
    return (1 - i.fraction) * table.texel(i.first, y, f).cast<double>() +
           i.fraction * table.texel(i.second, y, f).cast<double>();
  };
  const auto slice = [&](int f) -> Vec3 {
    return (1 - j.fraction) * row(j.first, f) + j.fraction * row(j.second, f);
  };
  return (1 - k.fraction) * slice(k.first) + k.fraction * slice(k.second);
}

Vec3 lookup(const AmcTable& table, const Vec3& normal, const Vec3& tangent) {
  return lookup(table, normal, sateen::tangent_angle(tangent));
}

}  // namespace sateen::amc
