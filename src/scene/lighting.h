// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>

#include "sateen/scene/registry.h"

namespace sateen::scene {

/// The light of a scene: what the user asks for, else what its materials name, else a default.
struct LightingOptions {
  std::filesystem::path environment;  ///< latitude-longitude picture that lights the materials; empty: none
  double environment_turn = 0;        ///< radians about the vertical (light::turn_about_vertical)
};

/// The first of the materials that names light decides what `options` leave open: an environment that is
/// asked for replaces "environment" and "ambient" and leaves "lights". Nothing is read for scenes whose light
/// is baked in. Throws Error when an environment is asked for and no material takes light, and what
/// light::read_environment throws.
light::Lighting make_lighting(std::span<const LoadedMaterial> materials, const LightingOptions& options);

/// Whether two of the materials name different light, of which only the first can be had.
bool names_several_lights(std::span<const LoadedMaterial> materials);

}  // namespace sateen::scene
