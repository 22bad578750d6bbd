// SPDX-License-Identifier: MIT
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/altered_frames.h"
#include "capture/simulator.h"
#include "sateen/capture/exposure/mirror_ball_shot.h"
#include "sateen/capture/sphere/first_look.h"
#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/io/image.h"
#include "support/files.h"

namespace sateen::capture {
namespace {

using test::run_program;
using test::Simulation;

constexpr double kReflectance = 0.6;

/// A room with a bright ceiling and two coloured lamps.
Vec3 room(const Vec3& direction) {
  const auto lamp = [&](const Vec3& towards, double width) {
    const double off = std::acos(std::clamp(direction.dot(towards.normalized()), -1.0, 1.0));
    return std::exp(-off * off / (width * width));
  };
  return Vec3(0.2, 0.22, 0.25) * (1.2 + direction.y()) + Vec3(0.7, 0.5, 0.2) * lamp({0.8, 0.5, 0.4}, 0.3) +
         Vec3(0.1, 0.3, 0.8) * lamp({-0.6, 0.1, -0.5}, 0.2);
}

/// The stand with a chrome ball in place of the sphere, worked out ray by ray.
void write_ball(const Simulation& s, const SphereView& ball, const std::filesystem::path& path) {
  Simulation empty = s;
  empty.sphere = false;
  Image light = test::light_of(empty.render(0));
  const Camera camera = s.camera();
  for (int y = 0; y < light.height; ++y) {
    for (int x = 0; x < light.width; ++x) {
      Vec3 sum(0, 0, 0);
      for (int i = 0; i < 9; ++i) {
        const int row = i / 3;
        const Vec2 p(x + (i % 3 + 0.5) / 3, y + (row + 0.5) / 3);
        Vec3 n;
        if (!normal_at_pixel(camera, ball, p, n)) {
          sum += light.rgb(x, y).cast<double>() / 9;
          continue;
        }
        const Vec3 ray = (ball.centre + n).normalized();
        sum += kReflectance * room(ray - 2 * ray.dot(n) * n) / 9;
      }
      light.set_rgb(x, y, sum.cast<float>());
    }
  }
  io::write_image(path, light);
}

TEST(CaptureMirrorBallCommand, WritesTheRoomBesideTheTable) {
  const Simulation s = test::small_simulation(24);
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "shots");
  s.write(folder / "shots");
  // Another ball, a little larger and not quite in the same place.
  const SphereView ball = sphere_at(s.camera(), s.centre + Vec2(1.5, -1), s.radius * 1.02);
  write_ball(s, ball, folder / "chrome.jpg");
  const auto result = run_program(fmt::format(
      "capture build {} -o {} --size 32 --slices 8 --fov {:.4f} --first-angle 25 --mirror-ball {} "
      "--mirror-reflectance {}",
      (folder / "shots").string(), (folder / "cloth.ktx2").string(),
      degrees(2 * std::atan(s.width / 2.0 / s.focal)), (folder / "chrome.jpg").string(), kReflectance));
  ASSERT_EQ(result.exit_code, 0) << result.output;

  const Image map = io::read_image(folder / "cloth.light.exr");
  double squares = 0;
  double count = 0;
  double worst_behind = 0;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const double longitude = 2 * kPi * ((x + 0.5) / map.width - 0.5);
      const double latitude = kPi * (0.5 - (y + 0.5) / map.height);
      const Vec3 direction(std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                           -std::cos(latitude) * std::cos(longitude));
      const Vec3 error = map.rgb(x, y).cast<double>() - room(direction);
      // The rim squeezes what lies behind the ball into a few pixels; this room is plain there.
      if (direction.dot(-ball.centre.normalized()) < std::cos(radians(150))) {
        worst_behind = std::max(worst_behind, error.cwiseAbs().maxCoeff());
        continue;
      }
      const double area = std::cos(latitude);
      squares += area * error.squaredNorm();
      count += 3 * area;
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 0.02);
  EXPECT_LT(worst_behind, 0.1);
}

TEST(CaptureMirrorBall, APictureWithoutABallIsRefused) {
  Simulation s = test::small_simulation(24);
  s.frames = 12;
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "shots");
  s.write(folder / "shots");
  FrameSource source = FrameSource::open({folder / "shots"}, {});
  const FirstLook look = first_look(source, {s.camera(), FocalSource::calibration, {}}, {});
  const auto complaint = [&](const Image& picture) -> std::string {
    MirrorBallOptions options;
    options.picture = folder / "picture.png";
    io::write_image(options.picture, picture);
    try {
      mirror_ball_shot(options, {}, look);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(complaint(Image(s.width, s.height, 3, 0.3f)), testing::HasSubstr("no ball is found"));
  s.sphere = false;
  EXPECT_THAT(complaint(test::light_of(s.render(0))), testing::HasSubstr("no ball is found"));
}

}  // namespace
}  // namespace sateen::capture
