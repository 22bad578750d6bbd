// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/amc/table.h"
#include "sateen/core/direction.h"

namespace sateen::test {

/// A table filled in full from `colour(normal, k)`, corners included.
template <class Colour>
amc::AmcTable table_of(int size, int slices, int symmetry, Colour colour) {
  amc::AmcTable table(size, slices, symmetry);
  for (int f = 0; f < slices; ++f) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const Vec2 disc(2 * (x + 0.5) / size - 1, 2 * (y + 0.5) / size - 1);
        const Vec3 value = colour(normal_on_disc(disc), table.slice_angle(f));
        table.set_texel(x, y, f, value.template cast<float>());
      }
    }
  }
  return table;
}

}  // namespace sateen::test
