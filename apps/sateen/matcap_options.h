// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "sateen/matcap/decomposition.h"

namespace sateen::cli {

/// What the matcap commands are told about their input pictures.
struct MatcapArguments {
  std::vector<double> disc;  ///< x, y, radius
  bool linear = false;
  bool keep_outliers = false;
  std::vector<std::vector<int>> low_regions;
  std::vector<std::vector<int>> high_regions;
};

void add_matcap_options(CLI::App& command, MatcapArguments& arguments);
void add_region_options(CLI::App& command, MatcapArguments& arguments);

std::optional<matcap::Disc> disc_of(const MatcapArguments& arguments);
matcap::AddUpSpace space_of(const MatcapArguments& arguments);
matcap::Outliers outliers_of(const MatcapArguments& arguments);
/// For low and high. Throws CLI::ValidationError for a region without area.
std::array<std::vector<matcap::Region>, 2> regions_of(const MatcapArguments& arguments);

}  // namespace sateen::cli
