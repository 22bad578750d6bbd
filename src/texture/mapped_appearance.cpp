// SPDX-License-Identifier: MIT
#include "sateen/texture/mapped_appearance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "sateen/brdf/ggx_surroundings.h"
#include "sateen/core/parallel.h"
#include "sateen/core/picture_texture.h"

namespace sateen::texture {
namespace {

constexpr double kLowestView = 1e-3;  // as layered.cpp lifts views behind the rim

/// All levels as halves, rows from the bottom; missing channels are 0, alpha 1.
std::shared_ptr<const TextureData> texture_of(const std::vector<Image>& levels) {
  auto texture = std::make_shared<TextureData>();
  texture->format = TextureData::Format::rgba16f;
  texture->width = levels[0].width;
  texture->height = levels[0].height;
  texture->wrap_u = texture->wrap_v = TextureData::Wrap::repeat;
  for (const Image& level : levels) {
    std::vector<Half> texels(
        static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height) * 4, Half(0));
    std::size_t at = 0;
    for (int y = level.height - 1; y >= 0; --y) {
      for (int x = 0; x < level.width; ++x, at += 4) {
        for (int c = 0; c < std::min(level.channels, 3); ++c) {
          texels[at + static_cast<std::size_t>(c)] = Half(level.at(x, y, c));
        }
        texels[at + 3] = Half(1);
      }
    }
    std::vector<std::byte>& bytes = texture->levels.emplace_back(texels.size() * sizeof(Half));
    std::memcpy(bytes.data(), texels.data(), bytes.size());
  }
  return texture;
}

/// What the GPU will read.
void round_to_halves(std::vector<Image>& levels) {
  for (Image& level : levels) {
    for (float& v : level.data) v = static_cast<float>(Half(v));
  }
}

}  // namespace

GgxAlbedoTable::GgxAlbedoTable() : table_(kCosines * kAlphas, kAzimuths * kRatios, 2) {
  const auto part = [](int i, int count) { return static_cast<double>(i) / (count - 1); };
  parallel_for(table_.height, [&](int y) {
    const double ratio = part(y / kAzimuths, kRatios);
    const double azimuth = std::acos(part(y % kAzimuths, kAzimuths));
    for (int x = 0; x < table_.width; ++x) {
      const double root = part(x / kCosines, kAlphas);
      const double alpha = std::max(root * root, brdf::kMinimumAlpha);
      const double high = part(x % kCosines, kCosines);
      const double cosine = std::max(high * high, kLowestView);
      const double sine = std::sqrt(1 - cosine * cosine);
      const brdf::GgxAlbedo albedo =
          brdf::ggx_albedo({alpha, std::max(alpha * ratio * ratio, brdf::kMinimumAlpha), 0},
                           {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine}, 20);
      table_.at(x, y, 0) = static_cast<float>(albedo.scale);
      table_.at(x, y, 1) = static_cast<float>(albedo.bias);
    }
  });
}

brdf::GgxAlbedo GgxAlbedoTable::operator()(double alpha_t, double alpha_b, const Vec3& view) const {
  const double along = std::abs(view.x()) / std::max(view.head<2>().norm(), 1e-6);
  const Vec2 tile(std::sqrt(alpha_t) * (kAlphas - 1), std::sqrt(alpha_b / alpha_t) * (kRatios - 1));
  const int left = std::min(static_cast<int>(tile.x()), kAlphas - 2);
  const int top = std::min(static_cast<int>(tile.y()), kRatios - 2);
  brdf::GgxAlbedo sum;
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
  texture->format = TextureData::Format::rg32f;
  texture->width = table_.width;
  texture->height = table_.height;
  std::vector<std::byte>& bytes = texture->levels.emplace_back(table_.data.size() * sizeof(float));
  std::memcpy(bytes.data(), table_.data.data(), bytes.size());
  return texture;
}

