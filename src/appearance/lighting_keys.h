// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "sateen/light/lighting.h"

namespace sateen::appearance {

class JsonObject;

/// The light a material file names. It is the scene's, not the material's: a scene that has none takes it up.
struct LightingKeys {
  std::optional<std::vector<light::PunctualLight>> lamps;  ///< "lights"
  std::filesystem::path environment;  ///< "environment", a latitude-longitude picture; empty: none
  std::optional<Vec3> ambient;        ///< "ambient", radiance from all around
  bool any() const { return lamps || ambient || !environment.empty(); }
};

/// Reads the keys lights, environment and ambient; pictures lie beside `file`. Throws Error naming file, key
/// and value.
LightingKeys read_lighting_keys(JsonObject& json, const std::filesystem::path& file);

/// The light that is named; an environment is read now. Throws what light::read_environment throws.
light::Lighting make_lighting(const LightingKeys& keys);

}  // namespace sateen::appearance
