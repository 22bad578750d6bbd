// SPDX-License-Identifier: MIT
#include "matcap_options.h"

namespace sateen::cli {
namespace {

std::vector<matcap::Region> to_regions(const std::vector<std::vector<int>>& lists,
                                       const std::string& option) {
  std::vector<matcap::Region> regions;
  for (const auto& list : lists) {
    if (list.size() != 4 || list[2] < 1 || list[3] < 1) {
      throw CLI::ValidationError(option,
                                 "a region is X,Y,WIDTH,HEIGHT in pixels, with width and height above 0");
    }
    regions.push_back({list[0], list[1], list[2], list[3]});
  }
  return regions;
}

}  // namespace

void add_matcap_options(CLI::App& command, MatcapArguments& arguments) {
  command
      .add_option("--disc", arguments.disc,
                  "X,Y,RADIUS in pixels: where the sphere is; otherwise it is found")
      ->delimiter(',')
      ->expected(3);
  command.add_flag("--linear", arguments.linear, "Low and high add up in linear light, not in sRGB values");
  command.add_flag("--keep-outliers", arguments.keep_outliers,
                   "The erosion heeds single black pixels and the outermost ring too");
}

void add_region_options(CLI::App& command, MatcapArguments& arguments) {
  command
      .add_option("--low-roi", arguments.low_regions,
                  "X,Y,WIDTH,HEIGHT around a sharp feature of the low part; may be repeated; otherwise found")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      .add_option("--roi", arguments.high_regions,
                  "The same for the high part: X,Y,WIDTH,HEIGHT in pixels; may be repeated")
      ->delimiter(',')
      ->allow_extra_args(false);
}

std::optional<matcap::Disc> disc_of(const MatcapArguments& arguments) {
  if (arguments.disc.empty()) return std::nullopt;
  return matcap::Disc{arguments.disc[0], arguments.disc[1], arguments.disc[2]};
}

matcap::AddUpSpace space_of(const MatcapArguments& arguments) {
  return arguments.linear ? matcap::AddUpSpace::linear : matcap::AddUpSpace::display;
}

matcap::Outliers outliers_of(const MatcapArguments& arguments) {
  return arguments.keep_outliers ? matcap::Outliers::keep : matcap::Outliers::ignore;
}

std::array<std::vector<matcap::Region>, 2> regions_of(const MatcapArguments& arguments) {
  return {to_regions(arguments.low_regions, "--low-roi"), to_regions(arguments.high_regions, "--roi")};
}

}  // namespace sateen::cli
