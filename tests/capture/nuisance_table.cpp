// SPDX-License-Identifier: MIT
// Prints the table of errors against nuisances of docs/capture.md, or the rows whose name holds the first
// argument (a second one: with warnings); not a test, it takes minutes.
#include <cstdio>
#include <functional>
#include <string_view>

#include <fmt/format.h>

#include "capture/judge.h"
#include "sateen/core/error.h"

using namespace sateen;

namespace {

std::string_view wanted;  // only rows whose name holds this
bool verbose = false;     // print warnings as well

void row(const char* name, const std::function<void(test::Simulation&, bool& lens_known)>& change) {
  if (std::string_view(name).find(wanted) == std::string_view::npos) return;
  test::Simulation s;
  s.noise = 0.5;
  bool lens = true;
  change(s, lens);
  try {
    const capture::CaptureResult result = test::capture_of(s, test::informed_options(s, lens));
    const test::CaptureErrors errors = test::judge(result, s);
    fmt::print("| {} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.1f} |", name, errors.centre, errors.radius,
               errors.axis, errors.angle, errors.table);
    if (s.seam) {
      fmt::print(" seam recall {:.1f} %, precision {:.1f} %", 100 * errors.seam_recall,
                 100 * errors.seam_precision);
    }
    if (!lens) {
      fmt::print(" focal {:.0f} ({:.0f} to {:.0f}) of {:.0f} px, {}", result.lens.camera.focal.x(),
                 result.lens.estimate->low, result.lens.estimate->high, s.focal, words(result.lens.source));
    }
    fmt::print("\n");
    if (verbose) {
      for (const std::string& warning : result.warnings) fmt::print("    {}\n", warning);
    }
  } catch (const Error& error) {
    fmt::print("| {} | {} |\n", name, error.what());
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1) wanted = argv[1];
  verbose = argc > 2;
  using S = test::Simulation;
  fmt::print(
      "| nuisance | centre, px | radius, px | axis, px | angles, degrees | table, dB "
      "|\n|---|---|---|---|---|---|\n");
  row("none (noise 0.5 codes)", [](S&, bool&) {});
  row("noise 2 codes", [](S& s, bool&) { s.noise = 2; });
  row("noise 5 codes", [](S& s, bool&) { s.noise = 5; });
  row("surface uneven by 15 %", [](S& s, bool&) { s.texture = 0.15; });
  row("surface uneven by 1 %", [](S& s, bool&) { s.texture = 0.01; });
  row("exposure drift 10 %, colour 3 %", [](S& s, bool&) {
    s.drift = 0.1;
    s.colour_drift = 0.03;
  });
  row("axis tilted by 1.5 degrees", [](S& s, bool&) { s.tilt = {1.2, -0.9}; });
  row("axis tilted by 3 degrees", [](S& s, bool&) { s.tilt = {3, 0}; });
  row("axis tilted by 5 degrees", [](S& s, bool&) { s.tilt = {3, -4}; });
  row("axis tilted by 5 degrees, 32 frames", [](S& s, bool&) {
    s.tilt = {-5, 0};
    s.frames = 32;
  });
  row("axis tilted by 5 degrees, uneven steps", [](S& s, bool&) {
    s.tilt = {0, 5};
    s.unevenness = 0.8;
    s.noise = 1.5;
  });
  row("axis tilted by 8 degrees", [](S& s, bool&) { s.tilt = {8, 0}; });
  row("wobble 3 pixels", [](S& s, bool&) { s.wobble = {3, 0}; });
  row("wobble 10 pixels", [](S& s, bool&) { s.wobble = {10, 0}; });
  row("steps uneven by 80 %", [](S& s, bool&) { s.unevenness = 0.8; });
  row("lens blur 2 pixels", [](S& s, bool&) { s.blur = 2; });
  row("lamps 15 radii away", [](S& s, bool&) { s.lamp_distance = 15; });
  row("seam", [](S& s, bool&) { s.seam = true; });
  row("all at moderate strength", [](S& s, bool&) {
    s.unevenness = 0.6;
    s.tilt = {1.2, -0.8};
    s.wobble = {2.5, 1.5};
    s.drift = 0.03;
    s.colour_drift = 0.01;
    s.noise = 1.5;
    s.seam = true;
  });
  row("24 frames", [](S& s, bool&) { s.frames = 24; });
  row("clockwise, uneven, portrait", [](S& s, bool&) {
    s.clockwise = true;
    s.unevenness = 0.8;
    s.width = 360;
    s.height = 640;
    s.centre = {171, 345};
  });
  row("4K", [](S& s, bool&) {
    s.width = 3840;
    s.height = 2160;
    s.focal = 7500;
    s.centre = {2070, 1026};
    s.radius = 672;
    s.frames = 32;
    s.samples = 1;
  });
  row("640 x 480, near", [](S& s, bool&) {
    s.height = 480;
    s.focal = 560;
    s.centre = {325, 231};
    s.radius = 150;
  });
  row("grey photographs", [](S& s, bool&) { s.grey = true; });
  row("post in front", [](S& s, bool&) { s.covered = true; });
  row("post in front, wobble 3 pixels", [](S& s, bool&) {
    s.covered = true;
    s.wobble = {2.5, 1.5};
  });
  row("blurred and repeated frames", [](S& s, bool&) {
    s.shaken = {9, 30};
    s.repeated = {20, 21, 40};
  });
  row("lens unknown, sphere near the middle", [](S&, bool& known) { known = false; });
  row("lens unknown (71 degrees), sphere beside the middle", [](S& s, bool& known) {
    known = false;
    s.focal = 450;
    s.centre = {450, 220};
  });
  row("lens unknown (54 degrees), sphere beside the middle", [](S& s, bool& known) {
    known = false;
    s.focal = 630;
    s.centre = {480, 150};
  });
  row("lens unknown (39 degrees), sphere beside the middle", [](S& s, bool& known) {
    known = false;
    s.focal = 900;
    s.centre = {490, 220};
  });
}
