// SPDX-License-Identifier: MIT
#include "sateen/core/direction.h"

#include <Eigen/Geometry>
#include <random>

#include <gtest/gtest.h>

namespace sateen {
namespace {

Vec3 random_unit(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

TEST(Direction, TheTopRowOfAPictureFacesUp) {
  EXPECT_GT(disc_of_pixel(64, 0, 128).y(), 0.98);
  EXPECT_LT(disc_of_pixel(0, 64, 128).x(), -0.98);
  const Vec2 disc = disc_of_pixel(17, 93, 128);
  EXPECT_TRUE(pixel_of_disc(disc, 128).isApprox(Vec2(17.5, 93.5)));
}

TEST(Direction, TangentAngleCountsTurnsCounterClockwise) {
  EXPECT_DOUBLE_EQ(tangent_angle({1, 0, 0}), 0);
  EXPECT_DOUBLE_EQ(tangent_angle({0, 1, 0.5}), 0.25);
  EXPECT_DOUBLE_EQ(tangent_angle({-1, 0, 0}), 0.5);
  EXPECT_DOUBLE_EQ(tangent_angle({0, -2, 0}), 0.75);
  EXPECT_LT(tangent_angle({1, -1e-30, 0}), 1);
}

TEST(Direction, EyeFrameIsARotationThatTakesTheViewRayToZ) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const Vec3 view = random_unit(random);
    const Mat3 frame = eye_frame(view);
    EXPECT_LT((frame * view - Vec3::UnitZ()).norm(), 1e-12);
    EXPECT_LT((frame * frame.transpose() - Mat3::Identity()).norm(), 1e-12);
    EXPECT_NEAR(frame.determinant(), 1, 1e-12);
  }
}

TEST(Direction, Equation4AgreesWithTheRotationAlongOneAxisAndLeavesTheDiscInCorners) {
  // With p_y = 0 the paper's formula is the rotation about y; in the corner of a wide view it is not one.
  const Vec3 position(0.4, 0, -1);
  const Vec3 normal = Vec3(0.3, 0.1, 0.9).normalized();
  const Vec3 rotated = eye_frame(-position.normalized()) * normal;
  EXPECT_NEAR(perspective_equation4(normal, position).x(), rotated.x(), 1e-12);
  const Vec3 corner(1.03, 0.58, -1);
  int outside = 0;
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 seen = random_unit(random);
    if (seen.dot(-corner) <= 0) continue;
    EXPECT_LE((eye_frame(-corner.normalized()) * seen).head<2>().norm(), 1 + 1e-12);
    outside += perspective_equation4(seen, corner).head<2>().norm() > 1 ? 1 : 0;
  }
  EXPECT_GT(outside, 100);
}

TEST(Direction, FrameAroundIsOrthonormal) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const Vec3 n = random_unit(random);
    Vec3 t;
    Vec3 b;
    frame_around(n, t, b);
    Mat3 m;
    m << t, b, n;
    EXPECT_LT((m * m.transpose() - Mat3::Identity()).norm(), 1e-12);
    EXPECT_NEAR(m.determinant(), 1, 1e-12);
  }
}

TEST(Direction, RotationsAreAboutXThenYThenZ) {
  const auto turned = [](const Vec3& turns, const Vec3& v) {
    return Vec3(rotation_xyz(turns * 2 * kPi) * v);
  };
  EXPECT_LT((turned({0.25, 0, 0}, Vec3::UnitY()) - Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((turned({0, 0.25, 0}, Vec3::UnitZ()) - Vec3::UnitX()).norm(), 1e-12);
  EXPECT_LT((turned({0.25, 0.25, 0}, Vec3::UnitY()) - Vec3::UnitX()).norm(), 1e-12);
  EXPECT_LT((turned({0.25, 0.25, 0.25}, Vec3::UnitY()) - Vec3::UnitY()).norm(), 1e-12);
}

TEST(Direction, NormalsTurnedAwayAreSeenOnTheRim) {
  EXPECT_EQ(seen_normal({0.6, 0, 0.8}), Vec3(0.6, 0, 0.8));
  EXPECT_LT((seen_normal({0.3, -0.4, -std::sqrt(0.75)}) - Vec3(0.6, -0.8, 0)).norm(), 1e-12);
  EXPECT_EQ(seen_normal({0, 0, -1}).head<2>().norm(), 1);
}

TEST(Direction, WrapStaysBelowThePeriod) {
  EXPECT_DOUBLE_EQ(wrap(-0.25), 0.75);
  EXPECT_LT(wrap(-1e-18), 1);
  EXPECT_NEAR(wrap(1.3, 0.5), 0.3, 1e-15);
}

TEST(Direction, TheRotationBetweenDirectionsIsTheSmallest) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto direction = [&] { return Vec3(normal(random), normal(random), normal(random)).normalized(); };
  for (int i = 0; i < 50; ++i) {
    const Vec3 from = direction();
    const Vec3 to = direction();
    const Mat3 expected = Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
    EXPECT_LT((rotation_between(from, to) - expected).norm(), 1e-11);
    for (const double off : {0.0, 1e-14, 1e-12, 1e-7}) {
      const Vec3 opposite = (-from + off * to).normalized();
      const Mat3 rotation = rotation_between(from, opposite);
      EXPECT_LT((rotation * from - opposite).norm(), 1e-14) << off;
      EXPECT_NEAR(rotation.determinant(), 1, 1e-12) << off;
      EXPECT_LT((rotation * rotation.transpose() - Mat3::Identity()).norm(), 1e-12) << off;
    }
  }
}

}  // namespace
}  // namespace sateen
