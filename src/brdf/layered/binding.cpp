// SPDX-License-Identifier: MIT
// What shaders/appearance/layered.glsl reads of a LayeredAppearance.
#include <algorithm>

#include "sateen/brdf/bind.h"
#include "sateen/brdf/layered/layered.h"
#include "sateen/brdf/layered/point.h"
#include "sateen/brdf/layered/tables.h"

namespace sateen::brdf {
namespace {

void bind_reflection(const LayeredMaterial& material, const GgxTables& tables,
                     appearance::ShaderValues& values) {
  const GgxParameters& ggx = *material.specular;
  set(values, "ggx_alpha_t", std::max(ggx.roughness.alpha_t, kMinimumAlpha));
  set(values, "ggx_alpha_b", std::max(ggx.roughness.alpha_b, kMinimumAlpha));
  set_axis(values, "ggx_axis", ggx.roughness.azimuth);
  set(values, "ggx_f0", narrow(ggx.f0));
  set(values, "ggx_lobe_samples", appearance::UniformValue(lobe_lookups(material)));
  set(values, "ggx_mean_albedo", ggx.energy_compensation ? tables.mean_albedo : 1);
  set_texture(values, "ggx_albedo_table", tables.texture);
}

void bind_fuzz(const LayeredMaterial& material, const FuzzTables& tables,
               const std::shared_ptr<const TextureData>& fibres, appearance::ShaderValues& values) {
  const FuzzParameters& fuzz = *material.fuzz;
  set(values, "fuzz_density", fuzz.density);
  set(values, "fuzz_alpha", fuzz.alpha);
  // Schlick: k, and everything of the lobe that does not depend on directions.
  set(values, "fuzz_schlick",
      narrow(Vec2(fuzz.k, fuzz_schlick_normalisation(fuzz.k) * (1 - fuzz.k * fuzz.k) / (4 * kPi))));
  set(values, "fuzz_color", narrow(fuzz.colour));
  set(values, "fuzz_smoothing", material.fuzz_smoothing);
  if (tables.tilts) {
    set(values, "fuzz_fibre_repeat", narrow(material.fuzz_fibres->repeat));
    set_texture(values, "fuzz_fibre_map", fibres);
    const auto& passing = tables.tilts->passing_bands();
    set(values, "fuzz_passing_bands", narrow(Vec3(passing[0], passing[1], passing[2])));
    set_texture(values, "fuzz_band_table", tables.bands);
    set_texture(values, "fuzz_down_volume", tables.down);
    set_texture(values, "fuzz_ambient_volume", tables.ambient);
    return;
  }
  set(values, "fuzz_fibre", narrow(fuzz.fibre()));
  set_axis(values, "fuzz_axis", fuzz.azimuth);
  set(values, "fuzz_table_along", Vec2f(tables.table.ambient.along_coordinate().cast<float>()));
  set_texture(values, "fuzz_down_table", tables.down);
  set_texture(values, "fuzz_ambient_table", tables.ambient);
}

const char* phase_define(FuzzPhase phase) {
  switch (phase) {
    case FuzzPhase::schlick:
      return "FUZZ_SCHLICK";
    case FuzzPhase::sggx_symmetric:
      return "FUZZ_SGGX_SYMMETRIC";
    case FuzzPhase::sggx:
      break;
  }
  return "FUZZ_SGGX";
}

}  // namespace

appearance::ShaderModule LayeredAppearance::shader() const {
  appearance::ShaderModule module{
      .texts = {{"layered.glsl", ""}}, .defines = {}, .entry = "layered", .point = "LayeredPoint"};
  const auto switched = [&](const char* name, bool on) {
    module.defines.emplace_back(name, on ? "true" : "false");
  };
  const bool compensated = material_.specular && material_.specular->energy_compensation;
  module.defines.push_back(define(material_.base));
  switched("LAYERED_REFLECTION", material_.specular.has_value());
  switched("LAYERED_COMPENSATION", compensated);
  switched("LAYERED_FUZZ", material_.fuzz.has_value());
  if (!material_.fuzz) return module;
  module.defines.emplace_back("LAYERED_FUZZ_PHASE", phase_define(material_.fuzz->phase));
  switched("LAYERED_FUZZ_DOWN", material_.fuzz_scattered_down);
  switched("LAYERED_FUZZ_SMOOTHING", material_.fuzz_smoothing > 0);
  switched("LAYERED_FIBRE_MAP", material_.fuzz_fibres.has_value());
  return module;
}

appearance::ShaderValues LayeredAppearance::values() const {
  appearance::ShaderValues values;
  bind_base(material_.base, bands_under_fuzz(material_, *tables_), values);
  if (material_.specular) bind_reflection(material_, *tables_->ggx, values);
  if (material_.fuzz) bind_fuzz(material_, *tables_->fuzz, fibres_, values);
  return values;
}

}  // namespace sateen::brdf
