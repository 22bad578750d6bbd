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
void add_brdf_eval(CLI::App& parent);
void add_brdf_parameters(CLI::App& parent);
void add_brdf_plot(CLI::App& parent);
void add_capture_build(CLI::App& parent);
void add_capture_calibrate(CLI::App& parent);
void add_capture_live(CLI::App& parent);
void add_maps_aniso_author(CLI::App& parent);
void add_maps_aniso_decode(CLI::App& parent);
void add_maps_aniso_filter(CLI::App& parent);
void add_matcap_bake(CLI::App& parent);
void add_matcap_decompose(CLI::App& parent);
void add_matcap_estimate(CLI::App& parent);
void add_matcap_info(CLI::App& parent);
void add_matcap_separate(CLI::App& parent);
void add_render(CLI::App& parent);
void add_shade(CLI::App& parent);

}  // namespace sateen::cli
