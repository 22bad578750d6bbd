// SPDX-License-Identifier: MIT
#include "sateen/brdf/hemisphere_table.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/parallel.h"

namespace sateen::brdf {

Vec3 hemisphere_direction(const Vec2& square) {
  const double x = (square.x() + square.y()) / 2;
  const double y = (square.x() - square.y()) / 2;
  return Vec3(x, y, 1 - std::abs(x) - std::abs(y)).normalized();
}

Vec2 hemisphere_square(const Vec3& direction) {
  const double z = std::max(direction.z(), 0.0);
  const double sum = std::abs(direction.x()) + std::abs(direction.y()) + z;
  const double x = direction.x() / sum;
  const double y = direction.y() / sum;
  return {x + y, x - y};
}

HemisphereTable::HemisphereTable(int size, const std::function<Vec4(const Vec3&)>& f)
    : size_(size), texels_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size)) {
  parallel_for(size, [&](int y) {
    for (int x = 0; x < size; ++x) {
      const Vec2 square(2.0 * x / (size - 1) - 1, 2.0 * y / (size - 1) - 1);
      texels_[texel_index(x, y)] = f(hemisphere_direction(square)).cast<float>();
    }
  });
}

Vec4 HemisphereTable::operator()(const Vec3& direction) const {
  const Vec2 at = (hemisphere_square(direction) + Vec2::Ones()) / 2 * (size_ - 1);
  const int x = std::clamp(static_cast<int>(at.x()), 0, size_ - 2);
  const int y = std::clamp(static_cast<int>(at.y()), 0, size_ - 2);
  const double fx = at.x() - x;
  const double fy = at.y() - y;
  const auto texel = [&](int i, int j) -> Vec4 { return texels_[texel_index(x + i, y + j)].cast<double>(); };
  return (1 - fy) * ((1 - fx) * texel(0, 0) + fx * texel(1, 0)) +
         fy * ((1 - fx) * texel(0, 1) + fx * texel(1, 1));
}

std::shared_ptr<const TextureData> HemisphereTable::texture() const {
  auto texture = std::make_shared<TextureData>();
  texture->format = TextureData::Format::rgba16f;
  texture->width = texture->height = size_;
  texture->levels.push_back(half_bytes({texels_.front().data(), texels_.size() * 4}));
  return texture;
}

}  // namespace sateen::brdf
