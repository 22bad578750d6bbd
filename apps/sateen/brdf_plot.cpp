// SPDX-License-Identifier: MIT
#include <filesystem>
#include <memory>

#include "brdf_options.h"
#include "command.h"
#include "commands.h"
#include "sateen/brdf/plot.h"
#include "sateen/io/file.h"

namespace sateen::cli {

void add_brdf_plot(CLI::App& parent) {
  struct Options {
    BrdfArguments brdf;
    std::filesystem::path output;
    std::vector<double> lights = {0, 30, 60};
    bool cosine = false;
  };
  CLI::App* command =
      add_command(parent, "plot", "Draw a reflectance model's lobes and albedo as SVG",
                  "sateen brdf plot ggx --params examples/brdf/ggx.json -o ggx.svg --lights 0,45,75");
  auto options = std::make_shared<Options>();
  add_brdf_options(*command, options->brdf);
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
    check_outputs({options->output});
    brdf::PlotSettings settings;
    settings.title = options->brdf.model + ", " + options->brdf.parameters.filename().string();
    settings.light_angles.clear();
    for (const double angle : options->lights) settings.light_angles.push_back(radians(angle));
    settings.with_cosine = options->cosine;
    settings.view_independent = options->brdf.model == "fibre-diffuse";
    io::write_text(options->output,
                   brdf::brdf_plot(brdf::read_brdf(options->brdf.model, options->brdf.parameters), settings));
  });
}

}  // namespace sateen::cli
