// SPDX-License-Identifier: MIT
#include "sateen/texture/mapped_appearance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sateen/appearance/footprint.h"
#include "sateen/brdf/bind.h"
#include "sateen/brdf/ggx_surroundings.h"
#include "sateen/brdf/shading_frame.h"
#include "sateen/core/colour.h"
#include "sateen/core/picture_texture.h"

namespace sateen::texture {
namespace {

using appearance::Parameter;
using appearance::ParameterValue;

/// All levels as halves, rows from the bottom; missing channels are 0, alpha 1.
std::shared_ptr<const TextureData> texture_of(const std::vector<Image>& levels) {
  auto texture = std::make_shared<TextureData>();
  texture->format = TextureData::Format::rgba16f;
  texture->width = levels[0].width;
  texture->height = levels[0].height;
  texture->wrap_u = texture->wrap_v = TextureData::Wrap::repeat;
  for (const Image& level : levels) {
    std::vector<float> texels(
        static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height) * 4, 0.0F);
    std::size_t at = 0;
    for (int y = level.height - 1; y >= 0; --y) {
      for (int x = 0; x < level.width; ++x, at += 4) {
        for (int c = 0; c < std::min(level.channels, 3); ++c) {
          texels[at + static_cast<std::size_t>(c)] = level.at(x, y, c);
        }
        texels[at + 3] = 1;
      }
    }
    texture->levels.push_back(half_bytes(texels));
  }
  return texture;
}

/// What the GPU will read.
void round_to_halves(std::vector<Image>& levels) {
  for (Image& level : levels) {
    for (float& v : level.data) v = static_cast<float>(Half(v));
  }
}

/// What a sampler reads at a level between two: bilinear in both, linear between them.
template <std::size_t N>
std::array<double, N> sample_level(const std::vector<Image>& levels, const Vec2& uv, double level) {
  const double at = std::clamp(level, 0.0, static_cast<double>(levels.size()) - 1);
  const auto low = static_cast<std::size_t>(at);
  const double blend = at - static_cast<double>(low);
  std::array<double, N> value{};
  sample_repeating(levels[low], uv, value);
  if (blend > 0) {
    std::array<double, N> next{};
    sample_repeating(levels[low + 1], uv, next);
    for (std::size_t c = 0; c < N; ++c) value[c] += blend * (next[c] - value[c]);
  }
  return value;
}

/// shaders/appearance/mapped.glsl follows it line by line.
class MappedPoint final : public appearance::Reflectance::Point {
 public:
  MappedPoint(const LobeMips& mips, const MappedMaterial& material, const brdf::GgxAlbedoTable& albedo,
              const appearance::Surface& surface)
      : material_(material), albedo_(albedo) {
    const Vec2 uv = surface.uv.cwiseProduct(material.repeat);
    Vec4 footprint = surface.footprint;
    footprint << surface.footprint.head<2>().cwiseProduct(material.repeat),
        surface.footprint.tail<2>().cwiseProduct(material.repeat);
    const auto level = [&](const std::vector<Image>& levels) {
      return appearance::map_level(footprint, levels[0].width, levels[0].height);
    };
    const auto xy = sample_level<2>(mips.normals, uv, level(mips.normals));
    const auto channels = sample_level<3>(mips.anisotropy, uv, level(mips.anisotropy));
    Vec3 n(2 * xy[0] - 1, 2 * xy[1] - 1, 0);
    n.z() = std::sqrt(std::max(1 - n.squaredNorm(), 0.0));
    n.x() *= surface.side;  // from behind, bumps are dents
    n.y() *= mips.green_down ? -surface.side : surface.side;
    lobe_ = brdf::roughness_from_matrix(
        decode_anisotropy({channels[0], channels[1], channels[2]}, mips.encoding));
    Mat3 axes;
    axes << surface.tangent, surface.bitangent_sign * surface.normal.cross(surface.tangent), surface.normal;
    axes_ = axes * normal_frame(n);
    lobe_axes_ = axes_ * Eigen::AngleAxisd(lobe_.azimuth, Vec3::UnitZ()).toRotationMatrix();
    lobe_.azimuth = 0;
    view_ = brdf::lifted_view(lobe_axes_.transpose() * surface.view);
  }

  Vec3 lit(const Vec3& towards) const override {
    const Vec3 light = lobe_axes_.transpose() * towards;
    if (light.z() <= 0) return Vec3::Zero();
    return brdf::diffuse_lit(material_.base, axes_.transpose() * towards) +
           brdf::ggx_brdf(lobe_, material_.f0, light, view_) * light.z();
  }

  Vec3 surroundings(const light::Surroundings& surroundings) const override {
    const Vec3 base =
        brdf::diffuse_surroundings(material_.base, surroundings.harmonics, axes_, brdf::bare_bands());
    if (!surroundings.environment) return base;
    const Vec3 seen = brdf::ggx_surroundings(surroundings, lobe_, lobe_axes_, view_, material_.lobe_samples);
    return base + seen.cwiseProduct(reflectance());
  }

  appearance::Reflectance::LightSample sample(const Vec3& u) const override {
    Vec3 light;
    if (u.z() < base_chance()) {
      const double radius = std::sqrt(u.x());
      const double angle = 2 * kPi * u.y();
      light = axes_ * Vec3(radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - u.x()));
    } else {
      const Vec3 half = brdf::ggx_sample_visible(lobe_, view_, u.head<2>());
      light = lobe_axes_ * (2 * view_.dot(half) * half - view_);
    }
    return {light, pdf(light)};
  }

