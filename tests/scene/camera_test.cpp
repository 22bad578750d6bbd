// SPDX-License-Identifier: MIT
#include "sateen/scene/camera.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "support/shapes.h"

namespace sateen::scene {
namespace {

TEST(Camera, ViewSpaceTakesCoordinatesAsTheyAre) {
  const std::vector<Mat3> still{Mat3::Identity()};
  const View view = frame_object(test::sphere(), {.kind = Camera::Kind::view_space}, still, 1)[0];
  const Vec4 clip = view.clip_from_view * view.view_from_object * Vec4(0.3, -0.8, 0.1, 1);
  EXPECT_NEAR(clip.x() / clip.w(), 0.3, 1e-12);
  EXPECT_NEAR(clip.y() / clip.w(), -0.8, 1e-12);
  EXPECT_LT(std::abs(clip.z() / clip.w()), 1);
}

TEST(Camera, FillsThePictureFromSideToSide) {
  for (const Camera::Kind kind : {Camera::Kind::perspective, Camera::Kind::orthographic}) {
    for (const double aspect : {0.4, 1.0, 2.5}) {
      const Mesh mesh = test::torus();
      const std::vector<Mat3> poses{rotation_xyz({0.4, -0.9, 2})};
      const View view = frame_object(mesh, {.kind = kind, .margin = 0}, poses, aspect)[0];
      Eigen::AlignedBox2d outline;
      for (const Vec3f& p : mesh.positions) {
        const Vec4 clip = view.clip_from_view * view.view_from_object * p.cast<double>().homogeneous();
        outline.extend(Vec2(clip.head<2>() / clip.w()));
        EXPECT_LT(std::abs(clip.z()), clip.w());
      }
      const int axis = outline.sizes().x() > outline.sizes().y() ? 0 : 1;
      EXPECT_NEAR(outline.min()[axis], -1, 1e-9);
      EXPECT_NEAR(outline.max()[axis], 1, 1e-9);
      EXPECT_NEAR(outline.center()[1 - axis], 0, 0.1);
    }
  }
}

TEST(Camera, LeavesAMarginFree) {
  const std::vector<Mat3> still{Mat3::Identity()};
  const Mesh mesh = test::sphere();
  for (const double margin : {0.04, 0.1}) {
    const View view = frame_object(mesh, {.kind = Camera::Kind::orthographic, .margin = margin}, still, 1)[0];
    double reach = 0;
    for (const Vec3f& p : mesh.positions) {
      const Vec4 clip = view.clip_from_view * view.view_from_object * p.cast<double>().homogeneous();
      reach = std::max(reach, clip.head<2>().cwiseAbs().maxCoeff());
    }
    EXPECT_NEAR(reach, 1 - 2 * margin, 0.05);
    EXPECT_NEAR(reach, 1 / (1 + 2 * margin), 1e-9);
  }
}

TEST(Camera, PixelsAreSquare) {
  const std::vector<Mat3> still{Mat3::Identity()};
  for (const Camera::Kind kind : {Camera::Kind::perspective, Camera::Kind::orthographic}) {
    for (const double aspect : {0.4, 2.5}) {
      const View view = frame_object(test::torus(), {.kind = kind}, still, aspect)[0];
      const auto shown = [&](const Vec3& p) -> Vec2 {
        const Vec4 clip = view.clip_from_view * view.view_from_object * p.homogeneous();
        return clip.head<2>() / clip.w();
      };
      const Vec2 middle = shown({0, 0, 0});
      EXPECT_NEAR((shown({0.1, 0, 0}) - middle).x() * aspect, (shown({0, 0.1, 0}) - middle).y(), 1e-9);
    }
  }
}

TEST(Camera, NearerPointsHaveLessDepth) {
  const std::vector<Mat3> still{Mat3::Identity()};
  for (const Camera::Kind kind :
       {Camera::Kind::perspective, Camera::Kind::orthographic, Camera::Kind::view_space}) {
    const View view = frame_object(test::sphere(), {.kind = kind}, still, 1)[0];
    const Vec4 near = view.clip_from_view * view.view_from_object * Vec4(0, 0, 0.9, 1);
    const Vec4 far = view.clip_from_view * view.view_from_object * Vec4(0, 0, -0.9, 1);
    EXPECT_LT(near.z() / near.w(), far.z() / far.w());
  }
}

TEST(Camera, StaysStillWhileTheObjectTurns) {
  std::vector<Mat3> poses;
  for (int i = 0; i < 8; ++i) poses.push_back(rotation_xyz({0, i * kPi / 4, 0}));
  Mesh mesh = test::sphere();
  for (Vec3f& p : mesh.positions) p = Vec3f(p.x() * 3 + 5, p.y(), p.z());
  const auto views = frame_object(mesh, {}, poses, 1);
  ASSERT_EQ(views.size(), 8u);
  // The middle of the object stays in the middle of the picture, at the same distance.
  for (const View& view : views) {
    EXPECT_TRUE(view.clip_from_view.isApprox(views[0].clip_from_view));
    const Vec4 middle = view.view_from_object * Vec4(5, 0, 0, 1);
    EXPECT_TRUE(middle.isApprox(views[0].view_from_object * Vec4(5, 0, 0, 1), 1e-6));
    EXPECT_NEAR(middle.x(), 0, 1e-6);
  }
}

TEST(Camera, RefusesAnObjectWithoutExtent) {
  const std::vector<Mat3> still{Mat3::Identity()};
  Mesh mesh;
  EXPECT_THROW(frame_object(mesh, {}, still, 1), Error);
  mesh.positions.assign(3, Vec3f(1, 2, 3));
  EXPECT_THROW(frame_object(mesh, {}, still, 1), Error);
}

}  // namespace
}  // namespace sateen::scene