MappedAppearance::MappedAppearance(Maps maps, std::unique_ptr<brdf::LayeredAppearance> base)
    : maps_(std::move(maps)), base_(std::move(base)) {
  round_to_halves(maps_.mips.normals);
  round_to_halves(maps_.mips.anisotropy);
}

Vec3 MappedAppearance::evaluate(const appearance::Surface& surface) const {
  const Vec2 uv = surface.uv.cwiseProduct(maps_.repeat);
  std::array<double, 2> xy{};
  std::array<double, 3> channels{};
  sample_repeating(maps_.mips.normals[0], uv, xy);
  sample_repeating(maps_.mips.anisotropy[0], uv, channels);
  Vec3 n(2 * xy[0] - 1, 2 * xy[1] - 1, 0);
  n.z() = std::sqrt(std::max(1 - n.squaredNorm(), 0.0));
  n.x() *= surface.side;  // from behind, bumps are dents
  n.y() *= maps_.mips.green_down ? -surface.side : surface.side;
  const brdf::AnisotropicRoughness lobe = brdf::roughness_from_matrix(
      decode_anisotropy({channels[0], channels[1], channels[2]}, maps_.mips.encoding));

  Mat3 surface_frame;
  surface_frame << surface.tangent, surface.bitangent_sign * surface.normal.cross(surface.tangent),
      surface.normal;
  const Mat3 turned = surface_frame * normal_frame(n);
  appearance::Surface mapped = surface;
  mapped.normal = turned.col(2);
  mapped.tangent = turned.col(0);
  Vec3 sum = base_->evaluate(mapped);

  const Mat3 frame = turned * Eigen::AngleAxisd(lobe.azimuth, Vec3::UnitZ()).toRotationMatrix();
  const brdf::AnisotropicRoughness roughness{lobe.alpha_t, lobe.alpha_b, 0};
  Vec3 view = frame.transpose() * surface.view;
  if (view.z() < kLowestView) view = Vec3(view.x(), view.y(), kLowestView).normalized();
  const brdf::Lighting& lighting = base_->lighting();
  for (const light::PunctualLight& lamp : lighting.lights) {
    const light::ArrivingLight arriving = light::arriving_light(lamp, surface.position);
    const Vec3 light = frame.transpose() * arriving.direction;
    if (light.z() > 0) {
      sum += arriving.irradiance.cwiseProduct(brdf::ggx_brdf(roughness, maps_.f0, light, view)) * light.z();
    }
  }
  if (!lighting.environment) return sum;
  const Vec3 seen = brdf::ggx_surroundings(*lighting.environment, lobe, frame, view, maps_.lobe_samples);
  const brdf::GgxAlbedo albedo = albedo_(lobe.alpha_t, lobe.alpha_b, view);
  return sum + surface.occlusion * seen.cwiseProduct(maps_.f0 * albedo.scale + Vec3::Constant(albedo.bias));
}

appearance::ShaderBinding MappedAppearance::shader() const {
  appearance::ShaderBinding binding = base_->shader();
  binding.files.emplace_back("mapped.glsl");
  binding.function = "mapped";
  const auto set = [&](const char* name, appearance::UniformValue value) {
    binding.uniforms.push_back({name, std::move(value)});
  };
  set("mapped_root", maps_.mips.encoding == AnisotropyEncoding::root ? 1 : 0);
  set("mapped_green", maps_.mips.green_down ? -1.0f : 1.0f);
  set("mapped_repeat", Vec2f(maps_.repeat.cast<float>()));
  set("mapped_f0", Vec3f(maps_.f0.cast<float>()));
  set("mapped_lobe_samples", base_->lighting().environment ? maps_.lobe_samples : 0);
  binding.textures.push_back({"mapped_normals", texture_of(maps_.mips.normals)});
  binding.textures.push_back({"mapped_lobes", texture_of(maps_.mips.anisotropy)});
  binding.textures.push_back({"mapped_albedo", albedo_.texture()});
  return binding;
}

}  // namespace sateen::texture
