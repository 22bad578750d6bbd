// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "amc_report.h"
#include "command.h"
#include "commands.h"
#include "json_output.h"

namespace sateen::cli {
namespace {

struct AmcSymmetryArguments {
  FrameArguments frames;
  double threshold = amc::kDefaultSymmetryThreshold;
  bool json = false;
};

std::string as_text(const amc::SymmetryReport& report) {
  std::string text;
  for (const amc::Similarity& s : report.similarities) {
    if (s.turns == 1) continue;
    text += fmt::format("turned by 1/{}: {:5.1f} dB  (rmse {:.4f} of the peak){}\n", s.turns, s.psnr, s.rmse,
                        s.psnr >= report.threshold ? "  alike" : "");
  }
  text += fmt::format("any turn:      {:5.1f} dB  (rmse {:.4f} of the peak){}\n", report.isotropy.psnr,
                      report.isotropy.rmse, report.isotropic ? "  alike: isotropic" : "");
  return text +
         fmt::format(
             "symmetry R = {} at a threshold of {:.1f} dB; averaging removes {:.4f} of the peak as noise\n",
             report.symmetry, report.threshold, report.noise_removed);
}

}  // namespace

void add_amc_symmetry(CLI::App& parent) {
  auto arguments = std::make_shared<AmcSymmetryArguments>();
  CLI::App* command = add_command(parent, "symmetry", "Report which turns leave a captured material alike",
                                  "sateen amc symmetry examples/silk");
  add_frame_options(*command, arguments->frames);
  command->add_option("--threshold", arguments->threshold, "PSNR in dB from which a turn counts as alike");
  command->add_flag("--json", arguments->json, "Print the report as JSON");
  command->callback([arguments] {
    const amc::SymmetryReport report =
        amc::analyse_symmetry(load(arguments->frames).frames, arguments->threshold);
    print(arguments->json ? json_text(to_json(report)) + "\n" : as_text(report));
  });
}

}  // namespace sateen::cli
