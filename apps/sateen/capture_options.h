// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "sateen/capture/capture.h"

namespace sateen::cli {

/// The options of `capture build`, which `capture live` takes too for the table it makes in the end.
struct CaptureArguments {
  std::filesystem::path report;
  capture::CaptureOptions options;
  std::string symmetry = "auto";
  std::string encoding = "half";
  std::string angles = "auto";
  std::string direction = "ccw";
  std::string response = "auto";
  std::string perspective = "eye";
  std::filesystem::path calibration;
  double fov = 0;
  double first_angle = 0;
  double thread_direction = 0;
  int thread_frame = 0;
  double from_seam = 0;
  double from_weave = 0;
  bool keep_seams = false;
  CLI::Option* first_angle_option = nullptr;
  CLI::Option* thread_option = nullptr;
  CLI::Option* seam_option = nullptr;
  CLI::Option* weave_option = nullptr;
};

void add_capture_options(CLI::App& command, CaptureArguments& arguments);

/// The library's options from the parsed ones. Throws Error for files that are wrong.
capture::CaptureOptions capture_options(const CaptureArguments& arguments);

/// With --angles auto, what the stage of a live capture left in its folder, if that is the only input.
void take_stage_angles(const CaptureArguments& arguments, const std::vector<std::filesystem::path>& inputs,
                       capture::CaptureOptions& options);

/// The files a capture may write. Throws Error when the folder for that cannot be made.
std::vector<std::filesystem::path> capture_outputs(const CaptureArguments& arguments,
                                                   const std::filesystem::path& output);

/// Warnings on stderr, the light of a mirror ball beside `output`, the report if a folder for it was named.
void report_capture(const CaptureArguments& arguments, const std::filesystem::path& output,
                    const capture::CaptureResult& result);

}  // namespace sateen::cli
