// SPDX-License-Identifier: MIT
#include <iostream>

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
#include "support/tables.h"

namespace sateen::render {
namespace {

using test::Shot;

std::shared_ptr<appearance::Appearance> amc(amc::AmcTable table) {
  return std::make_shared<amc::AmcAppearance>(std::move(table));
}

test::Difference compare(const render::Picture& a, const render::Picture& b, double tolerance) {
  test::Difference difference;
  for (int y = 0; y < a.colour.height; ++y) {
    for (int x = 0; x < a.colour.width; ++x) {
      if (a.colour.at(x, y, 3) == 0) continue;
      const float apart = (a.colour.rgb(x, y) - b.colour.rgb(x, y)).cwiseAbs().maxCoeff();
      difference.add(x, y, apart, tolerance);
    }
  }
  return difference;
}

TEST(AmcOnGpu, EqualsTheEvaluatorInEverySwitch) {
  test::Shot picture{.width = 96, .height = 96};
  picture.camera.field_of_view = radians(70);
  picture.rotation = rotation_xyz({0.5, 0.3, 0});
  for (const int symmetry : {1, 2, 3}) {
    const auto appearance = amc(test::analytic_table(32, 32, symmetry));
    for (const scene::TangentAngle mode :
         {scene::TangentAngle::vertex, scene::TangentAngle::naive, scene::TangentAngle::fragment}) {
      test::expect_matches_evaluator(test::torus(), appearance, 4e-3, {.tangent_angle = mode}, picture);
    }
  }
  const auto appearance = amc(test::analytic_table(32, 32, 2));
  for (const scene::Perspective perspective : {scene::Perspective::equation4, scene::Perspective::none}) {
    test::expect_matches_evaluator(test::torus(), appearance, 4e-3, {.perspective = perspective}, picture);
  }
  test::expect_matches_evaluator(test::torus(), appearance, 4e-3, {.renormalise = false}, picture);
}

TEST(AmcOnGpu, EightBitTablesAreDecodedFromSrgb) {
  amc::AmcTable table = test::analytic_table(32, 32, 2);
  table.encoding = amc::AmcEncoding::srgb8;
  amc::quantise(table);
  test::expect_matches_evaluator(test::torus(), amc(table), 4e-3);
}

// The point of the data structure: where normals and tangents are those of a captured sphere, the picture is
// the captured frame, whatever the angle, also between two slices.
TEST(AmcOnGpu, OfASphereWithTheCapturesTangentsIsTheCapturedFrame) {
  const auto appearance = amc(test::analytic_table(128, 64, 1));
  for (const double turns : {0.0, 0.13, 0.25, 0.5, 0.71, 0.999}) {
    const scene::Scene scene =
        test::scene_of(test::captured_hemisphere(2 * kPi * turns, 128, 256), appearance);
    const render::Picture frame = test::render(scene, test::in_view_space(64));
    test::Difference difference;
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        const Vec2 disc = disc_of_pixel(x, y, 64);
        if (disc.norm() > 0.95) continue;
        const Vec3 expected = test::analytic_colour(normal_on_disc(disc), turns, 1);
        difference.add(x, y, (expected - frame.colour.rgb(x, y).cast<double>()).cwiseAbs().maxCoeff(), 6e-3);
      }
    }
    EXPECT_GT(difference.pixels, 2500);
    EXPECT_EQ(difference.failing, 0) << turns << " " << difference.largest;
  }
}

TEST(AmcOnGpu, ATableOfHalfATurnLooksLikeTheSameDataOverAFullTurn) {
  const auto half = amc(test::analytic_table(32, 64, 2));
  const auto full = amc(test::table_of(
      32, 128, 1, [](const Vec3& normal, double k) { return test::analytic_colour(normal, k, 2); }));
  test::Shot picture;
  picture.rotation = rotation_xyz({0.5, 0.3, 0});
  for (const scene::TangentAngle mode : {scene::TangentAngle::vertex, scene::TangentAngle::fragment}) {
    const scene::RenderSwitches switches{.tangent_angle = mode};
    const render::Picture a = test::render(test::scene_of(test::torus(), half, switches), picture);
    const render::Picture b = test::render(test::scene_of(test::torus(), full, switches), picture);
    const test::Difference difference = compare(a, b, 2e-3);
    EXPECT_EQ(difference.failing, 0) << difference.largest;
  }
}

TEST(AmcOnGpu, AnIsotropicTableIsThePlainMatCapEverywhere) {
  const amc::AmcTable table =
      test::table_of(64, 16, 1, [](const Vec3& normal, double) { return test::isotropic_colour(normal); });
  const auto matcap = std::make_shared<matcap::MatCap>(amc::isotropic_average(table));
  // Both are filled from the rim by the same rule.
  amc::AmcTable filled = table;
  for (int f = 0; f < table.slices; ++f) amc::set_slice_image(filled, f, matcap->picture());
  test::Shot picture;
  picture.camera.field_of_view = radians(60);
  for (const Mesh& mesh : {test::sphere(), test::torus()}) {
    const render::Picture a = test::render(test::scene_of(mesh, amc(filled)), picture);
    const render::Picture b = test::render(test::scene_of(mesh, matcap), picture);
    const test::Difference difference = compare(a, b, 1e-3);
    EXPECT_EQ(difference.failing, 0) << difference.largest;
  }
}

