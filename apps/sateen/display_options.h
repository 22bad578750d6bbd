// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "sateen/core/display.h"

namespace sateen::cli {

/// The options that say how light becomes a picture.
struct DisplayArguments {
  std::string exposure;  ///< stops or auto; empty: auto for lit scenes, otherwise 0
  std::string view;      ///< empty: srgb
};

void add_display_options(CLI::App& command, DisplayArguments& arguments);

/// What to show a picture with that goes to `output`; nothing leaves its light as it is: .exr and .hdr
/// always, and baked light unless an exposure or another view is asked for. `meter` gives an automatic
/// exposure and is called where one is needed; the user is told what it gave. Throws CLI::ValidationError for
/// options that are spelled wrongly.
std::optional<DisplaySettings> display_settings(const DisplayArguments& arguments,
                                                const std::filesystem::path& output, bool lit,
                                                const std::function<double()>& meter);

/// What stands behind a picture: what was asked for, but white, and a word about it, where nothing was and
/// `output` (.jpg, .hdr, a film) cannot be transparent.
std::optional<Vec3f> background_for(const std::filesystem::path& output, std::optional<Vec3f> asked);

}  // namespace sateen::cli
