// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sateen/core/image.h"

namespace sateen::light {

/// Draws directions of an environment map in proportion to the luminance its pixels send (times their solid
/// angle), evenly within a pixel: the usual two-dimensional inversion, rows first.
class EnvironmentSampler {
 public:
  /// A black map is sampled evenly over the sphere.
  explicit EnvironmentSampler(const Image& environment);

  struct Sample {
    Vec3 direction;
    double pdf = 0;  ///< 1/sr
  };
  /// `u` is uniform in [0, 1)^2.
  Sample sample(const Vec2& u) const;
  /// Density of sample() for a unit direction, 1/sr.
  double pdf(const Vec3& direction) const;

 private:
  double pixel_pdf(int x, int y) const;

  int width_ = 0;
  int height_ = 0;
  std::vector<double> weights_;  ///< luminance of pixel times solid angle, row-major
  std::vector<double> rows_;     ///< cumulative over rows, rows_[height] = total
  std::vector<double> columns_;  ///< cumulative within each row, width + 1 entries a row
};

}  // namespace sateen::light
