// SPDX-License-Identifier: MIT
#include <filesystem>
#include <memory>

#include "brdf_options.h"
#include "command.h"
#include "commands.h"
#include "sateen/brdf/evaluation.h"
#include "sateen/core/parallel.h"

namespace sateen::cli {

void add_brdf_eval(CLI::App& parent) {
  struct Options {
    BrdfArguments brdf;
    std::filesystem::path directions;
    std::filesystem::path output;
  };
  CLI::App* command = add_command(
      parent, "eval", "Evaluate a reflectance model for a list of directions, in double precision",
      "sateen brdf eval ggx --params examples/brdf/ggx.json --directions examples/brdf/directions.json -o "
      "values.json");
  auto options = std::make_shared<Options>();
  add_brdf_options(*command, options->brdf);
  command
      ->add_option(
          "--directions", options->directions,
          "JSON list of {\"light\": [x, y, z], \"view\": [x, y, z]} in the shading frame: tangent x, "
          "bitangent y, normal z, pointing away from the surface")
      ->required();
  command->add_option("-o,--output", options->output, "JSON list of [r, g, b]: the BRDF without the cosine")
      ->required();
  command->callback([options] {
    check_outputs({options->output});
    const brdf::BrdfFunction brdf = brdf::read_brdf(options->brdf.model, options->brdf.parameters);
    const std::vector<brdf::DirectionPair> pairs = brdf::read_direction_pairs(options->directions);
    std::vector<Vec3> values(pairs.size());
    const Progress progress = progress_bar("Evaluating");
    constexpr int kChunk = 64;
    const int chunks = (static_cast<int>(pairs.size()) + kChunk - 1) / kChunk;
    parallel_for(chunks, [&](int chunk) {
      const std::size_t end = std::min(pairs.size(), static_cast<std::size_t>(chunk + 1) * kChunk);
      for (std::size_t i = static_cast<std::size_t>(chunk) * kChunk; i < end; ++i) values[i] = brdf(pairs[i]);
      report(progress, static_cast<double>(chunk + 1) / chunks);
    });
    brdf::write_values(options->output, values);
  });
}

}  // namespace sateen::cli
