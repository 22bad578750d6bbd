// SPDX-License-Identifier: MIT
#include "sateen/matcap/painted_light.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sateen/core/parallel.h"

namespace sateen::matcap {
namespace {

constexpr int kLargestBitmap = 256;  // pixels: more than a blurred light shows

template <class Colour>
void add_everywhere(SphereMap& map, const LightPlace& place, const Colour& colour) {
  const int size = map.size();
  parallel_for(2 * size, [&](int row) {
    const bool back = row >= size;
    Image& image = back ? map.back : map.front;
    const int y = back ? row - size : row;
    for (int x = 0; x < size; ++x) {
      const Vec3 added = colour(flat_coordinates(place, direction_of_texel(x, y, size, back)));
      image.set_rgb(x, y, image.rgb(x, y) + added.cast<float>());
    }
  });
}

double box(double x, double half, double deviation) {
  if (deviation <= 0) return std::abs(x) < half ? 1 : 0;
  const double scale = 1 / (std::sqrt(2.0) * deviation);
  return 0.5 * (std::erf((x + half) * scale) - std::erf((x - half) * scale));
}

/// One axis of a Gaussian blur; pixels outside are black.
Image blurred_along(const Image& image, double sigma, bool horizontal) {
  const int reach = static_cast<int>(std::ceil(3 * sigma));
  if (reach == 0) return image;
  std::vector<double> weights;
  double total = 0;
  for (int d = -reach; d <= reach; ++d) {
    weights.push_back(std::exp(-0.5 * d * d / (sigma * sigma)));
    total += weights.back();
  }
  Image result(image.width, image.height, 3);
  parallel_for(image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      Vec3 sum = Vec3::Zero();
      for (int d = -reach; d <= reach; ++d) {
        const int px = horizontal ? x + d : x;
        const int py = horizontal ? y : y + d;
        if (px < 0 || py < 0 || px >= image.width || py >= image.height) continue;
        sum += weights[static_cast<std::size_t>(d + reach)] * image.rgb(px, py).cast<double>();
      }
      result.set_rgb(x, y, (sum / total).cast<float>());
    }
  });
  return result;
}

}  // namespace

Vec2 flat_coordinates(const LightPlace& place, const Vec3& w) {
  const double cosine = std::clamp(place.centre.dot(w), -1.0, 1.0);
  Vec3 right = place.up.cross(place.centre);
  if (right.squaredNorm() < 1e-12) right = Vec3::UnitX();
  right.normalize();
  const Vec3 up = place.centre.cross(right);
  const Vec2 direction(w.dot(right), w.dot(up));
  const double length = direction.norm();
  const double angle = std::acos(cosine);
  if (length < 1e-12) return {angle, 0};
  return direction * (angle / length);
}

double value_of(const Footprint& f, const Vec2& p, double variance) {
  if (f.shape == Footprint::Shape::gaussian) {
    const double own = f.size.x() * f.size.x() + f.softness * f.softness;
    const double wide = own + variance;
    return own / wide * std::exp(-p.squaredNorm() / (2 * wide));
  }
  const double deviation = std::sqrt(f.softness * f.softness + variance);
  return box(p.x(), f.size.x(), deviation) * box(p.y(), f.size.y(), deviation);
}

void paint(SphereMap& map, const LightPlace& place, const Footprint& footprint, const Vec3& color,
           double variance) {
  add_everywhere(map, place, [&](const Vec2& p) -> Vec3 { return value_of(footprint, p, variance) * color; });
}

BitmapLight::BitmapLight(const Image& picture, double width, double variance) {
  const int longest = std::max(picture.width, picture.height);
  const double shrink = std::min(1.0, static_cast<double>(kLargestBitmap) / longest);
  const Image small =
      resized(with_channels(picture, 3), std::max(1, static_cast<int>(picture.width * shrink)),
              std::max(1, static_cast<int>(picture.height * shrink)));
  pixel_ = width / small.width;
  // Blurs much wider than the picture are those of ever fewer pixels: what counts is the margin, 3
  // deviations.
  const double sigma = std::sqrt(std::max(0.0, variance)) / pixel_;
  const int margin = 1 + static_cast<int>(std::ceil(3 * sigma));
  Image padded(small.width + 2 * margin, small.height + 2 * margin, 3);
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) padded.set_rgb(x + margin, y + margin, small.rgb(x, y));
  }
  blurred_ = blurred_along(blurred_along(padded, sigma, true), sigma, false);
}

Vec3 BitmapLight::operator()(const Vec2& p) const {
  const double x = blurred_.width / 2.0 + p.x() / pixel_;
  const double y = blurred_.height / 2.0 - p.y() / pixel_;
  if (x < 0.5 || y < 0.5 || x > blurred_.width - 0.5 || y > blurred_.height - 0.5) return Vec3::Zero();
  Vec3 color;
  sample_bilinear(blurred_, x, y, {color.data(), 3});
  return color;
}

void paint(SphereMap& map, const LightPlace& place, const BitmapLight& light, const Vec3& color) {
  add_everywhere(map, place, [&](const Vec2& p) -> Vec3 { return light(p).cwiseProduct(color); });
}

}  // namespace sateen::matcap
