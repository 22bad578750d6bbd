// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "sateen/appearance/json_reader.h"
#include "sateen/brdf/layered/layered.h"
#include "sateen/brdf/parameters.h"
#include "sateen/core/error.h"
#include "sateen/io/image.h"
#include "sateen/io/json.h"

namespace sateen::brdf {

namespace {

FibreMap read_fibres(appearance::JsonObject& json, const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / json.text("fibres", "");
  Image picture = io::read_data(path);
  if (picture.channels < 2)
    throw Error(fmt::format("{}: a map of fibres has two channels or more", path.string()));
  if (json.flag("green_down", false)) {
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) picture.at(x, y, 1) = 1 - picture.at(x, y, 1);
    }
  }
  return {std::make_shared<const Image>(std::move(picture)), json.pair("repeat", {1, 1}, {1e-3, 1e4})};
}

/// The parameters of a section, or of the top for "", that have a value of their own in the file.
void read_section(appearance::JsonObject& json, const std::string& section, LayeredMaterial& material) {
  for (const auto& field : layered_parameters()) {
    const std::size_t dot = field.parameter.name.find('.');
    const std::string of = dot == std::string::npos ? "" : field.parameter.name.substr(0, dot);
    if (of != section) continue;
    const std::string key = field.parameter.name.substr(dot == std::string::npos ? 0 : dot + 1);
    const appearance::ParameterValue value = json.read(field.parameter);
    if (json.has(key)) field.set(material, value);
  }
}

}  // namespace

std::unique_ptr<LayeredAppearance> LayeredAppearance::parse(const std::string& text,
                                                            const std::filesystem::path& path) {
  const nlohmann::json value = io::parse_json(text, path.string());
  appearance::JsonObject json(value, path.string());
  json.text("model", "layered");
  json.text("name", "");
  LayeredMaterial material;
  const auto section = [&](const char* key) {
    return appearance::JsonObject(json.raw(key), fmt::format("{}, {}", path.string(), key));
  };
  if (json.has("base")) {
    appearance::JsonObject base = section("base");
    read_section(base, "base", material);
    base.finish();
  }
  if (json.has("specular")) {
    appearance::JsonObject specular = section("specular");
    material.specular = read_ggx(specular);  // knows the conventions of other programs
    material.lobe_samples = static_cast<int>(specular.number("lobe_samples", 0, {0, 64}));
    specular.finish();
  }
  if (json.has("fuzz")) {
    appearance::JsonObject fuzz = section("fuzz");
    material.fuzz = read_fuzz(fuzz);
    const FuzzParameters read = *material.fuzz;
    read_section(fuzz, "fuzz", material);
    material.fuzz = read;
    if (fuzz.has("fibres")) {
      for (const char* key : {"tilt", "azimuth"}) {
        if (fuzz.has(key)) fuzz.fail(key, "left out where \"fibres\" is given");
      }
      material.fuzz_fibres = read_fibres(fuzz, path.parent_path());
    }
    fuzz.allow({"fibres", "approximation"});
    fuzz.finish();
  }
  read_section(json, "", material);
  json.allow({"base", "specular", "fuzz", "lights", "environment", "ambient", "simple_fuzziness"});
  json.finish();
  return std::make_unique<LayeredAppearance>(std::move(material));
}

}  // namespace sateen::brdf