TEST(AmcOnGpu, TurningTangentsByAPeriodChangesNothingAndByLessDoes) {
  Mesh mesh = test::torus();
  const auto appearance = amc(test::analytic_table(32, 64, 2));
  const render::Picture before = test::render(test::scene_of(mesh, appearance), {});
  geometry::rotate_tangents(mesh, kPi);
  EXPECT_EQ(compare(before, test::render(test::scene_of(mesh, appearance), {}), 2e-3).failing, 0);
  geometry::rotate_tangents(mesh, kPi / 2);
  EXPECT_GT(compare(before, test::render(test::scene_of(mesh, appearance), {}), 0.1).failing_share(), 0.3);
}

/// How far the picture with k from the vertices is from the truth, k taken in every fragment. Where the
/// tangent points at the eye its angle turns through everything inside one triangle, and a few pixels there
/// have no right answer per vertex: `foreshortened` counts the failing ones whose tangent is within 15
/// degrees of the view ray.
struct FromTruth {
  test::Difference elsewhere;
  int foreshortened = 0;
};

FromTruth from_truth(const Mesh& mesh, int symmetry, scene::TangentAngle mode, const test::Shot& picture) {
  constexpr double tolerance = 0.03;
  const auto appearance = amc(test::analytic_table(32, 64, symmetry));
  const render::Picture truth = test::render(
      test::scene_of(mesh, appearance, {.tangent_angle = scene::TangentAngle::fragment}), picture);
  const render::Picture seen =
      test::render(test::scene_of(mesh, appearance, {.tangent_angle = mode}), picture);
  FromTruth result;
  for (int y = 0; y < truth.colour.height; ++y) {
    for (int x = 0; x < truth.colour.width; ++x) {
      const auto surface = scene::surface_at(*truth.surfaces, x, y);
      if (!surface) continue;
      const double apart = (truth.colour.rgb(x, y) - seen.colour.rgb(x, y)).cwiseAbs().maxCoeff();
      if (std::abs(surface->tangent.dot(surface->view)) > std::cos(radians(35))) {
        result.foreshortened += apart > tolerance ? 1 : 0;
      } else {
        result.elsewhere.add(x, y, apart, tolerance);
      }
    }
  }
  return result;
}

void expect_fixed(const Mesh& mesh, int symmetry, const test::Shot& picture) {
  const FromTruth fixed = from_truth(mesh, symmetry, scene::TangentAngle::vertex, picture);
  const FromTruth naive = from_truth(mesh, symmetry, scene::TangentAngle::naive, picture);
  EXPECT_EQ(fixed.elsewhere.failing, 0) << "R = " << symmetry << ", largest " << fixed.elsewhere.largest
                                        << " at " << fixed.elsewhere.x << ", " << fixed.elsewhere.y;
  EXPECT_LE(fixed.foreshortened, fixed.elsewhere.pixels / 1000);
  EXPECT_GT(naive.elsewhere.failing, 50) << "R = " << symmetry;
  std::cout << "R = " << symmetry << ": wrong pixels of " << fixed.elsewhere.pixels << ": "
            << naive.elsewhere.failing << " without the fix, " << fixed.elsewhere.failing << " with it, and "
            << fixed.foreshortened << " where the tangent points at the eye\n";
}

// Figure 9: without the fix, triangles across the cut run through all angles. With it, what remains is how a
// linear k differs from the angle of a linear tangent inside one triangle.
TEST(CyclicFix, LeavesNoWrongPixelOnATorus) {
  test::Shot picture{.width = 256, .height = 256};
  picture.rotation = rotation_xyz({0.6, 0.2, 0});
  for (const bool along_tube : {false, true}) {
    for (const int symmetry : {1, 2, 3})
      expect_fixed(test::torus(0.4, 192, 96, along_tube), symmetry, picture);
  }
}

TEST(CyclicFix, LeavesNoWrongPixelOnAGarment) {
  Mesh mesh = io::read_model(test::examples() / "garment" / "jacket.obj").mesh;
  if (mesh.normals.empty()) geometry::compute_normals(mesh);
  geometry::compute_tangents(mesh);
  // In the large triangles of the file k itself is far from linear: finer ones leave the cut alone to be
  // seen.
  for (int i = 0; i < 2; ++i) mesh = test::subdivided(mesh);
  test::Shot picture{.width = 256, .height = 256};
  picture.rotation = rotation_xyz({0.1, 0.4, 0});
  for (const int symmetry : {1, 2}) expect_fixed(mesh, symmetry, picture);
}

}  // namespace
}  // namespace sateen::render
