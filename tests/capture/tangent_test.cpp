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

namespace sateen::capture {
namespace {

using test::ProgramResult;
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
    io::write_image(folder / fmt::format("frame_{:03}.jpg", i), light);
  }
}

ProgramResult build(const std::filesystem::path& photographs, const std::filesystem::path& report,
                    const Simulation& s, const std::string& how) {
  return run_program(fmt::format("capture build {} -o {} --report {} --size 128 --slices 8 --fov {:.4f} {}",
                                 photographs.string(), (report / "cloth.ktx2").string(), report.string(),
                                 degrees(2 * std::atan(s.width / 2.0 / s.focal)), how));
}

/// The tangent's direction in the first frame, degrees.
double first_angle(const std::filesystem::path& photographs, const Simulation& s, const std::string& how) {
  const test::TemporaryFolder folder;
  const ProgramResult result = build(photographs, folder.path(), s, how);
  EXPECT_EQ(result.exit_code, 0) << result.output;
  const auto report = nlohmann::json::parse(io::read_text(folder / "report.json"));
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

TEST(CaptureTangentCommand, TellsAWeaveFromGrain) {
  Simulation s;
  s.frames = 24;
  s.samples = 1;
  // Uneven cloth, whose grain turns with the sphere, and sensor noise, which does not.
  s.texture = 0.15;
  s.noise = 8;
  const test::TemporaryFolder grainy;
  s.write(grainy.path());
  const ProgramResult result = build(grainy.path(), grainy.path(), s, "--tangent-from-weave 0");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output, testing::HasSubstr("no weave is visible"));
  const test::TemporaryFolder woven;
  write_woven(s, woven.path(), 0.12);
  const double found = first_angle(woven.path(), s, "--tangent-from-weave 0");
  EXPECT_NEAR(std::remainder(found - s.first_angle, 180), 0, 2);
}

}  // namespace
}  // namespace sateen::capture
