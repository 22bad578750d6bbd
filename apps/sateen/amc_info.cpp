// SPDX-License-Identifier: MIT
#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.h"
#include "commands.h"
#include "json_output.h"
#include "sateen/amc/amc_file.h"

namespace sateen::cli {
namespace {

namespace fs = std::filesystem;

std::uintmax_t bytes_on_disk(const fs::path& path) {
  if (!fs::is_directory(path)) return fs::file_size(path);
  std::uintmax_t sum = 0;
  for (const auto& entry : fs::directory_iterator(path))
    sum += entry.is_regular_file() ? entry.file_size() : 0;
  return sum;
}

nlohmann::json describe(const fs::path& path) {
  const amc::AmcTable table = amc::read_amc(path);
  float brightest = 0;
  for (int f = 0; f < table.slices; ++f) {
    for (int y = 0; y < table.size; ++y) {
      for (int x = 0; x < table.size; ++x) brightest = std::max(brightest, table.texel(x, y, f).maxCoeff());
    }
  }
  return {{"file", path.string()},
          {"size", table.size},
          {"slices", table.slices},
          {"symmetry", table.symmetry},
          {"isotropic", table.isotropic},
          {"encoding", table.encoding == amc::AmcEncoding::srgb8 ? "srgb8" : "half"},
          {"bytes", bytes_on_disk(path)},
          {"texel_bytes", amc::encoded_texels(table).size()},
          {"version", amc::kAmcFileVersion},
          {"maximum", brightest},
          {"provenance", table.provenance}};
}

std::string as_text(const nlohmann::json& info) {
  std::string text =
      fmt::format("{}: Anisotropic MatCap, {} x {} x {} texels\n", info["file"].get<std::string>(),
                  info["size"].get<int>(), info["size"].get<int>(), info["slices"].get<int>());
  for (const char* key :
       {"symmetry", "isotropic", "encoding", "bytes", "texel_bytes", "version", "maximum"}) {
    const auto& value = info[key];
    text += fmt::format("  {:<24} {}\n", key,
                        value.is_string() ? value.get<std::string>() : json_text(value, -1));
  }
  for (const auto& [key, value] : info["provenance"].items()) {
    text += fmt::format("  {:<24} {}\n", key, value.get<std::string>());
  }
  return text;
}

}  // namespace

void add_amc_info(CLI::App& parent) {
  struct AmcInfoArguments {
    fs::path input;
    bool json = false;
  };
  auto arguments = std::make_shared<AmcInfoArguments>();
  CLI::App* command =
      add_command(parent, "info", "Say everything about an AMC file", "sateen amc info silk.ktx2 --json");
  command->add_option("amc", arguments->input, "The AMC: .ktx2 or a folder of slices")->required();
  command->add_flag("--json", arguments->json, "Print JSON");
  command->callback([arguments] {
    const nlohmann::json info = describe(arguments->input);
    print(arguments->json ? json_text(info) + "\n" : as_text(info));
  });
}

}  // namespace sateen::cli
