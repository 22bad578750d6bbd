// SPDX-License-Identifier: MIT
// Where the tangent's direction comes from, as the command line says.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "capture/altered_frames.h"
#include "capture/simulator.h"
#include "sateen/core/direction.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "support/files.h"

namespace sateen {
namespace {

using test::run_program;
using test::Simulation;

/// Threads that run along the tangent, seven pixels apart.
void write_woven(const Simulation& s, const std::filesystem::path& folder, double depth) {
  const Vec3 a = s.axis();
  const Vec3 x = (Vec3::UnitX() - a * a.x()).normalized();
  const double pole_angle = radians(s.first_angle + 90);
  const Vec3 pole = std::cos(pole_angle) * x + std::sin(pole_angle) * a.cross(x);
  for (int i = 0; i < s.frames; ++i) {
    Image light = test::light_of(s.render(i));
    const Mat3 to_body = Eigen::AngleAxisd(-s.angle(i), a).toRotationMatrix();
    test::multiply_sphere(light, s.camera(), s.sphere_of(i), [&](const Vec3& normal) -> Vec3 {
      const double across = pole.dot(to_body * normal) * s.radius / 7;
      return Vec3::Constant(1 + depth * std::sin(2 * kPi * across));
    });
    write_image(folder / fmt::format("frame_{:03}.jpg", i), light);
  }
}

/// The tangent's direction in the first frame, degrees.
double first_angle(const std::filesystem::path& photographs, const Simulation& s, const std::string& how) {
  const test::TemporaryFolder folder;
  const auto result =
      run_program(fmt::format("capture build {} -o {} --report {} --size 128 --slices 8 --fov {:.4f} {}",
                              photographs.string(), (folder / "cloth.ktx2").string(), folder.path().string(),
                              degrees(2 * std::atan(s.width / 2.0 / s.focal)), how));
  EXPECT_EQ(result.exit_code, 0) << result.output;
  const auto report = nlohmann::json::parse(read_text(folder / "report.json"));
  return report["frames"][0]["angle_degrees"].get<double>();
}

TEST(CaptureTangentCommand, TakesItFromTheWeaveOrAThread) {
  Simulation s;
  s.frames = 24;
  s.samples = 1;
  const test::TemporaryFolder folder;
  write_woven(s, folder.path(), 0.1);
  // A thread has two ends: the weave's direction is known up to half a turn.
  const double across = first_angle(folder.path(), s, "--tangent-from-weave 90");
  EXPECT_NEAR(std::remainder(across - s.first_angle - 90, 180), 0, 1);
  // Frame 6 has turned by a quarter.
  EXPECT_NEAR(first_angle(folder.path(), s, "--thread-direction 115 --thread-frame 6"), 25, 0.2);
}

}  // namespace
}  // namespace sateen