  double pdf(const Vec3& towards) const override {
    const Vec3 light = lobe_axes_.transpose() * towards;
    return base_chance() * std::max(light.z(), 0.0) / kPi +
           (1 - base_chance()) * brdf::ggx_visible_pdf(lobe_, light, view_);
  }

 private:
  Vec3 reflectance() const {
    const brdf::GgxAlbedo albedo = albedo_(lobe_.alpha_t, lobe_.alpha_b, view_);
    return material_.f0 * albedo.scale + Vec3::Constant(albedo.bias);
  }
  double base_chance() const {
    const double base = 0.1 + luminance(material_.base.color);
    return base / (base + 0.1 + luminance(reflectance()));
  }

  const MappedMaterial& material_;
  const brdf::GgxAlbedoTable& albedo_;
  Mat3 axes_;
  Mat3 lobe_axes_;
  Vec3 view_;
  brdf::AnisotropicRoughness lobe_;  ///< along lobe_axes_
};

std::vector<appearance::ParameterField<MappedMaterial>> make_fields() {
  using M = MappedMaterial;
  std::vector<appearance::ParameterField<M>> fields;
  for (const auto& field : brdf::diffuse_base_parameters()) {
    Parameter parameter = field.parameter;
    parameter.name = "base." + parameter.name;
    fields.push_back({parameter, [&field](const M& m) { return field.get(m.base); },
                      [&field](M& m, const ParameterValue& v) { field.set(m.base, v); }});
  }
  fields.push_back({{.name = "f0",
                     .kind = Parameter::Kind::color,
                     .standard = Vec3(0.04, 0.04, 0.04),
                     .help = "reflectance at normal incidence"},
                    [](const M& m) { return m.f0; },
                    [](M& m, const ParameterValue& v) { m.f0 = std::get<Vec3>(v); }});
  fields.push_back(
      {{.name = "lobe_samples",
        .kind = Parameter::Kind::integer,
        .low = 1,
        .high = 64,
        .standard = 8.0,
        .help = "lookups in the environment along the long highlight"},
       [](const M& m) { return static_cast<double>(m.lobe_samples); },
       [](M& m, const ParameterValue& v) { m.lobe_samples = static_cast<int>(std::get<double>(v)); }});
  for (const int axis : {0, 1}) {
    fields.push_back({{.name = axis == 0 ? "repeat_u" : "repeat_v",
                       .low = 1e-3,
                       .high = 1e4,
                       .standard = 1.0,
                       .help = axis == 0 ? "times the maps repeat over u in [0, 1]" : "the same over v"},
                      [axis](const M& m) { return m.repeat[axis]; },
                      [axis](M& m, const ParameterValue& v) { m.repeat[axis] = std::get<double>(v); }});
  }
  return fields;
}

}  // namespace

std::span<const appearance::ParameterField<MappedMaterial>> mapped_parameters() {
  static const auto fields = make_fields();
  return fields;
}

MappedAppearance::MappedAppearance(LobeMips mips, MappedMaterial material)
    : mips_(std::move(mips)), material_(std::move(material)) {
  round_to_halves(mips_.normals);
  round_to_halves(mips_.anisotropy);
  normals_texture_ = texture_of(mips_.normals);
  lobes_texture_ = texture_of(mips_.anisotropy);
  albedo_texture_ = albedo_.texture();
}

std::unique_ptr<appearance::Reflectance::Point> MappedAppearance::at(
    const appearance::Surface& surface) const {
  return std::make_unique<MappedPoint>(mips_, material_, albedo_, surface);
}

appearance::ShaderModule MappedAppearance::shader() const {
  return {.texts = {{"mapped.glsl", ""}},
          .defines = {brdf::define(material_.base)},
          .entry = "mapped",
          .point = "MappedPoint"};
}

appearance::ShaderValues MappedAppearance::values() const {
  appearance::ShaderValues values;
  brdf::bind_base(material_.base, brdf::bare_bands(), values);
  brdf::set(values, "mapped_root",
            appearance::UniformValue(mips_.encoding == AnisotropyEncoding::root ? 1 : 0));
  brdf::set(values, "mapped_green", mips_.green_down ? -1.0 : 1.0);
  brdf::set(values, "mapped_repeat", brdf::narrow(material_.repeat));
  brdf::set(values, "mapped_f0", brdf::narrow(material_.f0));
  brdf::set(values, "mapped_lobe_samples", appearance::UniformValue(material_.lobe_samples));
  brdf::set_texture(values, "mapped_normals", normals_texture_);
  brdf::set_texture(values, "mapped_lobes", lobes_texture_);
  brdf::set_texture(values, "mapped_albedo", albedo_texture_);
  return values;
}

std::vector<Parameter> MappedAppearance::parameters() const {
  return appearance::descriptions(mapped_parameters());
}

ParameterValue MappedAppearance::get(const std::string& name) const {
  return appearance::field_named(mapped_parameters(), name).get(material_);
}

void MappedAppearance::set(const std::string& name, const ParameterValue& value) {
  const auto& field = appearance::field_named(mapped_parameters(), name);
  appearance::check(field.parameter, value);
  field.set(material_, value);
  changed();
}

}  // namespace sateen::texture
