// SPDX-License-Identifier: MIT
// What shaders/layered.glsl reads of a LayeredAppearance.
#include <algorithm>
#include <cmath>

#include "sateen/brdf/fibre_diffuse.h"
#include "sateen/brdf/layered/layered.h"
#include "sateen/core/picture_texture.h"

namespace sateen::brdf {

namespace {

Vec3f narrow(const Vec3& v) {
  return v.cast<float>();
}

void set(appearance::ShaderBinding& binding, const char* name, appearance::UniformValue value) {
  binding.uniforms.push_back({name, std::move(value)});
}

void number(appearance::ShaderBinding& binding, const char* name, double value) {
  set(binding, name, static_cast<float>(value));
}

void pair(appearance::ShaderBinding& binding, const char* name, double x, double y) {
  set(binding, name, Vec2f(static_cast<float>(x), static_cast<float>(y)));
}

void axis(appearance::ShaderBinding& binding, const char* name, double angle) {
  pair(binding, name, std::cos(angle), std::sin(angle));
}

void texture(appearance::ShaderBinding& binding, const char* name, std::shared_ptr<const TextureData> data) {
  binding.textures.push_back({name, std::move(data)});
}

}  // namespace

void LayeredAppearance::bind_lights(appearance::ShaderBinding& binding) const {
  std::vector<Vec4f> positions;
  std::vector<Vec4f> colours;
  std::vector<Vec4f> axes;
  for (const light::PunctualLight& light : lighting_.lights) {
    const bool directional = light.kind == light::PunctualLight::Kind::directional;
    const bool spot = light.kind == light::PunctualLight::Kind::spot;
    const Vec3f at = narrow(directional ? light.direction : light.position);
    const Vec3f colour = narrow(light.colour);
    const Vec3f direction = narrow(light.direction);
    const double outer = std::cos(light.outer_cone);
    positions.emplace_back(at.x(), at.y(), at.z(), directional ? 0.0f : 1.0f);
    colours.emplace_back(
        colour.x(), colour.y(), colour.z(),
        spot ? static_cast<float>(1 / std::max(std::cos(light.inner_cone) - outer, 1e-4)) : 0.0f);
    axes.emplace_back(direction.x(), direction.y(), direction.z(), static_cast<float>(outer));
  }
  set(binding, "light_count", static_cast<int>(positions.size()));
  if (!positions.empty()) {
    set(binding, "light_position", positions);
    set(binding, "light_colour", colours);
    set(binding, "light_axis", axes);
  }
  std::vector<Vec3f> harmonics;
  for (const Vec3& c : lighting_.harmonics.c) harmonics.push_back(narrow(c));
  set(binding, "environment_harmonics", harmonics);
  if (lighting_.environment) {
    texture(binding, "environment_map", lighting_.environment->texture());
    number(binding, "environment_last_level", lighting_.environment->levels() - 1);
  }
}

void LayeredAppearance::bind_base(appearance::ShaderBinding& binding) const {
  set(binding, "base_colour", narrow(material_.base_colour));
  set(binding, "base_bands",
      std::vector<Vec3f>{narrow(base_bands_[0]), narrow(base_bands_[1]), narrow(base_bands_[2])});
  const FibreMoments& m = moments(material_.base);
  const bool maximum = material_.base == LayeredMaterial::Base::maximum_normal;
  // (|l across the fibre| + x n.l) y, and the moments over the zeroth.
  pair(binding, "base_lobe", maximum ? 0 : 1, (maximum ? 1 : 1 / kPi) / m.one);
  set(binding, "base_moments", narrow(Vec3(m.xx, m.yy, m.zz) / m.one));
  number(binding, "base_moment_z", m.z / m.one);
  axis(binding, "base_axis", material_.base_azimuth);
  number(binding, "simple_fuzziness", material_.simple_fuzziness);
}

void LayeredAppearance::bind_reflection(appearance::ShaderBinding& binding) const {
  const GgxParameters& ggx = *material_.specular;
  number(binding, "ggx_alpha_t", std::max(ggx.roughness.alpha_t, kMinimumAlpha));
  number(binding, "ggx_alpha_b", std::max(ggx.roughness.alpha_b, kMinimumAlpha));
  axis(binding, "ggx_axis", ggx.roughness.azimuth);
  set(binding, "ggx_f0", narrow(ggx.f0));
  set(binding, "ggx_lobe_samples", lighting_.environment ? lobe_samples() : 0);
  number(binding, "ggx_mean_albedo", ggx.energy_compensation ? mean_albedo_ : 1);
  texture(binding, "ggx_albedo_table", albedo_.texture());
}

void LayeredAppearance::bind_fuzz(appearance::ShaderBinding& binding) const {
  const FuzzParameters& fuzz = *material_.fuzz;
  number(binding, "fuzz_density", fuzz.density);
  number(binding, "fuzz_alpha", fuzz.alpha);
  // Schlick: k, and everything of the lobe that does not depend on directions.
  pair(binding, "fuzz_schlick", fuzz.k,
       fuzz_schlick_normalisation(fuzz.k) * (1 - fuzz.k * fuzz.k) / (4 * kPi));
  set(binding, "fuzz_colour", narrow(fuzz.colour));
  number(binding, "fuzz_smoothing", material_.fuzz_smoothing);
  if (fuzz_tilts_) {
    const FibreMap& map = *material_.fuzz_fibres;
    pair(binding, "fuzz_fibre_repeat", map.repeat.x(), map.repeat.y());
    texture(binding, "fuzz_fibre_map",
            std::make_shared<TextureData>(picture_texture(*map.picture, TextureData::Wrap::repeat, true)));
    const Bands& passing = fuzz_tilts_->passing_bands();
    set(binding, "fuzz_passing_bands", narrow({passing[0], passing[1], passing[2]}));
    texture(binding, "fuzz_band_table", fuzz_tilts_->bands_texture());
    texture(binding, "fuzz_down_volume", fuzz_tilts_->down_texture());
    texture(binding, "fuzz_ambient_volume", fuzz_tilts_->ambient_texture());
    return;
  }
  set(binding, "fuzz_fibre", narrow(fuzz.fibre()));
  axis(binding, "fuzz_axis", fuzz.azimuth);
  if (material_.fuzz_slides) {
    const std::vector<double>& c = fuzz_polynomial_.coefficients;
    set(binding, "fuzz_down_low", narrow({c[0], c[1], c[2]}));
    set(binding, "fuzz_down_high", narrow({c[3], c[4], c[5]}));
  }
  set(binding, "fuzz_table_along", Vec2f(fuzz_table_.ambient.along_coordinate().cast<float>()));
  texture(binding, "fuzz_down_table", fuzz_table_.scattered_down.texture(true));
  texture(binding, "fuzz_ambient_table", fuzz_table_.ambient.texture());
}

appearance::ShaderBinding LayeredAppearance::shader() const {
  appearance::ShaderBinding binding;
  const auto use = [&](bool wanted, const char* file) {
    if (wanted) binding.files.emplace_back(file);
  };
  use(material_.base == LayeredMaterial::Base::lambert, "layered_no_fibres.glsl");
  use(!material_.specular, "layered_no_reflection.glsl");
  use(!material_.specular || !material_.specular->energy_compensation, "layered_no_compensation.glsl");
  use(!material_.fuzz, "layered_no_fuzz.glsl");
  if (material_.fuzz) {
    use(material_.fuzz->phase == FuzzPhase::schlick, "layered_phase_schlick.glsl");
    use(material_.fuzz->phase == FuzzPhase::sggx_symmetric, "layered_phase_symmetric.glsl");
    use(!material_.fuzz_scattered_down, "layered_no_scattered_down.glsl");
    use(material_.fuzz_smoothing > 0, "layered_smoothing.glsl");
    use(material_.fuzz_slides, "layered_slides.glsl");
    use(fuzz_tilts_ != nullptr, "layered_fibre_map.glsl");
  }
  use(material_.simple_fuzziness == 0, "layered_no_simple_fuzz.glsl");
  use(true, "layered.glsl");
  binding.function = "layered";
  bind_lights(binding);
  bind_base(binding);
  if (material_.specular) bind_reflection(binding);
  if (material_.fuzz) bind_fuzz(binding);
  return binding;
}

}  // namespace sateen::brdf
