// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "sateen/brdf/layered/layered.h"
#include "sateen/brdf/parameters.h"
#include "sateen/core/error.h"
#include "sateen/io/image.h"
#include "sateen/light/default_lighting.h"
#include "sateen/light/environment.h"

namespace sateen::brdf {

namespace {

constexpr double kBrightest = 1e6;

light::PunctualLight read_light(appearance::JsonObject& json) {
  static const std::array<std::string, 3> kinds = {"directional", "point", "spot"};
  light::PunctualLight light;
  const std::string kind = json.choice("kind", "directional", kinds);
  light.kind = kind == "point"  ? light::PunctualLight::Kind::point
               : kind == "spot" ? light::PunctualLight::Kind::spot
                                : light::PunctualLight::Kind::directional;
  light.colour = json.colour("color", light.colour, kBrightest);
  if (light.kind != light::PunctualLight::Kind::point) light.direction = json.direction("direction");
  if (light.kind != light::PunctualLight::Kind::directional) light.position = json.point("position");
  if (light.kind == light::PunctualLight::Kind::spot) {
    light.outer_cone = radians(json.number("outer_cone", 45, {0, 90, true}));
    light.inner_cone = radians(json.number("inner_cone", 0, {0, degrees(light.outer_cone), false, true}));
  }
  json.finish();
  return light;
}

/// The light a material without lights of its own is shown under.
Lighting studio() {
  light::DefaultLighting light = light::default_lighting();
  Lighting lighting;
  lighting.lights = std::move(light.lamps);
  lighting.set_environment(light.sky);
  return lighting;
}

Lighting read_lighting(appearance::JsonObject& json, const std::filesystem::path& path) {
  const bool given = json.has("lights") || json.has("environment") || json.has("ambient");
  if (!given) return studio();
  Lighting lighting;
  if (json.has("lights")) {
    const nlohmann::json& list = json.raw("lights");
    if (!list.is_array() || list.size() > kMaximumLights) {
      json.fail("lights", fmt::format("a list of at most {} lights", kMaximumLights));
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      appearance::JsonObject entry(list[i], fmt::format("{}, light {}", path.string(), i));
      lighting.lights.push_back(read_light(entry));
    }
  }
  if (json.has("environment")) {
    if (json.has("ambient")) json.fail("ambient", "left out where \"environment\" is given");
    lighting.set_environment(light::read_environment(path.parent_path() / json.text("environment", "")));
  }
  if (json.has("ambient")) lighting.harmonics.c[0] = json.colour("ambient", Vec3::Zero(), kBrightest);
  return lighting;
}

void read_base(appearance::JsonObject& json, LayeredMaterial& material) {
  static const std::array<std::string, 3> models = {"lambert", "fibre-diffuse", "maximum-normal"};
  material.base_colour = json.colour("color", material.base_colour);
  const std::string model = json.choice("model", "lambert", models);
  material.base = model == "fibre-diffuse"    ? LayeredMaterial::Base::fibre_diffuse
                  : model == "maximum-normal" ? LayeredMaterial::Base::maximum_normal
                                              : LayeredMaterial::Base::lambert;
  material.base_azimuth = radians(json.number("azimuth", 0, {-360, 360}));
  json.finish();
}

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

}  // namespace

std::unique_ptr<appearance::Appearance> LayeredAppearance::read(const std::filesystem::path& path) {
  return parse(appearance::read_json(path).dump(), path);
}

std::unique_ptr<LayeredAppearance> LayeredAppearance::parse(const std::string& text,
                                                            const std::filesystem::path& path) {
  static const std::array<std::string, 2> approximations = {"table", "slides"};
  const nlohmann::json value = nlohmann::json::parse(text);
  appearance::JsonObject json(value, path.string());
  json.text("model", "layered");
  json.text("name", "");
  LayeredMaterial material;
  const auto section = [&](const char* key) {
    return appearance::JsonObject(json.raw(key), fmt::format("{}, {}", path.string(), key));
  };
  if (json.has("base")) {
    appearance::JsonObject base = section("base");
    read_base(base, material);
  }
  if (json.has("specular")) {
    appearance::JsonObject specular = section("specular");
    material.specular = read_ggx(specular);
    material.lobe_samples = static_cast<int>(specular.number("lobe_samples", 0, {0, 64}));
    specular.finish();
  }
  if (json.has("fuzz")) {
    appearance::JsonObject fuzz = section("fuzz");
    material.fuzz = read_fuzz(fuzz);
    material.fuzz_slides = fuzz.choice("approximation", "table", approximations) == "slides";
    if (fuzz.has("fibres")) {
      for (const char* key : {"tilt", "azimuth"}) {
        if (fuzz.has(key)) fuzz.fail(key, "left out where \"fibres\" is given");
      }
      if (material.fuzz_slides) fuzz.fail("approximation", "\"table\" where \"fibres\" is given");
      material.fuzz_fibres = read_fibres(fuzz, path.parent_path());
    }
    material.fuzz_scattered_down = fuzz.flag("scattered_down", true);
    material.fuzz_smoothing = fuzz.number("normal_smoothing", 0, {0, 1});
    fuzz.finish();
  }
  material.simple_fuzziness = json.number("simple_fuzziness", 0, {0, 1});
  if (material.fuzz && material.simple_fuzziness > 0) {
    json.fail("simple_fuzziness", "left out where \"fuzz\" is given");
  }
  Lighting lighting = read_lighting(json, path);
  json.finish();
  // The studio lamp is a stand-in: an environment from the command line replaces it too.
  auto appearance = std::make_unique<LayeredAppearance>(std::move(material), std::move(lighting));
  appearance->keep_lights_ = json.has("lights");
  return appearance;
}

}  // namespace sateen::brdf
