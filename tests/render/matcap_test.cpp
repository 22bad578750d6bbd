// SPDX-License-Identifier: MIT
#include "sateen/matcap/matcap.h"

#include "sateen/core/direction.h"
#include "support/rendering.h"
#include "support/shapes.h"

namespace sateen::render {
namespace {

using test::Shot;

std::shared_ptr<matcap::MatCap> matcap() {
  return std::make_shared<matcap::MatCap>(test::test_matcap());
}

// Half floats and the driver's 8-bit filter weights bound what the GPU can do.
constexpr double kTolerance = 2e-3;

TEST(MatCapOnGpu, EqualsTheEvaluatorInEverySwitch) {
  test::Shot picture;
  picture.camera.field_of_view = radians(75);
  for (const scene::Perspective perspective :
       {scene::Perspective::rotation, scene::Perspective::equation4, scene::Perspective::none}) {
    for (const bool renormalise : {true, false}) {
      const scene::RenderSwitches switches{.perspective = perspective, .renormalise = renormalise};
      test::expect_matches_evaluator(test::torus(), matcap(), kTolerance, switches, picture);
    }
  }
}

TEST(MatCapOnGpu, OfAnOrthographicSphereIsThePictureItself) {
  const int size = 96;
  const Image image = test::test_matcap(size);
  const render::Picture frame =
      test::render(test::scene_of(test::sphere(512, 256), std::make_shared<matcap::MatCap>(image)),
                   test::in_view_space(size));
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      // The outermost pixels are replaced by the rim's trusted colour, and the mesh is a polygon there.
      if (disc_of_pixel(x, y, size).norm() > 0.96) continue;
      EXPECT_LT((frame.colour.rgb(x, y) - image.rgb(x, y)).cwiseAbs().maxCoeff(), 4e-3) << x << ", " << y;
    }
  }
}

TEST(MatCapOnGpu, TurningTheObjectLeavesTheLightWhereItIs) {
  const scene::Scene scene = test::scene_of(test::sphere(512, 256), matcap());
  test::Shot picture = test::in_view_space(64);
  const render::Picture still = test::render(scene, picture);
  picture.rotation = rotation_xyz({0.3, 1.2, -0.7});
  const render::Picture turned = test::render(scene, picture);
  test::Difference difference;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      if (disc_of_pixel(x, y, 64).norm() > 0.97) continue;
      difference.add(x, y, (still.colour.rgb(x, y) - turned.colour.rgb(x, y)).cwiseAbs().maxCoeff(), 5e-3);
    }
  }
  EXPECT_EQ(difference.failing, 0) << difference.largest;
}

// A sphere seen from near by: along each view ray that just touches it the eye-frame normal lies on the rim.
// The full rotation gets this right everywhere; equation (4) treats x and y apart and leaves the disc in the
// corners.
TEST(MatCapOnGpu, TheSilhouetteIsTheRimUnderTheRotationButNotUnderEquation4) {
  const auto largest_radius = [](scene::Perspective perspective) {
    scene::Scene scene = test::scene_of(test::sphere(), matcap(), {.perspective = perspective});
    test::Shot picture;
    picture.width = picture.height = 160;
    picture.camera.field_of_view = radians(100);
    const render::Picture frame = test::render(scene, picture);
    double largest = 0;
    for (int y = 0; y < 160; ++y) {
      for (int x = 0; x < 160; ++x) {
        const auto surface = scene::surface_at(*frame.surfaces, x, y);
        if (surface) largest = std::max(largest, surface->eye_normal.head<2>().norm());
      }
    }
    return largest;
  };
  EXPECT_NEAR(largest_radius(scene::Perspective::rotation), 1, 0.01);
  EXPECT_GT(largest_radius(scene::Perspective::equation4), 1.02);
}

