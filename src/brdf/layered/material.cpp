// SPDX-License-Identifier: MIT
#include "sateen/brdf/layered/material.h"

#include <algorithm>
#include <cmath>

#include "sateen/brdf/fibre_table.h"
#include "sateen/brdf/parameters.h"
#include "sateen/core/picture_texture.h"

namespace sateen::brdf {
namespace {

using appearance::Parameter;
using appearance::ParameterField;
using appearance::ParameterValue;
using Fields = std::vector<ParameterField<LayeredMaterial>>;

/// The parameters of one layer as the material's: `look` finds the layer or is null, `place` makes it.
template <class Layer, class Look, class Place>
void add_layer(Fields& fields, const std::string& section, std::span<const ParameterField<Layer>> of_layer,
               const Look& look, const Place& place) {
  for (const ParameterField<Layer>& field : of_layer) {
    Parameter parameter = field.parameter;
    parameter.name = section + "." + parameter.name;
    fields.push_back(
        {parameter,
         [&field, look](const LayeredMaterial& m) -> ParameterValue {
           const Layer* layer = look(m);
           return layer ? field.get(*layer) : field.parameter.standard;
         },
         [&field, place](LayeredMaterial& m, const ParameterValue& v) { field.set(place(m), v); }});
  }
}

Fields make_fields() {
  Fields fields;
  add_layer<DiffuseBase>(
      fields, "base", diffuse_base_parameters(), [](const LayeredMaterial& m) { return &m.base; },
      [](LayeredMaterial& m) -> DiffuseBase& { return m.base; });
  add_layer<GgxParameters>(
      fields, "specular", ggx_parameters(),
      [](const LayeredMaterial& m) { return m.specular ? &*m.specular : nullptr; },
      [](LayeredMaterial& m) -> GgxParameters& { return m.specular ? *m.specular : m.specular.emplace(); });
  fields.push_back(
      {{.name = "specular.lobe_samples",
        .kind = Parameter::Kind::integer,
        .high = 64,
        .help = "lookups in the environment along the long highlight; 0: 8 where the alphas differ, else 1"},
       [](const LayeredMaterial& m) { return static_cast<double>(m.lobe_samples); },
       [](LayeredMaterial& m, const ParameterValue& v) {
         m.lobe_samples = static_cast<int>(std::get<double>(v));
       }});
  add_layer<FuzzParameters>(
      fields, "fuzz", fuzz_parameters(), [](const LayeredMaterial& m) { return m.fuzz ? &*m.fuzz : nullptr; },
      [](LayeredMaterial& m) -> FuzzParameters& { return m.fuzz ? *m.fuzz : m.fuzz.emplace(); });
  fields.push_back(
      {{.name = "fuzz.scattered_down",
        .kind = Parameter::Kind::flag,
        .standard = true,
        .help = "light that the fuzz scatters down to the base; false leaves it out"},
       [](const LayeredMaterial& m) { return m.fuzz_scattered_down; },
       [](LayeredMaterial& m, const ParameterValue& v) { m.fuzz_scattered_down = std::get<bool>(v); }});
  fields.push_back(
      {{.name = "fuzz.normal_smoothing",
        .help = "the fuzz's normal, from the normal map's (0) to the mesh's (1)"},
       [](const LayeredMaterial& m) { return m.fuzz_smoothing; },
       [](LayeredMaterial& m, const ParameterValue& v) { m.fuzz_smoothing = std::get<double>(v); }});
  return fields;
}

}  // namespace

Vec3 FibreMap::fibre(const Vec2& uv) const {
  std::array<double, 2> stored{};
  sample_repeating(*picture, uv.cwiseProduct(repeat), stored);
  Vec2 xy(2 * stored[0] - 1, 2 * stored[1] - 1);
  const double length = xy.norm();
  xy = length > 1e-6 ? Vec2(xy / length) : Vec2(1, 0);
  xy *= std::clamp(length, kUprightTilt, 1.0);
  return {xy.x(), xy.y(), std::sqrt(std::max(1 - xy.squaredNorm(), 0.0))};
}

std::span<const ParameterField<LayeredMaterial>> layered_parameters() {
  static const Fields fields = make_fields();
  return fields;
}

LayeredMaterial normalised(LayeredMaterial material) {
  if (material.specular) {
    AnisotropicRoughness& roughness = material.specular->roughness;
    if (roughness.alpha_t < roughness.alpha_b) {
      std::swap(roughness.alpha_t, roughness.alpha_b);
      roughness.azimuth += kPi / 2;
    }
  }
  if (material.fuzz && std::sin(material.fuzz->tilt) < kUprightTilt) material.fuzz->tilt = kUprightTilt;
  return material;
}

}  // namespace sateen::brdf
