// SPDX-License-Identifier: MIT
#include "support/golden.h"

#include <gtest/gtest.h>

#include "sateen/amc/appearance.h"
#include "sateen/core/direction.h"
#include "sateen/geometry/tangents.h"
#include "sateen/io/mesh.h"
#include "sateen/matcap/matcap.h"
#include "support/analytic_material.h"
#include "support/files.h"
#include "support/rendering.h"
#include "support/shapes.h"

namespace sateen::render {
namespace {

constexpr int kSide = 160;

Image picture_of(const Mesh& mesh, std::shared_ptr<appearance::Appearance> appearance,
                 const scene::RenderSwitches& switches, const Vec3& degrees) {
  test::Shot picture{.width = kSide, .height = kSide, .samples = 3, .surfaces = false};
  picture.rotation = rotation_xyz(degrees * (kPi / 180));
  return test::render(test::scene_of(mesh, std::move(appearance), switches), picture).colour;
}

std::shared_ptr<appearance::Appearance> satin() {
  return std::make_shared<amc::AmcAppearance>(test::analytic_table(64, 64, 2));
}

TEST(Golden, TorusWithTangentsAroundTheRing) {
  test::expect_golden(picture_of(test::torus(), satin(), {}, {40, 20, 0}), "torus_around");
}

TEST(Golden, TorusWithTangentsAroundTheTube) {
  test::expect_golden(picture_of(test::torus(0.4, 96, 48, true), satin(), {}, {40, 20, 0}), "torus_across");
}

TEST(Golden, TorusWithoutTheCyclicFix) {
  const scene::RenderSwitches naive{.tangent_angle = scene::TangentAngle::naive};
  test::expect_golden(picture_of(test::torus(0.4, 24, 12), satin(), naive, {40, 20, 0}), "torus_naive");
}

TEST(Golden, JacketWithAMatCap) {
  Mesh mesh = io::read_model(test::examples() / "garment" / "jacket.obj").mesh;
  if (mesh.normals.empty()) geometry::compute_normals(mesh);
  mesh.material_ids.clear();
  test::expect_golden(picture_of(mesh, std::make_shared<matcap::MatCap>(test::test_matcap()), {}, {0, 25, 0}),
                      "jacket_matcap");
}

}  // namespace
}  // namespace sateen::render
