// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace sateen::cli {

// One a file, named like it: amc_build.cpp defines add_amc_build. main.cpp lists them once.
void add_amc_build(CLI::App& parent);
void add_amc_convert(CLI::App& parent);
void add_amc_info(CLI::App& parent);
void add_amc_pictures(CLI::App& parent);
void add_amc_symmetry(CLI::App& parent);
void add_capture_build(CLI::App& parent);
void add_capture_calibrate(CLI::App& parent);
void add_capture_live(CLI::App& parent);

}  // namespace sateen::cli
