// SPDX-License-Identifier: MIT
#include "sateen/brdf/fibre_table.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "sateen/core/parallel.h"

namespace sateen::brdf {

namespace {

/// The least range of w.n on a cone that is divided by.
constexpr double kLeastRange = 1e-6;
/// Texels on the plane of fibre and normal, or on the horizon, are filled from beside it.
constexpr double kInside = 1e-4;
const double kFirst = -std::sqrt(2.0);

double along_of(double cosine) {
  return std::sqrt(std::max(1 - cosine, 0.0)) - std::sqrt(std::max(1 + cosine, 0.0));
}

/// The cosine back: the coordinate is -2 sin(pi / 4 - angle / 2).
double cosine_of(double along) {
  return -std::sin(2 * std::asin(std::clamp(along / 2, -1.0, 1.0)));
}

/// The sine of a fibre's tilt.
double sine_of(const Vec3& fibre) {
  return std::hypot(fibre.x(), fibre.y());
}

/// The farthest direction from the fibre is the horizon opposite to where it leans.
double last_along(const Vec3& fibre) {
  return along_of(-sine_of(fibre));
}

/// What takes the first coordinate to [0, 1]: scale and offset.
Vec2 along_map(const Vec3& fibre) {
  const double scale = 1 / (last_along(fibre) - kFirst);
  return {scale, -kFirst * scale};
}

/// The range of w.n on the cone about the fibre, above the horizon.
struct Cone {
  double lowest, highest;
};

Cone cone(const Vec3& fibre, double cosine) {
  const double swing = std::sqrt(std::max(1 - cosine * cosine, 0.0)) * sine_of(fibre);
  const double middle = cosine * fibre.z();
  return {std::max(middle - swing, 0.0), middle + swing};
}

}  // namespace

FibreTable::FibreTable(const Vec3& fibre, int along, int across, const std::function<Column(double)>& column)
    : fibre_(fibre),
      along_(along),
      across_(across),
      texels_(static_cast<std::size_t>(along) * static_cast<std::size_t>(across)) {
  parallel_for(along, [&](int i) {
    const double at = static_cast<double>(i) / (along_ - 1);
    const Column value = column(cosine_at(at));
    for (int j = 0; j < across_; ++j) {
      const Vec3 w = direction(at, static_cast<double>(j) / (across_ - 1));
      texels_[texel_index(i, j)] = value(w).cast<float>();
    }
  });
}

double FibreTable::cosine_at(double along) const {
  const double first = kFirst + kInside;
  return cosine_of(first + (last_along(fibre_) - kInside - first) * along);
}

Vec3 FibreTable::direction(double along, double across) const {
  const double cosine = cosine_at(along);
  const Cone range = cone(fibre_, cosine);
  const double b = std::clamp(across, kInside, 1 - kInside);
  const double z = std::max(range.lowest + (range.highest - range.lowest) * b, kInside);
  const double x = (cosine - z * fibre_.z()) / fibre_.x();
  const double rest = 1 - x * x - z * z;
  return Vec3(x, std::sqrt(std::max(rest, kInside * kInside)), z).normalized();
}

Vec2 FibreTable::place(const Vec3& fibre, const Vec3& direction) {
  const double cosine = std::clamp(direction.dot(fibre), -1.0, 1.0);
  const Cone range = cone(fibre, cosine);
  const double across = (direction.z() - range.lowest) / std::max(range.highest - range.lowest, kLeastRange);
  const Vec2 map = along_map(fibre);
  return {std::clamp(along_of(cosine) * map.x() + map.y(), 0.0, 1.0), std::clamp(across, 0.0, 1.0)};
}

Vec4 FibreTable::read(const Vec2& place) const {
  const double u = place.x() * (along_ - 1);
  const double v = place.y() * (across_ - 1);
  const int i = std::min(static_cast<int>(u), along_ - 2);
  const int j = std::min(static_cast<int>(v), across_ - 2);
  const double fu = u - i;
  const double fv = v - j;
  const auto texel = [&](int a, int b) -> Vec4 { return texels_[texel_index(i + a, j + b)].cast<double>(); };
  return (1 - fv) * ((1 - fu) * texel(0, 0) + fu * texel(1, 0)) +
         fv * ((1 - fu) * texel(0, 1) + fu * texel(1, 1));
}

Vec2 FibreTable::along_coordinate() const {
  return along_map(fibre_);
}

std::shared_ptr<const TextureData> FibreTable::texture(bool two_values) const {
  auto texture = std::make_shared<TextureData>();
  texture->format = two_values ? TextureData::Format::rg16f : TextureData::Format::rgba16f;
  texture->width = along_;
  texture->height = across_;
  const std::size_t count = two_values ? 2 : 4;
  std::vector<float> values;
  values.reserve(texels_.size() * count);
  for (const Vec4f& texel : texels_) values.insert(values.end(), texel.data(), texel.data() + count);
  texture->levels.push_back(half_bytes(values));
  return texture;
}

}  // namespace sateen::brdf
