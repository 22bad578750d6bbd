// SPDX-License-Identifier: MIT
#include "capture/judge.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/direction.h"
#include "support/files.h"

namespace sateen::test {
namespace {

void judge_seam(const capture::CaptureResult& result, const Simulation& truth, CaptureErrors& errors) {
  double hit = 0;
  double missed = 0;
  double wrong = 0;
  const Vec3 a = truth.axis();
  const Vec3 x_axis = (Vec3::UnitX() - a * a.x()).normalized();
  for (int y = 0; y < result.seams.mask.size; ++y) {
    for (int x = 0; x < result.seams.mask.size; ++x) {
      const Vec2 disc = disc_of_pixel(x, y, result.seams.mask.size);
      if (disc.norm() > 0.95) continue;
      const Vec3 body =
          disc.x() * x_axis + disc.y() * a.cross(x_axis) + std::sqrt(1 - disc.squaredNorm()) * a;
      const bool seam = truth.in_seam(body);
      const bool found = result.seams.mask.masks(disc);
      hit += seam && found ? 1 : 0;
      missed += seam && !found ? 1 : 0;
      wrong += !seam && found ? 1 : 0;
    }
  }
  errors.seam_recall = hit / std::max(1.0, hit + missed);
  errors.seam_precision = hit / std::max(1.0, hit + wrong);
}

}  // namespace

CaptureErrors judge(const capture::CaptureResult& result, const Simulation& truth) {
  CaptureErrors errors;
  double offset = 0;
  double gain = 0;
  double n = 0;
  for (int i = 0; i < truth.frames; ++i) {
    const capture::CaptureFrame& frame = result.frames[static_cast<std::size_t>(i)];
    if (!frame.used()) continue;
    offset += std::remainder(frame.turned - truth.angle(i), 2 * kPi);
    gain += std::log(frame.gain.y() / truth.gain(i).y());
    ++n;
  }
  offset /= n;
  gain /= n;
  for (int i = 0; i < truth.frames; ++i) {
    const capture::CaptureFrame& frame = result.frames[static_cast<std::size_t>(i)];
    if (!frame.used()) continue;
    errors.centre += (frame.centre - truth.sphere_of(i).centre_pixel(truth.camera())).squaredNorm() / n;
    errors.angle += std::pow(degrees(std::remainder(frame.turned - truth.angle(i) - offset, 2 * kPi)), 2) / n;
    const double exposure = frame.gain.y() / truth.gain(i).y() / std::exp(gain);
    errors.exposure = std::max(errors.exposure, std::abs(exposure - 1));
  }
  errors.centre = std::sqrt(errors.centre);
  errors.angle = std::sqrt(errors.angle);
  errors.radius = std::abs(result.frames[0].radius - truth.radius);
  errors.axis = std::acos(std::min(1.0, result.turn.axis.dot(truth.axis()))) * truth.radius;
  errors.table = table_psnr(result.table.amc, truth, result.table.seen);
  if (truth.seam) judge_seam(result, truth, errors);
  return errors;
}

capture::CaptureOptions informed_options(const Simulation& truth, bool lens) {
  capture::CaptureOptions options;
  options.table.size = 64;
  options.table.slices = 48;
  if (lens) options.lens.fov = 2 * std::atan(truth.width / 2.0 / truth.focal);
  options.tangent.given = true;
  options.tangent.angle = radians(truth.first_angle);
  return options;
}

capture::CaptureOptions small_options(const Simulation& truth) {
  capture::CaptureOptions options = informed_options(truth);
  options.table.size = 48;
  options.table.slices = 24;
  return options;
}

capture::CaptureResult capture_of(const Simulation& simulation, const capture::CaptureOptions& options) {
  const TemporaryFolder folder;
  simulation.write(folder.path());
  return capture::build_capture({folder.path()}, options);
}

}  // namespace sateen::test
