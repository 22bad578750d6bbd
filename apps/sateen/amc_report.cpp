// SPDX-License-Identifier: MIT
#include "amc_report.h"

#include "command.h"
#include "sateen/core/direction.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"

namespace sateen::cli {

void add_frame_options(CLI::App& command, FrameArguments& arguments) {
  command.add_option("frames", arguments.inputs, "Square pictures of one full turn, or a folder of them")
      ->required();
  command.add_option("--size", arguments.size, "Texels along each side of a slice (S)")
      ->check(CLI::Range(1, 2048));
  command.add_option("--first-angle", arguments.first_angle,
                     "Tangent angle of the first frame in degrees, counter-clockwise from the right");
  command.add_option("--direction", arguments.direction, "The way the sphere turns, as the pictures show it")
      ->check(CLI::IsMember({"ccw", "cw"}));
  command.add_option("--crop", arguments.crop, "X,Y,SIZE in pixels of the square that just holds the sphere")
      ->delimiter(',')
      ->expected(3);
  command.add_flag("--skip-bad", arguments.skip_bad,
                   "Leave out frames that cannot be read instead of failing");
}

amc::LoadedFrames load(const FrameArguments& arguments) {
  amc::LoadFramesOptions options;
  options.size = arguments.size;
  options.first_angle = wrap(arguments.first_angle / 360);
  options.clockwise = arguments.direction == "cw";
  if (!arguments.crop.empty())
    options.crop = PixelRect{arguments.crop[0], arguments.crop[1], arguments.crop[2], arguments.crop[2]};
  options.skip_bad = arguments.skip_bad;
  options.on_skipped = [](const std::string& why) { warn("left out " + why); };
  options.progress = progress_bar("Reading frames");
  return amc::load_frames(io::expand_inputs(arguments.inputs, io::image_extensions()), options);
}

nlohmann::json to_json(const amc::SymmetryReport& report) {
  nlohmann::json similarities = nlohmann::json::array();
  for (const amc::Similarity& s : report.similarities) {
    similarities.push_back({{"symmetry", s.turns}, {"rmse", s.rmse}, {"psnr", s.psnr}});
  }
  return {{"similarities", similarities},
          {"isotropy", {{"rmse", report.isotropy.rmse}, {"psnr", report.isotropy.psnr}}},
          {"threshold", report.threshold},
          {"symmetry", report.symmetry},
          {"isotropic", report.isotropic},
          {"noise_removed", report.noise_removed}};
}

}  // namespace sateen::cli
