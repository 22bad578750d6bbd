// SPDX-License-Identifier: MIT
#include "sateen/brdf/ggx_albedo_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sateen/brdf/shading_frame.h"
#include "sateen/core/parallel.h"

namespace sateen::brdf {

GgxAlbedoTable::GgxAlbedoTable() : table_(kCosines * kAlphas, kAzimuths * kRatios, 2) {
  const auto part = [](int i, int count) { return static_cast<double>(i) / (count - 1); };
  parallel_for(table_.height, [&](int y) {
    const double ratio = part(y / kAzimuths, kRatios);
    const double azimuth = std::acos(part(y % kAzimuths, kAzimuths));
    for (int x = 0; x < table_.width; ++x) {
      const double root = part(x / kCosines, kAlphas);
      const double alpha = std::max(root * root, kMinimumAlpha);
      const double high = part(x % kCosines, kCosines);
      const double cosine = std::max(high * high, kLowestView);
      const double sine = std::sqrt(1 - cosine * cosine);
      const GgxAlbedo albedo = ggx_albedo({alpha, std::max(alpha * ratio * ratio, kMinimumAlpha), 0},
                                          {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine}, 20);
      table_.at(x, y, 0) = static_cast<float>(albedo.scale);
      table_.at(x, y, 1) = static_cast<float>(albedo.bias);
    }
  });
}

GgxAlbedo GgxAlbedoTable::operator()(double alpha_t, double alpha_b, const Vec3& view) const {
  const double along = std::abs(view.x()) / std::max(view.head<2>().norm(), 1e-6);
  const Vec2 tile(std::sqrt(alpha_t) * (kAlphas - 1), std::sqrt(alpha_b / alpha_t) * (kRatios - 1));
  const int left = std::min(static_cast<int>(tile.x()), kAlphas - 2);
  const int top = std::min(static_cast<int>(tile.y()), kRatios - 2);
  GgxAlbedo sum;
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      std::array<double, 2> read{};
      sample_bilinear(
          table_, (left + i) * kCosines + std::sqrt(std::clamp(view.z(), 0.0, 1.0)) * (kCosines - 1) + 0.5,
          (top + j) * kAzimuths + along * (kAzimuths - 1) + 0.5, read);
      const double weight = (i == 0 ? 1 - (tile.x() - left) : tile.x() - left) *
                            (j == 0 ? 1 - (tile.y() - top) : tile.y() - top);
      sum.scale += weight * read[0];
      sum.bias += weight * read[1];
    }
  }
  return sum;
}

std::shared_ptr<const TextureData> GgxAlbedoTable::texture() const {
  auto texture = std::make_shared<TextureData>();
  texture->format = TextureData::Format::rg16f;
  texture->width = table_.width;
  texture->height = table_.height;
  texture->levels.push_back(half_bytes(table_.data));
  return texture;
}

}  // namespace sateen::brdf
