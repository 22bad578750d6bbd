// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace sateen::capture {

/// From the code values of a camera or file to linear light, both in [0, 1]; any number of evenly spaced
/// entries, linear between them.
struct Response {
  std::vector<float> curve;

  static Response srgb();
  static Response linear();
  static Response gamma(double exponent);
  float operator()(float code) const;
};

}  // namespace sateen::capture
