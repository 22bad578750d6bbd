// SPDX-License-Identifier: MIT
#include "sateen/scene/shade.h"

#include "sateen/amc/appearance.h"
#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/matcap/matcap.h"
#include "sateen/scene/surface_images.h"
#include "support/analytic_material.h"
#include "support/rendering.h"
#include "support/shapes.h"

namespace sateen::scene {
namespace {

using appearance::SurfaceField;

// Two ways to one picture: the rasteriser, and the evaluator over what the rasteriser wrote about the
// surface.
TEST(Shade, OfRenderedNormalsAndTangentsIsTheRenderedPicture) {
  const auto appearance = std::make_shared<amc::AmcAppearance>(test::analytic_table(32, 32, 2));
  for (const Camera::Kind kind : {Camera::Kind::orthographic, Camera::Kind::perspective}) {
    test::Shot picture{.width = 80, .height = 60};
    picture.camera.kind = kind;
    picture.rotation = rotation_xyz({0.7, 0.3, 0.1});
    const Scene scene = test::scene_of(test::torus(), appearance, {.tangent_angle = TangentAngle::fragment});
    const render::Picture frame = test::render(scene, picture);
    ShadeInputs inputs{{SurfaceField::normal, aov(*frame.surfaces, "normal")},
                       {SurfaceField::tangent, aov(*frame.surfaces, "tangent")}};
    if (kind == Camera::Kind::perspective) inputs[SurfaceField::position] = aov(*frame.surfaces, "position");
    const Image shaded = shade(*appearance, inputs);
    test::Difference difference;
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 80; ++x) {
        EXPECT_EQ(shaded.at(x, y, 3), frame.colour.at(x, y, 3));
        difference.add(x, y, (shaded.rgb(x, y) - frame.colour.rgb(x, y)).cwiseAbs().maxCoeff(), 4e-3);
      }
    }
    EXPECT_EQ(difference.failing, 0) << difference.largest;
  }
}

TEST(Shade, TopRowNormalsFaceUpAndZeroIsEmpty) {
  const matcap::MatCap matcap(test::test_matcap());
  Image normals(1, 2, 3);
  normals.set_rgb(0, 0, {0, 1.6f, 1.2f});  // any length
  const Image picture = shade(matcap, {{SurfaceField::normal, normals}});
  EXPECT_NEAR(picture.at(0, 0, 1), 0.9, 1e-3);
  EXPECT_EQ(picture.at(0, 0, 3), 1);
  for (int c = 0; c < 4; ++c) EXPECT_EQ(picture.at(0, 1, c), 0);
}

TEST(Shade, OcclusionMultiplies) {
  const matcap::MatCap matcap(Image(8, 8, 3, 1));
  Image normals(1, 1, 3);
  normals.set_rgb(0, 0, {0, 0, 1});
  EXPECT_NEAR(
      shade(matcap, {{SurfaceField::normal, normals}, {SurfaceField::occlusion, Image(1, 1, 1, 0.25f)}})
          .at(0, 0, 2),
      0.25, 1e-6);
}

/// Shows the tangent it is given.
class Tangents final : public appearance::BakedLight {
 public:
  Vec3 evaluate(const appearance::Surface& s) const override { return s.tangent; }
  appearance::ShaderModule shader() const override { return {}; }
  appearance::ShaderValues values() const override { return {}; }
};

TEST(Shade, TangentsAreMadeUnitAndAcrossTheNormal) {
  Image normals(1, 1, 3);
  normals.set_rgb(0, 0, {0, 0, 2});
  Image tangents(1, 1, 3);
  tangents.set_rgb(0, 0, {0, 3, 4});
  const Image picture =
      shade(Tangents(), {{SurfaceField::normal, normals}, {SurfaceField::tangent, tangents}});
  EXPECT_LT((picture.rgb(0, 0) - Vec3f(0, 1, 0)).norm(), 1e-6f);
}

TEST(Shade, RefusesWhatDoesNotFit) {
  const matcap::MatCap matcap(test::test_matcap());
  const amc::AmcAppearance amc(test::analytic_table(8, 8, 1));
  EXPECT_THROW(shade(matcap, {}), Error);
  EXPECT_THROW(shade(matcap, {{SurfaceField::normal, Image(4, 4, 1)}}), Error);
  EXPECT_THROW(
      shade(matcap, {{SurfaceField::normal, Image(4, 4, 3)}, {SurfaceField::tangent, Image(4, 5, 3)}}),
      Error);
  EXPECT_THROW(
      shade(matcap, {{SurfaceField::normal, Image(4, 4, 3)}, {SurfaceField::tangent, Image(5, 4, 3)}}),
      Error);
  EXPECT_THROW(shade(amc, {{SurfaceField::normal, Image(4, 4, 3)}}), Error);
}

}  // namespace
}  // namespace sateen::scene
