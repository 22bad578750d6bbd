// SPDX-License-Identifier: MIT
#include "sateen/brdf/fibre_table.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "sateen/core/parallel.h"

namespace sateen {

namespace {

/// A fibre closer to the normal than this has one cone only for each angle.
constexpr double kUpright = 1e-6;
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
      texels_[static_cast<std::size_t>(j * along_ + i)] = value(w).cast<float>();
    }
  });
}

double FibreTable::last_along() const {
  // The farthest direction from the fibre is the horizon opposite to where it leans.
  return along_of(-std::abs(fibre_.x()));
}

FibreTable::Cone FibreTable::cone(double cosine) const {
  const double swing = std::sqrt(std::max(1 - cosine * cosine, 0.0)) * std::abs(fibre_.x());
  const double middle = cosine * fibre_.z();
  return {std::max(middle - swing, 0.0), middle + swing};
}

double FibreTable::cosine_at(double along) const {
  const double first = kFirst + kInside;
  return cosine_of(first + (last_along() - kInside - first) * along);
}

Vec3 FibreTable::direction(double along, double across) const {
  const double cosine = cosine_at(along);
  if (std::abs(fibre_.x()) < kUpright) {
    // Any direction on the cone, off the plane.
    const double z = std::max(cosine, kInside);
    const double side = std::sqrt((1 - z * z) / 2);
    return {side, side, z};
  }
  const Cone range = cone(cosine);
  const double b = std::clamp(across, kInside, 1 - kInside);
  const double z = std::max(range.lowest + (range.highest - range.lowest) * b, kInside);
  const double x = (cosine - z * fibre_.z()) / fibre_.x();
  const double rest = 1 - x * x - z * z;
  return Vec3(x, std::sqrt(std::max(rest, kInside * kInside)), z).normalized();
}

Vec4 FibreTable::operator()(const Vec3& direction) const {
  const double cosine = std::clamp(direction.x() * fibre_.x() + direction.z() * fibre_.z(), -1.0, 1.0);
  const Cone range = cone(cosine);
  const double across =
      std::clamp((direction.z() - range.lowest) / std::max(range.highest - range.lowest, kUpright), 0.0, 1.0);
  const Vec2 map = along_coordinate();
  const double along = std::clamp(along_of(cosine) * map.x() + map.y(), 0.0, 1.0);
  const double u = along * (along_ - 1);
  const double v = across * (across_ - 1);
  const int i = std::min(static_cast<int>(u), along_ - 2);
  const int j = std::min(static_cast<int>(v), across_ - 2);
  const double fu = u - i;
  const double fv = v - j;
  const auto texel = [&](int a, int b) -> Vec4 {
    return texels_[static_cast<std::size_t>((j + b) * along_ + i + a)].cast<double>();
  };
  return (1 - fv) * ((1 - fu) * texel(0, 0) + fu * texel(1, 0)) +
         fv * ((1 - fu) * texel(0, 1) + fu * texel(1, 1));
}

Vec2 FibreTable::along_coordinate() const {
  const double scale = 1 / (last_along() - kFirst);
  return {scale, -kFirst * scale};
}

std::shared_ptr<const TextureData> FibreTable::texture(bool two_values) const {
  auto texture = std::make_shared<TextureData>();
  texture->format = two_values ? TextureData::Format::rg32f : TextureData::Format::rgba32f;
  texture->width = along_;
  texture->height = across_;
  const std::size_t count = two_values ? 2 : 4;
  std::vector<std::byte> bytes(texels_.size() * count * sizeof(float));
  for (std::size_t i = 0; i < texels_.size(); ++i) {
    std::memcpy(bytes.data() + i * count * sizeof(float), texels_[i].data(), count * sizeof(float));
  }
  texture->levels.push_back(std::move(bytes));
  return texture;
}

}  // namespace sateen
