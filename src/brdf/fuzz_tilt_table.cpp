// SPDX-License-Identifier: MIT
#include "sateen/brdf/fuzz_tilt_table.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace sateen::brdf {

namespace {

constexpr int kLast = FuzzTiltTable::kTilts - 1;

/// The two tables about a fibre's tilt.
struct Between {
  std::size_t lower;
  double blend;
};

Between between(const Vec3& fibre) {
  // 2 sin(tilt / 2) = sqrt(1 + sin tilt) - sqrt(1 - sin tilt): no trigonometry in the shader.
  const double sine = std::min(std::hypot(fibre.x(), fibre.y()), 1.0);
  const double at = (std::sqrt(1 + sine) - std::sqrt(1 - sine)) / std::sqrt(2.0) * kLast;
  const int lower = std::min(static_cast<int>(at), kLast - 1);
  return {static_cast<std::size_t>(lower), at - lower};
}

std::shared_ptr<const TextureData> stacked(const std::vector<FuzzTable>& tables,
                                           FibreTable FuzzTable::*part) {
  auto volume = std::make_shared<TextureData>();
  for (const FuzzTable& table : tables) {
    const std::shared_ptr<const TextureData> slice = (table.*part).texture();
    if (volume->levels.empty()) {
      *volume = *slice;
      volume->shape = TextureData::Shape::volume_3d;
      volume->depth = FuzzTiltTable::kTilts;
    } else {
      volume->levels[0].insert(volume->levels[0].end(), slice->levels[0].begin(), slice->levels[0].end());
    }
  }
  return volume;
}

}  // namespace

FuzzTiltTable::FuzzTiltTable(const FuzzParameters& fuzz) {
  FuzzParameters tilted = fuzz;
  for (int i = 0; i <= kLast; ++i) {
    // A hair beyond lying down, the other end of the fibre would point out of the surface.
    tilted.tilt = std::min(2 * std::asin(std::sqrt(0.5) * i / kLast), kPi / 2 - 1e-9);
    tables_.push_back(make_fuzz_table(tilted));
  }
}

double FuzzTiltTable::scattered_down(const Vec3& fibre, const Vec3& light) const {
  const auto [lower, blend] = between(fibre);
  const Vec2 place = FibreTable::place(fibre, light);
  return (1 - blend) * tables_[lower].scattered_down.read(place).x() +
         blend * tables_[lower + 1].scattered_down.read(place).x();
}

Vec4 FuzzTiltTable::ambient(const Vec3& fibre, const Vec3& view) const {
  const auto [lower, blend] = between(fibre);
  const Vec2 place = FibreTable::place(fibre, view);
  return (1 - blend) * tables_[lower].ambient.read(place) + blend * tables_[lower + 1].ambient.read(place);
}

std::array<double, 3> FuzzTiltTable::scattered_bands(const Vec3& fibre) const {
  const auto [lower, blend] = between(fibre);
  std::array<double, 3> bands;
  for (std::size_t l = 0; l < 3; ++l) {
    bands[l] = std::lerp(tables_[lower].scattered_bands[l], tables_[lower + 1].scattered_bands[l], blend);
  }
  return bands;
}

std::shared_ptr<const TextureData> FuzzTiltTable::down_texture() const {
  return stacked(tables_, &FuzzTable::scattered_down);
}

std::shared_ptr<const TextureData> FuzzTiltTable::ambient_texture() const {
  return stacked(tables_, &FuzzTable::ambient);
}

std::shared_ptr<const TextureData> FuzzTiltTable::bands_texture() const {
  auto texture = std::make_shared<TextureData>();
  texture->format = TextureData::Format::rgba16f;
  texture->width = kTilts;
  texture->height = 1;
  std::vector<float> texels;
  for (const FuzzTable& table : tables_) {
    for (const double band : table.scattered_bands) texels.push_back(static_cast<float>(band));
    texels.push_back(0);
  }
  texture->levels.push_back(half_bytes(texels));
  return texture;
}

}  // namespace sateen::brdf
