// SPDX-License-Identifier: MIT
#include "sateen/appearance/lighting_keys.h"

#include <array>

#include <fmt/format.h>

#include "sateen/appearance/json_reader.h"
#include "sateen/light/environment.h"

namespace sateen::appearance {
namespace {

constexpr double kBrightest = 1e6;

light::PunctualLight read_lamp(JsonObject& json) {
  using light::PunctualLight;
  static const std::array<std::string, 3> kinds = {"directional", "point", "spot"};
  PunctualLight lamp;
  const std::string kind = json.choice("kind", "directional", kinds);
  lamp.kind = kind == "point"  ? PunctualLight::Kind::point
              : kind == "spot" ? PunctualLight::Kind::spot
                               : PunctualLight::Kind::directional;
  lamp.colour = json.color("color", lamp.colour, kBrightest);
  if (lamp.kind != PunctualLight::Kind::point) lamp.direction = json.direction("direction");
  if (lamp.kind != PunctualLight::Kind::directional) lamp.position = json.point("position");
  if (lamp.kind == PunctualLight::Kind::spot) {
    lamp.outer_cone = radians(json.number("outer_cone", 45, {0, 90, true}));
    lamp.inner_cone = radians(json.number("inner_cone", 0, {0, degrees(lamp.outer_cone), false, true}));
  }
  json.finish();
  return lamp;
}

}  // namespace

LightingKeys read_lighting_keys(JsonObject& json, const std::filesystem::path& file) {
  LightingKeys keys;
  if (json.has("lights")) {
    const nlohmann::json& list = json.raw("lights");
    if (!list.is_array() || list.size() > light::kMaximumLamps) {
      json.fail("lights", fmt::format("a list of at most {} lights", light::kMaximumLamps));
    }
    keys.lamps.emplace();
    for (std::size_t i = 0; i < list.size(); ++i) {
      JsonObject entry(list[i], fmt::format("{}, light {}", file.string(), i));
      keys.lamps->push_back(read_lamp(entry));
    }
  }
  if (json.has("environment")) {
    if (json.has("ambient")) json.fail("ambient", "left out where \"environment\" is given");
    keys.environment = file.parent_path() / json.text("environment", "");
  }
  if (json.has("ambient")) keys.ambient = json.color("ambient", Vec3::Zero(), kBrightest);
  json.allow({"lights", "environment", "ambient"});
  return keys;
}

light::Lighting make_lighting(const LightingKeys& keys) {
  light::Lighting lighting;
  if (keys.lamps) lighting.lamps = *keys.lamps;
  if (!keys.environment.empty()) {
    lighting.surroundings = light::make_surroundings(light::read_environment(keys.environment));
  } else if (keys.ambient) {
    lighting.surroundings = light::even_surroundings(*keys.ambient);
  }
  return lighting;
}

}  // namespace sateen::appearance
