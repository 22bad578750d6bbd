// SPDX-License-Identifier: MIT
#include <cmath>

#include <gtest/gtest.h>

#include "capture/simulator.h"
#include "sateen/capture/exposure/mirror_ball.h"
#include "sateen/capture/photographs/bracket.h"
#include "sateen/capture/sphere/calibrate.h"
#include "sateen/capture/table/stack.h"
#include "sateen/capture/turning/angles.h"
#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "support/files.h"

namespace sateen::capture {
namespace {

Camera bent_camera() {
  Camera camera = Camera::pinhole(800, 600, 900);
  camera.principal = {410, 293};
  camera.distortion = {-0.21, 0.08, 0.001, -0.002, 0.01};
  return camera;
}

TEST(CaptureCamera, RayAndProjectionAreInverse) {
  const Camera camera = bent_camera();
  for (double x = 20; x < 800; x += 95) {
    for (double y = 20; y < 600; y += 80) {
      EXPECT_LT((camera.project(7 * camera.ray({x, y})) - Vec2(x, y)).norm(), 1e-6);
    }
  }
  EXPECT_GT(camera.ray({410, 100}).y(), 0);
}

TEST(CaptureCamera, KeepsItsNumbersInAFile) {
  const test::TemporaryFolder folder;
  write_camera(folder / "camera.json", bent_camera(), 0.2);
  const Camera camera = read_camera(folder / "camera.json");
  EXPECT_EQ(camera.width, 800);
  EXPECT_EQ(camera.distortion, bent_camera().distortion);
  EXPECT_EQ(camera.principal, bent_camera().principal);
  io::write_text(folder / "bad.json", "{\"width\": 3}");
  EXPECT_THROW(read_camera(folder / "bad.json"), Error);
  EXPECT_THROW(read_camera(folder / "none.json"), Error);
}

TEST(CaptureSphere, OutlineRaysTouchTheSphere) {
  const Camera camera = Camera::pinhole(800, 600, 700);
  const SphereView sphere = sphere_at(camera, {600, 200}, 90);
  for (int i = 0; i < 12; ++i) {
    const Vec3 ray = camera.ray(sphere.outline_pixel(camera, 0.5 * i));
    // Distance of the centre from the ray's line.
    EXPECT_NEAR(sphere.centre.cross(ray).norm(), 1, 1e-9);
  }
  EXPECT_LT((sphere.centre_pixel(camera) - Vec2(600, 200)).norm(), 1e-9);
  EXPECT_NEAR(sphere.radius_pixel(camera), 90, 1e-9);
}

TEST(CaptureSphere, DiscPointsAreTheEyeFrameNormalsOfWhatIsSeen) {
  const Camera camera = Camera::pinhole(800, 600, 700);
  const SphereView sphere = sphere_at(camera, {600, 200}, 120);
  for (double x = -0.9; x < 1; x += 0.3) {
    for (double y = -0.9; y < 1; y += 0.3) {
      const Vec2 disc(x, y);
      if (disc.norm() > 0.98) continue;
      const SeenPoint point = point_of_disc(sphere, disc, TableFrame::eye);
      ASSERT_TRUE(point.visible);
      // The same through the picture: the pixel's ray, the point it meets, that point's eye frame.
      Vec3 normal;
      ASSERT_TRUE(normal_at_pixel(camera, sphere, camera.project(sphere.centre + point.normal), normal));
      EXPECT_LT((normal - point.normal).norm(), 1e-6);
      const Vec3 to_eye = -(sphere.centre + normal).normalized();
      EXPECT_LT(((eye_frame(to_eye) * normal).head<2>() - disc).norm(), 1e-6);
    }
  }
}

TEST(CaptureSphere, ViewFrameHidesTheRim) {
  const SphereView sphere{{0, 0, -3}};
  EXPECT_TRUE(point_of_disc(sphere, {0.5, 0}, TableFrame::view).visible);
  // From three radii away the outline lies where the normal's sine is sqrt(1 - 1/9).
  EXPECT_TRUE(point_of_disc(sphere, {0.94, 0}, TableFrame::view).visible);
  EXPECT_FALSE(point_of_disc(sphere, {0.945, 0}, TableFrame::view).visible);
}

TEST(CaptureTangent, FollowsTheTurnExactlyWhereSeenHeadOn) {
  const AxisFrame axes(Vec3::UnitZ());
  for (const double x : {-0.5, 0.0, 0.6}) {
    SeenPoint point;
    point.normal = normal_on_disc({x, 0.3});
    point.towards_eye = Vec3::UnitZ();
    const TangentAngle tangent(point, TableFrame::eye, axes);
    // Far away and untilted the parallels' picture direction is the same everywhere (section 5.1).
    EXPECT_NEAR(tangent.at(TangentAngle::pole(radians(30), radians(100))), 130.0 / 360, 1e-12);
  }
}

TEST(CaptureAngles, EqualStepsAreToldFromUneven) {
  std::vector<int> places;
  std::vector<double> angles;
  std::vector<double> uneven;
  for (int i = 0; i < 40; ++i) {
    places.push_back(i);
    angles.push_back(wrap(2 * kPi * i / 40 + 0.001 * std::sin(7.0 * i), 2 * kPi));
    uneven.push_back(wrap(2 * kPi * i / 40 + 0.05 * std::sin(7.0 * i), 2 * kPi));
  }
  const EqualSteps steps = equal_steps(places, angles, 40, 0.004);
  EXPECT_TRUE(steps.found);
  EXPECT_DOUBLE_EQ(steps.step, 2 * kPi / 40);
  EXPECT_FALSE(equal_steps(places, uneven, 40, 0.004).found);
  angles.resize(30);
  EXPECT_NEAR(coverage(angles, 2 * kPi).widest, 2 * kPi * 11 / 40, 0.01);
}

TEST(CaptureBracket, MergesWhatEachExposureCanSee) {
  const std::vector<double> times{0.01, 0.08};
  Image light(3, 1, 3);
  for (int x = 0; x < 3; ++x) light.set_rgb(x, 0, Vec3f::Constant(x == 0 ? 0.02f : x == 1 ? 0.6f : 4.0f));
  std::vector<Photograph> group;
  for (const double time : times) {
    Image shot = light;
    for (float& v : shot.data) v = std::min(1.0f, v * static_cast<float>(time / 0.08));
    group.emplace_back(shot, 0.995f);
  }
  const Photograph merged = merge_brackets(group, times);
  for (int x = 0; x < 3; ++x) EXPECT_NEAR(merged.rgb(x, 0)[0] / light.at(x, 0, 0), 1, 1e-3);
  EXPECT_FALSE(merged.clipped(2, 0));
  EXPECT_TRUE(group[1].clipped(2, 0));
}

TEST(CaptureMirrorBall, FindsTheLampWhereItIs) {
  // A chrome ball under one small lamp: what the picture shows is worked out ray by ray, by reflection.
  const Camera camera = Camera::pinhole(400, 300, 600);
  const SphereView ball = sphere_at(camera, {220, 140}, 90);
  const Vec3 lamp = Vec3(0.5, 0.6, 0.3).normalized();
  Image picture(400, 300, 3);
  for (int y = 0; y < 300; ++y) {
    for (int x = 0; x < 400; ++x) {
      Vec3 n;
      const Vec2 p(x + 0.5, y + 0.5);
      if (!normal_at_pixel(camera, ball, p, n)) continue;
      const Vec3 d = camera.ray(p);
      const Vec3 reflected = d - 2 * d.dot(n) * n;
      const double off = std::acos(std::min(1.0, reflected.dot(lamp)));
      picture.set_rgb(x, y, Vec3f::Constant(static_cast<float>(0.6 * std::exp(-off * off / 0.02))));
    }
  }
  const Image map = mirror_ball_environment(Photograph(picture, 10), camera, ball, 256, 0.6);
  Vec3 sum(0, 0, 0);
  float brightest = 0;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const double a = 2 * kPi * ((x + 0.5) / map.width - 0.5);
      const double b = kPi * (0.5 - (y + 0.5) / map.height);
      const Vec3 direction(std::cos(b) * std::sin(a), std::sin(b), -std::cos(b) * std::cos(a));
      sum += static_cast<double>(map.at(x, y, 0)) * std::cos(b) * direction;
      brightest = std::max(brightest, map.at(x, y, 0));
    }
  }
  EXPECT_LT(degrees(std::acos(sum.normalized().dot(lamp))), 0.5);
  EXPECT_NEAR(brightest, 1, 0.03);
}

