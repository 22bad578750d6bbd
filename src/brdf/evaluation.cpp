// SPDX-License-Identifier: MIT
#include "sateen/brdf/evaluation.h"

#include <array>

#include <fmt/format.h>

#include "sateen/appearance/json_reader.h"
#include "sateen/brdf/fibre_diffuse.h"
#include "sateen/brdf/fuzz_approximations.h"
#include "sateen/brdf/fuzz_integrals.h"
#include "sateen/brdf/ggx.h"
#include "sateen/brdf/parameters.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/json.h"

namespace sateen::brdf {

namespace {

const std::array<std::string, 3> kModels = {"fibre-diffuse", "ggx", "fuzz"};

BrdfFunction fibre_function(appearance::JsonObject& json) {
  static const std::array<std::string, 4> forms = {"closed", "printed", "integral", "maximum-normal"};
  const std::string form = json.choice("form", "closed", forms);
  if (form == "printed")
    return [](const DirectionPair& d) { return Vec3::Constant(fibre_diffuse_printed(d.light)); };
  if (form == "integral") {
    return [](const DirectionPair& d) {
      return Vec3::Constant(d.light.z() < 0 ? 0 : fibre_diffuse_integral(d.light));
    };
  }
  if (form == "maximum-normal") {
    return [](const DirectionPair& d) { return Vec3::Constant(fibre_maximum_normal(d.light)); };
  }
  return [](const DirectionPair& d) { return Vec3::Constant(fibre_diffuse(d.light)); };
}

BrdfFunction ggx_function(appearance::JsonObject& json) {
  const GgxParameters ggx = read_ggx(json);
  if (!ggx.energy_compensation) {
    return [ggx](const DirectionPair& d) { return ggx_brdf(ggx.roughness, ggx.f0, d.light, d.view); };
  }
  const double mean = ggx_mean_albedo(ggx.roughness);
  return [ggx, mean](const DirectionPair& d) -> Vec3 {
    if (d.light.z() <= 0 || d.view.z() <= 0) return Vec3::Zero();
    return ggx_brdf(ggx.roughness, ggx.f0, d.light, d.view) +
           ggx_multiple_scattering(ggx.f0, ggx_albedo(ggx.roughness, d.light).total(),
                                   ggx_albedo(ggx.roughness, d.view).total(), mean);
  };
}

BrdfFunction fuzz_function(appearance::JsonObject& json) {
  static const std::array<std::string, 6> terms = {"brdf", "ps", "attenuation", "g", "q", "r"};
  static const std::array<std::string, 2> forms = {"exact", "slides"};
  const FuzzParameters fuzz = read_fuzz(json);
  const std::string term = json.choice("term", "brdf", terms);
  const bool slides = json.choice("form", "exact", forms) == "slides";
  std::function<double(const Vec3&)> scattered_down = [fuzz](const Vec3& light) {
    return fuzz_scattered_down(fuzz, light);
  };
  if (slides && (term == "ps" || term == "attenuation" || term == "r")) {
    const ScatteredDownPolynomial fit = fit_scattered_down(fuzz, ScatteredDownPolynomial::kSlidesDegree);
    scattered_down = [fuzz, fit](const Vec3& light) { return fit(light, fuzz); };
  }
  if (term == "ps") return [=](const DirectionPair& d) { return Vec3::Constant(scattered_down(d.light)); };
  if (term == "attenuation") {
    return [=](const DirectionPair& d) -> Vec3 {
      if (d.light.z() <= 0 || d.view.z() <= 0) return Vec3::Zero();
      return fuzz_attenuation(fuzz, d.light, d.view, scattered_down(d.light));
    };
  }
  if (term == "g") {
    return [=](const DirectionPair& d) {
      return Vec3::Constant(slides ? fuzz_visibility_slides(fuzz.density, d.view.z())
                                   : fuzz_visibility(fuzz.density, d.view.z()));
    };
  }
  if (term == "q" || term == "r") {
    const double value = term == "r" ? fuzz_scattered_down_albedo(fuzz)
                         : slides    ? fuzz_passing_albedo_slides(fuzz.density)
                                     : fuzz_passing_albedo(fuzz.density);
    return [value](const DirectionPair&) { return Vec3::Constant(value); };
  }
  return [fuzz](const DirectionPair& d) { return fuzz_brdf(fuzz, d.light, d.view); };
}

BrdfFunction function_of(const std::string& model, const nlohmann::json& value, const std::string& where) {
  appearance::JsonObject json(value, where);
  BrdfFunction function;
  if (model == "fibre-diffuse") {
    function = fibre_function(json);
  } else if (model == "ggx") {
    function = ggx_function(json);
  } else if (model == "fuzz") {
    function = fuzz_function(json);
  } else {
    throw Error(fmt::format("unknown model {}: sateen has fibre-diffuse, ggx and fuzz", model));
  }
  json.finish();
  return function;
}

}  // namespace

std::span<const std::string> brdf_models() {
  return kModels;
}

BrdfFunction read_brdf(const std::string& model, const std::filesystem::path& parameters) {
  return function_of(model, io::read_json(parameters), parameters.string());
}

BrdfFunction parse_brdf(const std::string& model, const std::string& json, const std::string& where) {
  return function_of(model, io::parse_json(json, where), where);
}

std::vector<DirectionPair> read_direction_pairs(const std::filesystem::path& path) {
  const nlohmann::json list = io::read_json(path);
  if (!list.is_array()) {
    throw Error(
        fmt::format("{}: expected a list of {{\"light\": [x, y, z], \"view\": [x, y, z]}}", path.string()));
  }
  std::vector<DirectionPair> pairs;
  pairs.reserve(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    appearance::JsonObject entry(list[i], fmt::format("{}, entry {}", path.string(), i));
    pairs.push_back({entry.direction("light"), entry.direction("view")});
    entry.finish();
  }
  return pairs;
}

void write_values(const std::filesystem::path& path, std::span<const Vec3> values) {
  std::string text = "[";
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += fmt::format("{}\n  [{}, {}, {}]", i == 0 ? "" : ",", values[i].x(), values[i].y(), values[i].z());
  }
  io::write_text(path, text + "\n]\n");
}

}  // namespace sateen::brdf
