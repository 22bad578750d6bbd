// SPDX-License-Identifier: MIT
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.h"
#include "commands.h"
#include "json_output.h"
#include "sateen/matcap/decomposition_file.h"

namespace sateen::cli {
namespace {

std::string as_text(const std::filesystem::path& path, const matcap::MatcapDecomposition& matcap) {
  std::string text = fmt::format(
      "{}: decomposed MatCap, {} x {} pixels, sphere at ({:g}, {:g}) of radius {:g}\n", path.string(),
      matcap.width, matcap.height, matcap.disc.x, matcap.disc.y, matcap.disc.radius);
  text += fmt::format("  parts add up in {}; sphere maps of {} texels\n",
                      matcap.space == matcap::AddUpSpace::display ? "sRGB values" : "linear light",
                      matcap[matcap::Part::low].map.levels.front().size());
  for (const matcap::Part which : matcap::kParts) {
    const matcap::MatcapPart& part = matcap[which];
    text += fmt::format(
        "  {:<5} variance {:.5f} ({:.2f} degrees, {}), slope {:.4f}, base colour {:.4f} {:.4f} {:.4f}\n",
        name_of(which), part.variance, degrees(std::sqrt(part.variance)),
        part.measured ? "measured" : "assumed", part.slope(), part.base_color.x(), part.base_color.y(),
        part.base_color.z());
  }
  for (const auto& [key, value] : matcap.provenance) text += fmt::format("  {}: {}\n", key, value);
  return text;
}

}  // namespace

void add_matcap_info(CLI::App& parent) {
  struct MatcapInfoArguments {
    std::filesystem::path input;
    bool json = false;
  };
  auto arguments = std::make_shared<MatcapInfoArguments>();
  CLI::App* command = add_command(parent, "info", "Say everything about a decomposed MatCap",
                                  "sateen matcap info decomposed/lead.ktx2 --json");
  command->add_option("matcap", arguments->input, "The .ktx2 that decompose wrote")->required();
  command->add_flag("--json", arguments->json,
                    "Print JSON: low.variance, low.base_color, high.variance, ...");
  command->callback([arguments] {
    const matcap::MatcapDecomposition matcap = matcap::read_matcap(arguments->input);
    if (!arguments->json) {
      print(as_text(arguments->input, matcap));
      return;
    }
    auto info = nlohmann::json::parse(matcap::matcap_json(matcap));
    info["file"] = arguments->input.string();
    info["version"] = matcap::kMatcapFileVersion;
    info["bytes"] = std::filesystem::file_size(arguments->input);
    print(json_text(info) + "\n");
  });
}

}  // namespace sateen::cli