TEST(CaptureCalibration, NeedsBoards) {
  const test::TemporaryFolder folder;
  test::Simulation s;
  s.width = 160;
  s.height = 90;
  s.radius = 20;
  s.centre = {80, 45};
  s.frames = 6;
  s.write(folder.path());
  std::vector<std::filesystem::path> files;
  for (int i = 0; i < 6; ++i) files.push_back(folder / fmt::format("frame_{:03}.png", i));
  EXPECT_THROW(calibrate(files, 9, 6), Error);
}

TEST(CaptureCalibration, RecoversTheLens) {
  const test::TemporaryFolder folder;
  Camera truth = Camera::pinhole(640, 480, 620);
  truth.principal = {326, 236};
  truth.distortion = {-0.15, 0.05, 0, 0, 0};
  std::vector<std::filesystem::path> files;
  for (int i = 0; i < 8; ++i) {
    files.push_back(folder / fmt::format("board_{}.png", i));
    const Mat3 turned = rotation_xyz({0.35 * std::sin(1.7 * i), 0.4 * std::cos(2.3 * i), 0.2 * std::sin(i)});
    test::draw_chessboard(files.back(), truth, turned, Vec3(0.5 * std::sin(i), 0.4 * std::cos(1.3 * i), -12),
                          9, 6);
  }
  const Calibration found = calibrate(files, 9, 6);
  EXPECT_EQ(found.used, 8);
  EXPECT_LT(found.rms_pixels, 0.2);
  EXPECT_NEAR(found.camera.focal.x(), 620, 4);
  EXPECT_LT((found.camera.principal - truth.principal).norm(), 4);
  EXPECT_NEAR(found.camera.distortion[0], -0.15, 0.03);
}

}  // namespace
}  // namespace sateen::capture
