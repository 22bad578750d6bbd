// SPDX-License-Identifier: MIT
#include "brdf_options.h"

#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sateen/brdf/evaluation.h"

namespace sateen::cli {

void add_brdf_options(CLI::App& command, BrdfArguments& arguments) {
  const auto models = brdf::brdf_models();
  command.add_option("model", arguments.model, fmt::format("One of {}", fmt::join(models, ", ")))
      ->required()
      ->check(CLI::IsMember(std::vector<std::string>(models.begin(), models.end())));
  command
      .add_option("--params", arguments.parameters,
                  "JSON object with the model's parameters (angles in degrees)")
      ->required();
}

}  // namespace sateen::cli
