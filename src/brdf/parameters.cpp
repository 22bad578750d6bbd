// SPDX-License-Identifier: MIT
#include "sateen/brdf/parameters.h"

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

}  // namespace

GgxParameters read_ggx(appearance::JsonObject& json) {
  GgxParameters ggx;
  constexpr appearance::JsonObject::Range alpha{0, 1, true};
  const bool matrix = json.has("matrix");
  const bool convention = json.has("convention");
  if (matrix || convention) {
    const char* other = matrix ? "\"matrix\"" : "\"convention\"";
    for (const char* key : {"alpha_t", "alpha_b", "azimuth"}) {
      if (json.has(key)) json.fail(key, fmt::format("left out where {} is given", other));
    }
    if (matrix && convention) json.fail("matrix", "left out where \"convention\" is given");
    ggx.roughness = matrix ? read_matrix(json) : read_convention(json);
  } else {
    ggx.roughness.alpha_t = json.number("alpha_t", ggx.roughness.alpha_t, alpha);
    ggx.roughness.alpha_b = json.number("alpha_b", ggx.roughness.alpha_b, alpha);
    ggx.roughness.azimuth = radians(json.number("azimuth", 0, {-360, 360}));
  }
  ggx.f0 = json.colour("f0", ggx.f0);
  ggx.energy_compensation = json.flag("energy_compensation", false);
  return ggx;
}

FuzzParameters read_fuzz(appearance::JsonObject& json) {
  static const std::array<std::string, 3> phases = {"sggx", "sggx-symmetric", "schlick"};
  static const std::array<std::string, 1> conventions = {"gltf"};
  FuzzParameters fuzz;
  if (json.has("convention")) {
    json.choice("convention", "gltf", conventions);
    for (const char* key : {"density", "alpha", "k", "phase", "tilt", "azimuth", "color"}) {
      if (json.has(key)) json.fail(key, "left out where \"convention\" is given");
    }
    SheenParameters sheen;
    sheen.colour = json.colour("sheen_color", sheen.colour);
    sheen.roughness = json.number("sheen_roughness", sheen.roughness, {0, 1});
    return from_sheen(sheen);
  }
  fuzz.density = json.number("density", fuzz.density, {0, 100});
  const std::string phase = json.choice("phase", "sggx", phases);
  fuzz.phase = phase == "schlick"          ? FuzzPhase::schlick
               : phase == "sggx-symmetric" ? FuzzPhase::sggx_symmetric
                                           : FuzzPhase::sggx;
  if (json.has("alpha") && json.has("k")) json.fail("k", "left out where \"alpha\" is given");
  if (json.has("k")) {
    fuzz.k = json.number("k", 0, {-1, 1, true, true});
    if (fuzz.k < 0 && fuzz.phase != FuzzPhase::schlick) {
      json.fail("k", "in [0, 1) with an SGGX phase function, whose alpha is sqrt(1 - k)");
    }
    fuzz.alpha = fuzz_alpha_of_k(fuzz.k);
  } else {
    // Schlick's k must stay below 1: alpha has a floor there.
    fuzz.alpha = json.number("alpha", fuzz.alpha, {0, 1, true});
    fuzz.alpha = std::max(fuzz.alpha, 1e-3);
    fuzz.k = fuzz_k_of_alpha(fuzz.alpha);
    json.number("k", 0, {-1, 1});
  }
  fuzz.tilt = radians(json.number("tilt", 0, {0, 180}));
  fuzz.azimuth = radians(json.number("azimuth", 0, {-360, 360}));
  fuzz.colour = json.colour("color", fuzz.colour);
  return fuzz;
}

}  // namespace sateen::brdf
