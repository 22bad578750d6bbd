// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "sateen/amc/build.h"

namespace sateen::cli {

/// What `amc build` and `amc symmetry` are told about the frames.
struct FrameArguments {
  std::vector<std::filesystem::path> inputs;
  int size = 128;
  double first_angle = 0;  ///< degrees
  std::string direction = "ccw";
  std::vector<int> crop;
  bool skip_bad = false;
};

void add_frame_options(CLI::App& command, FrameArguments& arguments);
amc::LoadedFrames load(const FrameArguments& arguments);

nlohmann::json to_json(const amc::SymmetryReport& report);

}  // namespace sateen::cli
