// SPDX-License-Identifier: MIT
#include <filesystem>
#include <memory>

#include <nlohmann/json.hpp>

#include "command.h"
#include "commands.h"
#include "json_output.h"
#include "sateen/scene/registry.h"

namespace sateen::cli {
namespace {

nlohmann::json json_of(const appearance::ParameterValue& value) {
  if (const auto* color = std::get_if<Vec3>(&value)) return {color->x(), color->y(), color->z()};
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* flag = std::get_if<bool>(&value)) return *flag;
  return std::get<std::string>(value);
}

nlohmann::json json_of(const appearance::Appearance& appearance) {
  nlohmann::json list = nlohmann::json::array();
  for (const appearance::Parameter& parameter : appearance.parameters()) {
    nlohmann::json entry{{"name", parameter.name},
                         {"help", parameter.help},
                         {"range", appearance::expectation(parameter)},
                         {"default", json_of(parameter.standard)},
                         {"value", json_of(appearance.get(parameter.name))}};
    if (!parameter.unit.empty()) entry["unit"] = parameter.unit;
    list.push_back(std::move(entry));
  }
  return list;
}

}  // namespace

void add_brdf_parameters(CLI::App& parent) {
  struct Options {
    std::filesystem::path material;
    bool json = false;
  };
  CLI::App* command =
      add_command(parent, "parameters", "List what can be changed of a material, with ranges and defaults",
                  "sateen brdf parameters examples/materials/velvet.json");
  auto options = std::make_shared<Options>();
  command->add_option("material", options->material, "Any material file")->required();
  command->add_flag("--json", options->json,
                    "JSON, with the values the material has, in place of a Markdown table");
  command->callback([options] {
    const auto appearance = scene::load_appearance(options->material);
    print(options->json ? json_text(json_of(*appearance)) + "\n"
                        : appearance::markdown(appearance->parameters()));
  });
}

}  // namespace sateen::cli
