// SPDX-License-Identifier: MIT
#include "sateen/brdf/parameters.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "sateen/brdf/conventions.h"

namespace sateen::brdf {

namespace {

AnisotropicRoughness read_convention(appearance::JsonObject& json) {
  static const std::array<std::string, 4> names = {"gltf", "materialx", "blender", "filament"};
  const std::string name = json.choice("convention", "gltf", names);
  AnisotropyParameters given;
  given.roughness = json.number("roughness", given.roughness, {0, 1});
  given.anisotropy = json.number("anisotropy", 0, {name == "filament" ? -1.0 : 0.0, 1});
  given.rotation = radians(json.number("rotation", 0, {-360, 360}));
  if (name == "materialx") return from_materialx(given);
  if (name == "blender") return from_blender(given);
  if (name == "filament") return from_filament(given);
  return from_gltf(given);
}

AnisotropicRoughness read_matrix(appearance::JsonObject& json) {
  const nlohmann::json& m = json.raw("matrix");
  const char* expected = "[Sxx, Sxy, Syy] of a positive definite matrix with eigenvalues up to 1";
  if (!m.is_array() || m.size() != 3 || !m[0].is_number() || !m[1].is_number() || !m[2].is_number()) {
    json.fail("matrix", expected);
  }
  Mat2 matrix;
  matrix << m[0].get<double>(), m[1].get<double>(), m[1].get<double>(), m[2].get<double>();
  if (!(matrix(0, 0) > 0 && matrix.determinant() > 0 && matrix.trace() < 2 + 1e-9 &&
        (Mat2::Identity() * (1 + 1e-9) - matrix).determinant() >= 0)) {
    json.fail("matrix", expected);
  }
  return roughness_from_matrix(matrix);
}

using appearance::Parameter;
using appearance::ParameterValue;

double number(const ParameterValue& value) {
  return std::get<double>(value);
}

constexpr std::array kPhases{"sggx", "sggx-symmetric", "schlick"};  // as FuzzPhase

constexpr double kLeastFuzzAlpha = 1e-3;  // Schlick's k must stay below 1

void set_alpha(FuzzParameters& fuzz, double alpha) {
  fuzz.alpha = std::max(alpha, kLeastFuzzAlpha);
  fuzz.k = fuzz_k_of_alpha(fuzz.alpha);
}

/// Every field of a table from its key, or its standard value.
template <class Owner>
void read_all(appearance::JsonObject& json, std::span<const appearance::ParameterField<Owner>> fields,
              Owner& owner) {
  for (const auto& field : fields) field.set(owner, json.read(field.parameter));
}

}  // namespace

std::span<const appearance::ParameterField<GgxParameters>> ggx_parameters() {
  using G = GgxParameters;
  static const std::array<appearance::ParameterField<G>, 5> fields{{
      {{.name = "alpha_t", .low_open = true, .standard = 0.3, .help = "GGX roughness along the axis"},
       [](const G& g) { return g.roughness.alpha_t; },
       [](G& g, const ParameterValue& v) { g.roughness.alpha_t = number(v); }},
      {{.name = "alpha_b", .low_open = true, .standard = 0.3, .help = "GGX roughness across the axis"},
       [](const G& g) { return g.roughness.alpha_b; },
       [](G& g, const ParameterValue& v) { g.roughness.alpha_b = number(v); }},
      {{.name = "azimuth",
        .unit = "degrees",
        .low = -360,
        .high = 360,
        .help = "of the axis, counter-clockwise from the tangent"},
       [](const G& g) { return degrees(g.roughness.azimuth); },
       [](G& g, const ParameterValue& v) { g.roughness.azimuth = radians(number(v)); }},
      {{.name = "f0",
        .kind = Parameter::Kind::color,
        .standard = Vec3(0.04, 0.04, 0.04),
        .help = "reflectance at normal incidence"},
       [](const G& g) { return g.f0; },
       [](G& g, const ParameterValue& v) { g.f0 = std::get<Vec3>(v); }},
      {{.name = "energy_compensation",
        .kind = Parameter::Kind::flag,
        .standard = false,
        .help = "gives back the light that single scattering loses"},
       [](const G& g) { return g.energy_compensation; },
       [](G& g, const ParameterValue& v) { g.energy_compensation = std::get<bool>(v); }},
  }};
  return fields;
}

std::span<const appearance::ParameterField<FuzzParameters>> fuzz_parameters() {
  using F = FuzzParameters;
  static const std::array<appearance::ParameterField<F>, 6> fields{{
      {{.name = "density",
        .high = 100,
        .standard = 0.2,
        .help = "thickness of the layer over the mean free path"},
       [](const F& f) { return f.density; },
       [](F& f, const ParameterValue& v) { f.density = number(v); }},
      {{.name = "alpha",
        .low_open = true,
        .standard = 0.5,
        .help = "spread of the fibres; 1 scatters evenly"},
       [](const F& f) { return f.alpha; },
       [](F& f, const ParameterValue& v) { set_alpha(f, number(v)); }},
      {{.name = "phase",
        .kind = Parameter::Kind::choice,
        .choices = {kPhases.begin(), kPhases.end()},
        .standard = std::string(kPhases[0]),
        .help = "phase function of a fibre"},
       [](const F& f) { return std::string(kPhases[static_cast<std::size_t>(f.phase)]); },
       [](F& f, const ParameterValue& v) {
         f.phase =
             static_cast<FuzzPhase>(std::ranges::find(kPhases, std::get<std::string>(v)) - kPhases.begin());
       }},
      {{.name = "tilt", .unit = "degrees", .high = 180, .help = "of the fibres from the normal"},
       [](const F& f) { return degrees(f.tilt); },
       [](F& f, const ParameterValue& v) { f.tilt = radians(number(v)); }},
      {{.name = "azimuth",
        .unit = "degrees",
        .low = -360,
        .high = 360,
        .help = "of the fibres, counter-clockwise from the tangent"},
       [](const F& f) { return degrees(f.azimuth); },
       [](F& f, const ParameterValue& v) { f.azimuth = radians(number(v)); }},
      {{.name = "color",
        .kind = Parameter::Kind::color,
        .standard = Vec3(1, 1, 1),
        .help = "single-scattering albedo of a fibre"},
       [](const F& f) { return f.colour; },
       [](F& f, const ParameterValue& v) { f.colour = std::get<Vec3>(v); }},
  }};
  return fields;
}

GgxParameters read_ggx(appearance::JsonObject& json) {
  GgxParameters ggx;
  const bool matrix = json.has("matrix");
  const bool convention = json.has("convention");
  json.allow({"matrix", "convention"});
  if (matrix || convention) {
    const char* other = matrix ? "\"matrix\"" : "\"convention\"";
    for (const char* key : {"alpha_t", "alpha_b", "azimuth"}) {
      if (json.has(key)) json.fail(key, fmt::format("left out where {} is given", other));
    }
    if (matrix && convention) json.fail("matrix", "left out where \"convention\" is given");
  }
  read_all(json, ggx_parameters(), ggx);
  if (matrix) ggx.roughness = read_matrix(json);
  if (convention) ggx.roughness = read_convention(json);
  return ggx;
}

FuzzParameters read_fuzz(appearance::JsonObject& json) {
  static const std::array<std::string, 1> conventions = {"gltf"};
  FuzzParameters fuzz;
  json.allow({"convention", "k"});
  if (json.has("convention")) {
    json.choice("convention", "gltf", conventions);
    for (const char* key : {"density", "alpha", "k", "phase", "tilt", "azimuth", "color"}) {
      if (json.has(key)) json.fail(key, "left out where \"convention\" is given");
    }
    SheenParameters sheen;
    sheen.colour = json.color("sheen_color", sheen.colour);
    sheen.roughness = json.number("sheen_roughness", sheen.roughness, {0, 1});
    return from_sheen(sheen);
  }
  read_all(json, fuzz_parameters(), fuzz);
  if (!json.has("k")) return fuzz;
  if (json.has("alpha")) json.fail("k", "left out where \"alpha\" is given");
  fuzz.k = json.number("k", 0, {-1, 1, true, true});
  if (fuzz.k < 0 && fuzz.phase != FuzzPhase::schlick) {
    json.fail("k", "in [0, 1) with an SGGX phase function, whose alpha is sqrt(1 - k)");
  }
  fuzz.alpha = fuzz_alpha_of_k(fuzz.k);
  return fuzz;
}

}  // namespace sateen::brdf
