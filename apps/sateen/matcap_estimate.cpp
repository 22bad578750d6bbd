// SPDX-License-Identifier: MIT
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.h"
#include "commands.h"
#include "json_output.h"
#include "matcap_options.h"
#include "sateen/io/file.h"
#include "sateen/matcap/matcap_picture.h"
#include "sateen/matcap/signature_plot.h"
#include "sateen/matcap/warp.h"

namespace sateen::cli {
namespace {

struct MatcapEstimateArguments {
  MatcapArguments matcap;
  std::filesystem::path input;
  std::filesystem::path plot;
  bool json = false;
};

const char* name_of_case(matcap::Signature::Case found) {
  switch (found) {
    case matcap::Signature::Case::minimum:
      return "minimum";
    case matcap::Signature::Case::inflection:
      return "inflection";
    case matcap::Signature::Case::widest:
      return "widest";
    case matcap::Signature::Case::degenerate:
      return "degenerate";
  }
  return "";
}

nlohmann::json to_json(const matcap::FilterEstimate& estimate) {
  nlohmann::json regions = nlohmann::json::array();
  for (const matcap::Region& r : estimate.regions) regions.push_back({r.x, r.y, r.width, r.height});
  nlohmann::json curve = nlohmann::json::array();
  const matcap::Signature& s = estimate.signature;
  for (std::size_t i = 0; i < s.eps.size(); ++i) {
    // Degenerate windows become null.
    curve.push_back(
        {{"window", s.eps[i]},
         {"variance", std::isfinite(s.variance[i]) ? nlohmann::json(s.variance[i]) : nlohmann::json()}});
  }
  nlohmann::json result{{"variance", estimate.variance},
                        {"slope", matcap::slope_of_variance(estimate.variance)},
                        {"measured", estimate.measured},
                        {"automatic", estimate.automatic},
                        {"feature", estimate.feature == matcap::Feature::edge ? "edge" : "line"},
                        {"case", name_of_case(s.found)},
                        {"regions", regions},
                        {"signature", curve}};
  if (s.chosen) result["window"] = s.eps[*s.chosen];
  return result;
}

std::string as_text(const char* name, const matcap::FilterEstimate& estimate) {
  return fmt::format("{:<5} variance {:.5f} ({:.2f} degrees), slope {:.4f}, {}\n", name, estimate.variance,
                     degrees(std::sqrt(estimate.variance)), matcap::slope_of_variance(estimate.variance),
                     estimate.measured ? (estimate.feature == matcap::Feature::edge ? "measured at an edge"
                                                                                    : "measured at a line")
                                       : "assumed: nothing sharp enough to measure");
}

void run(const MatcapEstimateArguments& arguments) {
  check_outputs({arguments.plot});
  const std::string name = arguments.input.string();
  const auto regions = regions_of(arguments.matcap);
  const matcap::MatcapPicture picture =
      matcap::read_matcap_picture(arguments.input, disc_of(arguments.matcap));
  const matcap::Separation parts =
      matcap::separate(matcap::to_add_up_space(picture.image, space_of(arguments.matcap)), picture.disc,
                       outliers_of(arguments.matcap), name);
  const auto estimate = [&](const Image& component, const std::vector<matcap::Region>& given,
                            double fallback) {
    return given.empty() ? matcap::estimate_filter(component, picture.disc, fallback)
                         : matcap::estimate_filter(component, picture.disc, given, fallback, name);
  };
  const matcap::FilterEstimate low = estimate(parts.low, regions[0], matcap::kLambertian);
  const matcap::FilterEstimate high = estimate(parts.high, regions[1], matcap::kSatin);
  if (!arguments.plot.empty()) {
    const std::vector<matcap::LabelledEstimate> curves{{"low", low}, {"high", high}};
    io::write_text(arguments.plot, matcap::signature_svg(curves));
  }
  if (arguments.json) {
    print(json_text(nlohmann::json{{"low", to_json(low)}, {"high", to_json(high)}}) + "\n");
  } else {
    print(as_text("low", low) + as_text("high", high));
  }
}

}  // namespace

void add_matcap_estimate(CLI::App& parent) {
  auto arguments = std::make_shared<MatcapEstimateArguments>();
  CLI::App* command = add_command(parent, "estimate", "Measure how much a MatCap's material blurs its light",
                                  "sateen matcap estimate examples/matcaps/lead.exr --plot signatures.svg");
  command->add_option("matcap", arguments->input, "The MatCap, any picture")->required();
  command->add_option("--plot", arguments->plot, "Signature curves as SVG");
  command->add_flag("--json", arguments->json, "Print the estimates and the curves as JSON");
  add_region_options(*command, arguments->matcap);
  add_matcap_options(*command, arguments->matcap);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace sateen::cli
