// SPDX-License-Identifier: MIT
#include "sateen/scene/lighting.h"

#include <algorithm>

#include <fmt/format.h>

#include "sateen/core/error.h"
#include "sateen/light/default_lighting.h"
#include "sateen/light/environment.h"

namespace sateen::scene {
namespace {

light::Lighting lighting_of(light::DefaultLighting light) {
  return {std::move(light.lamps), light::make_surroundings(light.sky)};
}

bool equal(const appearance::LightingKeys& a, const appearance::LightingKeys& b) {
  const auto same = [](const light::PunctualLight& x, const light::PunctualLight& y) {
    return x.kind == y.kind && x.direction == y.direction && x.position == y.position &&
           x.colour == y.colour && x.inner_cone == y.inner_cone && x.outer_cone == y.outer_cone;
  };
  return a.environment == b.environment && a.ambient == b.ambient &&
         a.lamps.has_value() == b.lamps.has_value() &&
         (!a.lamps || std::ranges::equal(*a.lamps, *b.lamps, same));
}

}  // namespace

light::Lighting make_lighting(std::span<const LoadedMaterial> materials, const LightingOptions& options) {
  const bool lit =
      std::ranges::any_of(materials, [](const LoadedMaterial& m) { return m.appearance->lit(); });
  if (!lit) {
    if (options.environment.empty()) return {};
    throw Error(
        fmt::format("{}: lights nothing here, the materials' light is baked in; only materials of \"model\": "
                    "\"layered\" or \"mapped\" "
                    "take one",
                    options.environment.string()));
  }
  const auto named =
      std::ranges::find_if(materials, [](const LoadedMaterial& m) { return m.lighting.any(); });
  if (!options.environment.empty()) {
    light::Lighting lighting;
    if (named != materials.end() && named->lighting.lamps) lighting.lamps = *named->lighting.lamps;
    lighting.surroundings =
        light::turned(light::make_surroundings(light::read_environment(options.environment)),
                      light::turn_about_vertical(options.environment_turn));
    return lighting;
  }
  return named == materials.end() ? lighting_of(light::default_lighting())
                                  : appearance::make_lighting(named->lighting);
}

bool names_several_lights(std::span<const LoadedMaterial> materials) {
  const appearance::LightingKeys* first = nullptr;
  for (const LoadedMaterial& material : materials) {
    if (!material.lighting.any()) continue;
    if (first && !equal(*first, material.lighting)) return true;
    first = &material.lighting;
  }
  return false;
}

}  // namespace sateen::scene
