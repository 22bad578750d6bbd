// SPDX-License-Identifier: MIT
#include "sateen/light/prefiltered.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/direction.h"
#include "sateen/core/parallel.h"
#include "sateen/light/environment.h"

namespace sateen::light {

namespace {

constexpr int kSmallestWidth = 32;

/// The map at half the size each, for lookups of a given solid angle.
std::vector<Image> pyramid(Image image) {
  std::vector<Image> levels;
  levels.push_back(std::move(image));
  while (levels.back().width > 8) {
    levels.push_back(resized(levels.back(), levels.back().width / 2, std::max(1, levels.back().height / 2)));
  }
  return levels;
}

double radical_inverse(unsigned bits) {
  double value = 0;
  for (double digit = 0.5; bits != 0; bits >>= 1U, digit /= 2) value += (bits & 1U) != 0 ? digit : 0;
  return value;
}

/// One light of the lobe about z, with its weight n.l and the pyramid level whose texels are as wide as its
/// share.
struct LobeSample {
  Vec3 direction;
  double weight;
  double level;
};

std::vector<LobeSample> lobe_samples(double alpha, int count, int map_width) {
  std::vector<LobeSample> samples;
  const double texel = 4 * kPi / (map_width * map_width / 2.0);
  for (int i = 0; i < count; ++i) {
    const double u = (i + 0.5) / count;
    const double phi = 2 * kPi * radical_inverse(static_cast<unsigned>(i));
    const double cosine = std::sqrt((1 - u) / (1 + (alpha * alpha - 1) * u));
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const Vec3 half(sine * std::cos(phi), sine * std::sin(phi), cosine);
    const Vec3 light = 2 * cosine * half - Vec3::UnitZ();
    if (light.z() <= 0) continue;
    const double q = cosine * cosine * (alpha * alpha - 1) + 1;
    const double pdf = alpha * alpha / (kPi * q * q) / 4;  // D (n.h) / (4 v.h) with v = n
    samples.push_back({light, light.z(), std::max(0.0, 0.5 * std::log2(1 / (count * pdf) / texel))});
  }
  return samples;
}

Vec3 pyramid_radiance(const std::vector<Image>& levels, const Vec3& direction, double level) {
  const double last = static_cast<double>(levels.size()) - 1;
  const double at = std::clamp(level, 0.0, last);
  const auto low = static_cast<std::size_t>(at);
  const double blend = at - static_cast<double>(low);
  Vec3 value = (1 - blend) * environment_radiance(levels[low], direction);
  if (blend > 0) value += blend * environment_radiance(levels[low + 1], direction);
  return value;
}

/// What a half can hold, as the texture will.
void round_to_halves(Image& image) {
  for (float& value : image.data) value = static_cast<float>(Half(std::min(value, 65504.0F)));
}

}  // namespace

PrefilteredEnvironment::PrefilteredEnvironment(const Image& environment, int width, int samples) {
  int count = 1;
  for (int w = width; w > kSmallestWidth; w /= 2) ++count;
  const std::vector<Image> source = pyramid(resized(environment, width, width / 2));
  levels_.push_back(source.front());
  for (int i = 1; i < count; ++i) {
    const double roughness = static_cast<double>(i) / (count - 1);
    Image level(width >> i, width >> (i + 1), 3);
    const std::vector<LobeSample> lobe = lobe_samples(roughness * roughness, samples, width);
    parallel_for(level.height, [&](int y) {
      for (int x = 0; x < level.width; ++x) {
        const Vec3 normal = environment_direction({(x + 0.5) / level.width, (y + 0.5) / level.height});
        Vec3 tangent;
        Vec3 bitangent;
        frame_around(normal, tangent, bitangent);
        Vec3 sum = Vec3::Zero();
        double total = 0;
        for (const LobeSample& sample : lobe) {
          const Vec3& d = sample.direction;
          sum += sample.weight *
                 pyramid_radiance(source, d.x() * tangent + d.y() * bitangent + d.z() * normal, sample.level);
          total += sample.weight;
        }
        level.set_rgb(x, y, (sum / total).cast<float>());
      }
    });
    levels_.push_back(std::move(level));
  }
  for (Image& level : levels_) round_to_halves(level);
  texture_ = make_texture();
}

Vec3 PrefilteredEnvironment::radiance(const Vec3& direction, double alpha) const {
  const double last = levels() - 1;
  return pyramid_radiance(levels_, direction, std::sqrt(std::clamp(alpha, 0.0, 1.0)) * last);
}

std::shared_ptr<const TextureData> PrefilteredEnvironment::make_texture() const {
  auto texture = std::make_shared<TextureData>();
  texture->format = TextureData::Format::rgba16f;
  texture->width = levels_.front().width;
  texture->height = levels_.front().height;
  texture->wrap_u = TextureData::Wrap::repeat;
  for (const Image& level : levels_) {
    std::vector<float> texels;
    texels.reserve(level.data.size() / 3 * 4);
    for (int y = level.height - 1; y >= 0; --y) {
      for (int x = 0; x < level.width; ++x) {
        for (const float value : level.pixel(x, y)) texels.push_back(value);
        texels.push_back(1);
      }
    }
    texture->levels.push_back(half_bytes(texels));
  }
  return texture;
}

}  // namespace sateen::light