TEST(MatCapOnGpu, SurfaceAgreesWithTheDefinitionsInCore) {
  for (const scene::Perspective perspective :
       {scene::Perspective::rotation, scene::Perspective::equation4, scene::Perspective::none}) {
    scene::Scene scene =
        test::scene_of(test::torus(), matcap(),
                       {.tangent_angle = scene::TangentAngle::fragment, .perspective = perspective});
    test::Shot picture;
    picture.camera.field_of_view = radians(80);
    picture.rotation = rotation_xyz({0.5, 0.4, 0.2});
    const render::Picture frame = test::render(scene, picture);
    int compared = 0;
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 128; ++x) {
        const auto s = scene::surface_at(*frame.surfaces, x, y);
        if (!s) continue;
        ++compared;
        const auto corrected = [&](const Vec3& v) {
          if (perspective == scene::Perspective::rotation) return Vec3(eye_frame(s->view) * v);
          return perspective == scene::Perspective::equation4 ? perspective_equation4(v, s->position) : v;
        };
        const Vec3 seen = corrected(s->normal);
        if (seen.z() > 0) {
          EXPECT_LT((s->eye_normal - seen).norm(), 1e-5);
        }
        EXPECT_NEAR(s->normal.dot(s->tangent), 0, 1e-5);
        const double turns = s->tangent_angle - tangent_angle(corrected(s->tangent));
        EXPECT_LT(std::abs(turns - std::round(turns)), 1e-4);
      }
    }
    EXPECT_GT(compared, 3000);
  }
}

TEST(MatCapOnGpu, OcclusionMultiplies) {
  Mesh mesh = test::sphere();
  mesh.occlusion.assign(mesh.positions.size(), 0.25f);
  const render::Picture with = test::render(test::scene_of(mesh, matcap()), test::in_view_space(32));
  const render::Picture without =
      test::render(test::scene_of(mesh, matcap(), {.occlusion = false}), test::in_view_space(32));
  EXPECT_LT((with.colour.rgb(12, 12) - 0.25f * without.colour.rgb(12, 12)).norm(), 1e-5);
  EXPECT_FLOAT_EQ(static_cast<float>(scene::surface_at(*with.surfaces, 12, 12)->occlusion), 0.25f);
}

TEST(MatCapOnGpu, TheBackOfAClothShowsItsTurnedNormalAndTheSameThreads) {
  const scene::Scene scene = test::scene_of(test::plane(), matcap());
  test::Shot picture = test::in_view_space(16);
  const auto front = scene::surface_at(*test::render(scene, picture).surfaces, 8, 8);
  picture.rotation = rotation_xyz({kPi, 0, 0});
  const auto back = scene::surface_at(*test::render(scene, picture).surfaces, 8, 8);
  ASSERT_TRUE(front && back);
  EXPECT_LT((back->normal - Vec3(0, 0, 1)).norm(), 1e-5);
  EXPECT_LT((back->tangent - Vec3(1, 0, 0)).norm(), 1e-5);
  // The bitangent turns with the cloth, so its sign against cross(normal, tangent) changes.
  EXPECT_EQ(front->bitangent_sign, 1);
  EXPECT_EQ(back->bitangent_sign, -1);
}

TEST(MatCapOnGpu, AMeshThatWindsTheOtherWayLooksTheSame) {
  scene::Scene scene = test::scene_of(test::sphere(), matcap());
  const render::Picture expected = test::render(scene, test::in_view_space(32));
  for (auto& triangle : scene.mesh.triangles) std::swap(triangle[1], triangle[2]);
  const render::Picture frame = test::render(scene, test::in_view_space(32));
  EXPECT_LT((expected.colour.rgb(10, 9) - frame.colour.rgb(10, 9)).norm(), 1e-5);
}

TEST(MatCap, LookupIsExactAtTexelCentres) {
  const Image image = test::test_matcap(16);
  const matcap::MatCap matcap(image);
  EXPECT_LT((matcap.lookup(disc_of_pixel(5, 9, 16)) - image.rgb(5, 9).cast<double>()).norm(), 1e-6);
}

TEST(MatCap, BackgroundOutsideTheDiscIsNeverSeen) {
  Image image(33, 33, 3, 0.5f);
  for (int y = 0; y < 33; ++y) {
    for (int x = 0; x < 33; ++x) {
      if (disc_of_pixel(x, y, 33).norm() > 1) image.set_rgb(x, y, {9, 9, 9});
    }
  }
  const matcap::MatCap matcap(image);
  for (int i = 0; i < 630; ++i) {
    const double angle = 0.01 * i;
    EXPECT_LT((matcap.lookup({std::cos(angle), std::sin(angle)}) - Vec3::Constant(0.5)).norm(), 1e-6);
  }
}

TEST(MatCap, AlphaIsDividedOut) {
  Image image(8, 8, 4, 0.25f);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) image.at(x, y, 3) = 0.5f;
  }
  EXPECT_NEAR(matcap::MatCap(image).lookup({0, 0}).x(), 0.5, 1e-6);
}

}  // namespace
}  // namespace sateen::render
