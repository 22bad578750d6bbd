// SPDX-License-Identifier: MIT
#include <filesystem>
#include <memory>

#include "command.h"
#include "commands.h"
#include "sateen/brdf/plot.h"
#include "sateen/io/file.h"

namespace sateen::cli {

void add_brdf_plot(CLI::App& parent) {
  struct Options {
    std::string model;
    std::filesystem::path parameters;
    std::filesystem::path output;
    std::vector<double> lights = {0, 30, 60};
    bool cosine = false;
  };
  CLI::App* command =
      add_command(parent, "plot", "Draw a reflectance model's lobes and albedo as SVG",
                  "sateen brdf plot ggx --params examples/brdf/ggx.json -o ggx.svg --lights 0,45,75");
  auto options = std::make_shared<Options>();
  const auto models = brdf_models();
  command->add_option("model", options->model, "fibre-diffuse, ggx or fuzz")
      ->required()
      ->check(CLI::IsMember(std::vector<std::string>(models.begin(), models.end())));
  command
      ->add_option("--params", options->parameters,
                   "JSON object with the model's parameters, as for brdf eval")
      ->required();
  command->add_option("--lights", options->lights, "Angles of the lights from the normal, degrees, up to 6")
      ->delimiter(',')
      ->expected(1, 6)
      ->check(CLI::Range(-89.9, 89.9));
  command->add_flag("--cosine", options->cosine, "Lobes times the cosine of the view");
  command->add_option("-o,--output", options->output, "The drawing, .svg")->required();
  command->callback([options] {
    if (options->output.extension() != ".svg") {
      throw CLI::ValidationError("--output", "the drawing is SVG; give a name that ends in .svg");
    }
    PlotSettings settings;
    settings.title = options->model + ", " + options->parameters.filename().string();
    settings.light_angles.clear();
    for (const double angle : options->lights) settings.light_angles.push_back(radians(angle));
    settings.with_cosine = options->cosine;
    settings.view_independent = options->model == "fibre-diffuse";
    write_text(options->output, brdf_plot(read_brdf(options->model, options->parameters), settings));
  });
}

}  // namespace sateen::cli
