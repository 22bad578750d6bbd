// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "sateen/appearance/appearance.h"
#include "sateen/appearance/lighting_keys.h"

namespace sateen::scene {

/// A material file: an appearance, and the light the file names for scenes that have none.
struct LoadedMaterial {
  std::shared_ptr<appearance::Appearance> appearance;
  appearance::LightingKeys lighting;
};

/// The material a file holds: a picture is a plain MatCap; a .ktx2 says what it is in its metadata under
/// "sateen.kind"; a .json material under "model". Throws Error naming the file when it cannot be read or is
/// of no known kind.
LoadedMaterial load_material(const std::filesystem::path& path);

/// Its appearance alone.
std::shared_ptr<appearance::Appearance> load_appearance(const std::filesystem::path& path);

}  // namespace sateen::scene
