// SPDX-License-Identifier: MIT
#include "sateen/capture/capture.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/simulator.h"
#include "sateen/capture/surface_mask.h"
#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "support/files.h"

namespace sateen {
namespace {

using test::Simulation;
using test::TemporaryFolder;

/// Every nuisance at moderate strength.
Simulation moderate() {
  Simulation s;
  s.unevenness = 0.6;
  s.tilt = {1.2, -0.8};
  s.wobble = {2.5, 1.5};
  s.drift = 0.03;
  s.colour_drift = 0.01;
  s.noise = 1.5;
  s.seam = true;
  return s;
}

CaptureOptions options_for(const Simulation& s) {
  CaptureOptions options;
  options.size = 64;
  options.slices = 48;
  options.fov = 2 * std::atan(s.width / 2.0 / s.focal);
  options.zero_given = true;
  options.zero_angle = radians(s.first_angle);
  return options;
}

CaptureResult captured(const Simulation& s, const CaptureOptions& options) {
  const TemporaryFolder folder;
  s.write(folder.path());
  return build_capture({folder.path()}, options);
}

struct Errors {
  double centre = 0;   // rms, pixels
  double radius = 0;   // pixels
  double axis = 0;     // pixels at the sphere's surface
  double angle = 0;    // rms, degrees, up to a constant
  double angle_worst = 0;
  double exposure = 0; // worst, share
};

Errors errors_of(const CaptureResult& result, const Simulation& s) {
  Errors e;
  const double n = static_cast<double>(result.frames.size());
  double offset = 0;
  double gain = 0;
  for (std::size_t i = 0; i < result.frames.size(); ++i) {
    offset += std::remainder(result.frames[i].turned - s.angle(static_cast<int>(i)), 2 * kPi) / n;
    gain += std::log(result.frames[i].gain.y() / s.gain(static_cast<int>(i)).y()) / n;
  }
  for (std::size_t i = 0; i < result.frames.size(); ++i) {
    const CaptureFrame& frame = result.frames[i];
    const SphereView sphere = s.sphere_of(static_cast<int>(i));
    e.centre += (frame.centre - sphere.centre_pixel(s.camera())).squaredNorm() / n;
    const double off = degrees(std::remainder(frame.turned - s.angle(static_cast<int>(i)) - offset, 2 * kPi));
    e.angle += off * off / n;
    e.angle_worst = std::max(e.angle_worst, std::abs(off));
    e.exposure = std::max(e.exposure, std::abs(frame.gain.y() / s.gain(static_cast<int>(i)).y() / std::exp(gain) - 1));
  }
  e.centre = std::sqrt(e.centre);
  e.angle = std::sqrt(e.angle);
  e.radius = std::abs(result.frames[0].radius - s.radius);
  e.axis = std::acos(std::min(1.0, result.axis.dot(s.axis()))) * s.radius;
  return e;
}

TEST(Capture, ModerateNuisances) {
  const Simulation s = moderate();
  const CaptureResult result = captured(s, options_for(s));
  const Errors e = errors_of(result, s);
  EXPECT_LT(e.centre, 0.3);
  EXPECT_LT(e.radius, 0.3);
  EXPECT_LT(e.axis, 0.5);
  EXPECT_LT(e.angle, 0.2);
  EXPECT_LT(e.exposure, 0.004);
  EXPECT_EQ(result.table.symmetry, 2);
  EXPECT_GT(test::table_psnr(result.table, s, result.seen), 40);
  std::printf("centre %.3f radius %.3f axis %.3f angle %.3f worst %.3f exposure %.4f psnr %.2f\n", e.centre, e.radius,
              e.axis, e.angle, e.angle_worst, e.exposure, test::table_psnr(result.table, s, result.seen));
  for (const auto& w : result.warnings) std::printf("W %s\n", w.c_str());

  // The seam, found with no hint.
  double hit = 0;
  double missed = 0;
  double wrong = 0;
  const Vec3 a = s.axis();
  const Vec3 x_axis = (Vec3::UnitX() - a * a.x()).normalized();
  for (int y = 0; y < result.mask.size; ++y) {
    for (int x = 0; x < result.mask.size; ++x) {
      const Vec2 disc = disc_of_pixel(x, y, result.mask.size);
      if (disc.norm() > 0.95) continue;
      const Vec3 body = disc.x() * x_axis + disc.y() * a.cross(x_axis) + std::sqrt(1 - disc.squaredNorm()) * a;
      const bool truth = s.in_seam(body);
      const bool found = result.mask.masks(disc);
      hit += truth && found ? 1 : 0;
      missed += truth && !found ? 1 : 0;
      wrong += !truth && found ? 1 : 0;
    }
  }
  std::printf("recall %.3f precision %.3f\n", hit / (hit + missed), hit / (hit + wrong));
  EXPECT_GT(hit / (hit + missed), 0.95);
  EXPECT_GT(hit / (hit + wrong), 0.90);
}

}  // namespace
}  // namespace sateen
