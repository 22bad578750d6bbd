// SPDX-License-Identifier: MIT
#include "sateen/light/environment_sampler.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/colour.h"
#include "sateen/light/environment.h"

namespace sateen::light {

namespace {

/// Solid angle of a pixel of row y: the band between two elevations, shared by its pixels.
double pixel_solid_angle(int y, int width, int height) {
  const double top = std::cos(kPi * y / height);
  const double bottom = std::cos(kPi * (y + 1) / height);
  return 2 * kPi / width * (top - bottom);
}

}  // namespace

EnvironmentSampler::EnvironmentSampler(const Image& environment)
    : width_(environment.width), height_(environment.height) {
  const auto width = static_cast<std::size_t>(width_);
  const auto height = static_cast<std::size_t>(height_);
  const auto fill = [&](auto radiance) {
    weights_.assign(width * height, 0);
    rows_.assign(height + 1, 0);
    columns_.assign(height * (width + 1), 0);
    for (std::size_t y = 0; y < height; ++y) {
      const double solid_angle = pixel_solid_angle(static_cast<int>(y), width_, height_);
      double sum = 0;
      for (std::size_t x = 0; x < width; ++x) {
        const double weight = radiance(static_cast<int>(x), static_cast<int>(y)) * solid_angle;
        weights_[y * width + x] = weight;
        sum += weight;
        columns_[y * (width + 1) + x + 1] = sum;
      }
      rows_[y + 1] = rows_[y] + sum;
    }
  };
  fill([&](int x, int y) { return std::max(0.0, luminance(environment.rgb(x, y).cast<double>())); });
  if (!(rows_.back() > 0)) fill([](int, int) { return 1.0; });
}

double EnvironmentSampler::pixel_pdf(int x, int y) const {
  const double weight =
      weights_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
  return weight / (rows_.back() * pixel_solid_angle(y, width_, height_));
}

EnvironmentSampler::Sample EnvironmentSampler::sample(const Vec2& u) const {
  const auto row_above = std::upper_bound(rows_.begin() + 1, rows_.end() - 1, u.y() * rows_.back());
  const auto y = static_cast<std::size_t>(row_above - rows_.begin()) - 1;
  const auto first = columns_.begin() + static_cast<std::ptrdiff_t>(y * static_cast<std::size_t>(width_ + 1));
  const auto last = first + width_;
  const double target = u.x() * *last;
  const auto column_above = std::upper_bound(first + 1, last, target);
  const auto x = static_cast<int>(column_above - first) - 1;
  // Where in the pixel: what the two searches left over is uniform again.
  const double across = std::clamp((target - first[x]) / std::max(first[x + 1] - first[x], 1e-300), 0.0, 1.0);
  const double down =
      std::clamp((u.y() * rows_.back() - rows_[y]) / std::max(rows_[y + 1] - rows_[y], 1e-300), 0.0, 1.0);
  // Even in solid angle: between the cosines of the row's edges.
  const double top = std::cos(kPi * static_cast<double>(y) / height_);
  const double bottom = std::cos(kPi * static_cast<double>(y + 1) / height_);
  const double cosine = std::clamp(top + (bottom - top) * down, -1.0, 1.0);
  const Vec2 uv((x + across) / width_, std::acos(cosine) / kPi);
  return {environment_direction(uv), pixel_pdf(x, static_cast<int>(y))};
}

double EnvironmentSampler::pdf(const Vec3& direction) const {
  const Vec2 uv = environment_uv(direction);
  const int x = std::clamp(static_cast<int>(uv.x() * width_), 0, width_ - 1);
  const int y = std::clamp(static_cast<int>(uv.y() * height_), 0, height_ - 1);
  return pixel_pdf(x, y);
}

}  // namespace sateen::light
