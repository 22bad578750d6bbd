// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "sateen/appearance/appearance.h"

namespace sateen::scene {

/// The appearance a file holds: a picture is a plain MatCap; a .ktx2 says what it is in its metadata under
/// "sateen.kind"; a .json material under "model". Throws Error naming the file when it cannot be read or is
/// of no known kind.
std::unique_ptr<appearance::Appearance> load_appearance(const std::filesystem::path& path);

/// The same, lit by a latitude-longitude picture. Throws Error too when the appearance's light is baked in.
std::unique_ptr<appearance::Appearance> load_appearance(const std::filesystem::path& path,
                                                        const Image& environment);

}  // namespace sateen::scene
