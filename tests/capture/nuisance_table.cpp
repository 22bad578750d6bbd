// SPDX-License-Identifier: MIT
// Prints the table of errors against nuisances of docs/capture.md, or the rows whose name holds the argument;
// not a test, it takes a minute.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string_view>

#include <fmt/format.h>

#include "capture/simulator.h"
#include "sateen/capture/capture.h"
#include "sateen/core/error.h"
#include "support/files.h"

using namespace sateen;

namespace {

std::string_view wanted;  // only rows whose name holds this

void row(const char* name, const std::function<void(test::Simulation&, CaptureOptions&)>& change) {
  if (std::string_view(name).find(wanted) == std::string_view::npos) return;
  test::Simulation s;
  s.noise = 0.5;
  CaptureOptions options;
  options.size = 64;
  options.slices = 48;
  options.zero_given = true;
  options.zero_angle = radians(s.first_angle);
  change(s, options);
  if (options.fov == 0) options.fov = 2 * std::atan(s.width / 2.0 / s.focal);
  const test::TemporaryFolder folder;
  s.write(folder.path());
  try {
    const CaptureResult result = build_capture({folder.path()}, options);
    double centre = 0;
    double angle = 0;
    double offset = 0;
    const double n = static_cast<double>(result.frames.size());
    for (int i = 0; i < s.frames; ++i) {
      offset += std::remainder(result.frames[static_cast<std::size_t>(i)].turned - s.angle(i), 2 * kPi) / n;
    }
    for (int i = 0; i < s.frames; ++i) {
      const CaptureFrame& frame = result.frames[static_cast<std::size_t>(i)];
      centre += (frame.centre - s.sphere_of(i).centre_pixel(s.camera())).squaredNorm() / n;
      angle += std::pow(degrees(std::remainder(frame.turned - s.angle(i) - offset, 2 * kPi)), 2) / n;
    }
    fmt::print("| {} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.1f} |\n", name, std::sqrt(centre),
               std::abs(result.frames[0].radius - s.radius),
               std::acos(std::min(1.0, result.axis.dot(s.axis()))) * s.radius, std::sqrt(angle),
               test::table_psnr(result.table, s, result.seen));
  } catch (const Error& error) {
    fmt::print("| {} | {} |\n", name, error.what());
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1) wanted = argv[1];
  using S = test::Simulation;
  using O = CaptureOptions;
  fmt::print(
      "| nuisance | centre, px | radius, px | axis, px | angles, degrees | table, dB "
      "|\n|---|---|---|---|---|---|\n");
  row("none (noise 0.5 codes)", [](S&, O&) {});
  row("noise 2 codes", [](S& s, O&) { s.noise = 2; });
  row("noise 5 codes", [](S& s, O&) { s.noise = 5; });
  row("surface uneven by 15 %", [](S& s, O&) { s.texture = 0.15; });
  row("surface uneven by 1 %", [](S& s, O&) { s.texture = 0.01; });
  row("exposure drift 10 %, colour 3 %", [](S& s, O&) {
    s.drift = 0.1;
    s.colour_drift = 0.03;
  });
  row("axis tilted by 3 degrees", [](S& s, O&) { s.tilt = {3, 0}; });
  row("axis tilted by 8 degrees", [](S& s, O&) { s.tilt = {8, 0}; });
  row("wobble 3 pixels", [](S& s, O&) { s.wobble = {3, 0}; });
  row("wobble 10 pixels", [](S& s, O&) { s.wobble = {10, 0}; });
  row("steps uneven by 80 %", [](S& s, O&) { s.unevenness = 0.8; });
  row("lens blur 2 pixels", [](S& s, O&) { s.blur = 2; });
  row("lamps 15 radii away", [](S& s, O&) { s.lamp_distance = 15; });
  row("seam", [](S& s, O&) { s.seam = true; });
  row("24 frames", [](S& s, O&) { s.frames = 24; });
  row("lens unknown (60 degrees assumed)", [](S&, O& o) { o.fov = radians(60); });
}
