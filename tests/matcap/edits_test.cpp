// SPDX-License-Identifier: MIT
#include "sateen/matcap/edits.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sateen/core/colour.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/matcap/bake.h"
#include "sateen/matcap/decomposition_file.h"
#include "sateen/matcap/filter_estimate.h"
#include "sateen/matcap/sphere_blur.h"
#include "sateen/matcap/warp.h"
#include "support/matcaps.h"

namespace sateen::matcap {
namespace {

using testing::HasSubstr;

const MatcapDecomposition& lead() {
  static const MatcapDecomposition matcap =
      decompose(test::example_matcap("lead", 96), inscribed_disc(96, 96), {}, "lead");
  return matcap;
}

EditedMatcap edited(const std::string& json, const std::filesystem::path& folder = {}) {
  return apply_edits(lead(), parse_edits(json, folder, "edits.json"));
}

std::string complaint(const std::string& json) {
  try {
    edited(json);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// The normal at which a part of a baked MatCap is brightest.
Vec2 brightest_point(const EditedMatcap& matcap, Part part) {
  Vec2 best(0, 0);
  double most = -1;
  for (double y = -0.98; y < 1; y += 0.02) {
    for (double x = -0.98; x < 1; x += 0.02) {
      if (x * x + y * y > 0.96) continue;
      const double v = evaluate_part(matcap, part, normal_on_disc({x, y})).sum();
      if (v > most) {
        most = v;
        best = {x, y};
      }
    }
  }
  return best;
}

TEST(Edits, AnEmptyListChangesNothing) {
  EXPECT_EQ(bake(edited("[]")).data, bake(unedited(lead())).data);
}

TEST(Edits, TurnsAddUpAndCancel) {
  const EditedMatcap matcap =
      edited(R"([{"edit": "turn", "degrees": [0, 40, 0]}, {"edit": "turn", "degrees": [0, -40, 0]}])");
  EXPECT_TRUE(matcap.light.isApprox(Mat3::Identity()));
  const Mat3 twice =
      edited(R"([{"edit": "turn", "degrees": [90, 0, 0]}, {"edit": "turn", "degrees": [0, 90, 0]}])").light;
  EXPECT_TRUE((twice * Vec3::UnitY()).isApprox(Vec3::UnitX(), 1e-9));  // y to z, then z to x
}

TEST(Edits, AlignBringsTheMainHighlightToAPoint) {
  const Vec2 at = brightest_point(edited(R"([{"edit": "align", "to": [-0.4, 0.3]}])"), Part::high);
  EXPECT_LT((at - Vec2(-0.4, 0.3)).norm(), 0.06);
}

TEST(Edits, PaintAppearsWhereItWasPutAndTurnsWithTheLight) {
  const std::string paint =
      R"({"edit": "paint", "part": "high", "at": [-0.5, -0.4], "size": 6, "intensity": 30})";
  EXPECT_LT((brightest_point(edited("[" + paint + "]"), Part::high) - Vec2(-0.5, -0.4)).norm(), 0.05);
  // Painted before or after a turn, it is where it was put when it was put.
  const std::string turn = R"({"edit": "turn", "degrees": [10, 30, 0]})";
  EXPECT_LT((brightest_point(edited("[" + turn + "," + paint + "]"), Part::high) - Vec2(-0.5, -0.4)).norm(),
            0.05);
  const EditedMatcap moved = edited("[" + paint + "," + turn + "]");
  const Vec3 seen = warp(normal_on_disc(brightest_point(moved, Part::high)), lead()[Part::high].slope());
  const Vec3 put = warp(normal_on_disc({-0.5, -0.4}), lead()[Part::high].slope());
  EXPECT_LT(test::angle_between(seen, rotation_xyz({radians(10), radians(30), 0}) * put), 0.12);
}

TEST(Edits, AnglesAreDegreesInFilesAndBoxesAreGivenWhole) {
  const std::vector<Edit> edits = parse_edits(
      R"([{"edit": "color", "part": "low", "hue": 90},
          {"edit": "paint", "part": "high", "at": [0, 0], "shape": "box", "size": [20, 5], "softness": 2, "turn": 30}])",
      {}, "edits");
  EXPECT_NEAR(std::get<Recolor>(edits[0]).hue, 0.25, 1e-12);  // turns
  const Paint& paint = std::get<Paint>(edits[1]);
  EXPECT_NEAR(paint.turn, radians(30), 1e-12);
  EXPECT_NEAR(paint.footprint.softness, radians(2), 1e-12);
  EXPECT_LT((paint.footprint.size - Vec2(radians(10), radians(2.5))).norm(), 1e-12);
}

TEST(Edits, PaintTurnsCounterClockwise) {
  // A bar along x, turned.
  const EditedMatcap bar = edited(
      R"([{"edit": "paint", "part": "high", "at": [0, 0], "shape": "box", "size": [80, 4], "turn": 40, "intensity": 30}])");
  const auto added = [&](double angle) {
    const Vec3 n = normal_on_disc(0.2 * Vec2(std::cos(radians(angle)), std::sin(radians(angle))));
    return (evaluate_part(bar, Part::high, n) - evaluate_part(unedited(lead()), Part::high, n)).sum();
  };
  EXPECT_GT(added(40), 5 * added(-40));
  EXPECT_GT(added(40), 5 * added(0));
}

TEST(Edits, FootprintsAreBlurredInClosedForm) {
  const LightPlace place{test::direction_at(0.7, 2), Vec3::UnitY()};
  for (const Footprint& footprint : {Footprint{Footprint::Shape::gaussian, {0.12, 0.12}, 0},
                                     Footprint{Footprint::Shape::box, {0.3, 0.2}, 0.05}}) {
    SphereMap sharp = make_sphere_map(160, [](const Vec3&) -> Vec3 { return Vec3::Zero(); });
    SphereMap closed = sharp;
    paint(sharp, place, footprint, Vec3::Ones(), 0);
    paint(closed, place, footprint, Vec3::Ones(), 0.01);
    const SphereMap numeric = blurred(sharp, 0.01, 160);
    for (double theta = 0; theta < 1.6; theta += 0.05) {
      const Vec3 w = test::direction_at(theta, 1.8);
      EXPECT_NEAR(sample(closed, w).x(), sample(numeric, w).x(), 0.02) << theta;
    }
  }
}

TEST(Edits, RougherIsBlurredAndBendsLess) {
  const EditedMatcap rough = edited(R"([{"edit": "roughness", "part": "high", "add": 0.05}])");
  const MatcapPart& part = rough.matcap[Part::high];
  EXPECT_NEAR(part.variance, lead()[Part::high].variance + 0.05, 1e-12);
  EXPECT_LT(part.slope(), lead()[Part::high].slope());
  const Vec3 highlight = main_highlight(lead());
  EXPECT_LT(sample(part.map, highlight, 0).x(), 0.6 * sample(lead()[Part::high].map, highlight, 0).x());
  const EditedMatcap shiny = edited(R"([{"edit": "roughness", "part": "high", "add": -0.003}])");
  EXPECT_GT(sample(shiny.matcap[Part::high].map, highlight, 0).x(),
            1.08 * sample(lead()[Part::high].map, highlight, 0).x());
  EXPECT_THAT(complaint(R"([{"edit": "roughness", "part": "high", "add": -0.5}])"), HasSubstr("variance"));
  const EditedMatcap absolute = edited(R"([{"edit": "roughness", "part": "high", "degrees": 12}])");
  EXPECT_NEAR(std::sqrt(absolute.matcap[Part::high].variance), radians(12), 1e-9);
  const EditedMatcap flat = edited(R"([{"edit": "roughness", "part": "high", "add": 0.8277}])");
  EXPECT_EQ(flat.matcap[Part::high].variance, kFlattest);
}

TEST(Edits, HueGoesRoundAndSaturationEndsAtOne) {
  MatcapDecomposition orange = lead();
  orange[Part::low].base_color = {0.8, 0.4, 0.2};
  const auto recoloured = [&](const std::string& edit) {
    return apply_edits(orange, parse_edits(edit, {}, "edits")).look(Part::low).base_color;
  };
  EXPECT_LT((recoloured(R"([{"edit": "color", "part": "low", "hue": 120}])") - Vec3(0.2, 0.8, 0.4)).norm(),
            1e-9);
  EXPECT_LT((recoloured(R"([{"edit": "color", "part": "low", "hue": -120}])") - Vec3(0.4, 0.2, 0.8)).norm(),
            1e-9);
  EXPECT_LT(
      (recoloured(R"([{"edit": "color", "part": "low", "saturation": 50}])") - Vec3(0.8, 0.8 / 3, 0)).norm(),
      1e-9);
}

TEST(Edits, ColorIntensityAndSilhouetteActOnTheirPart) {
  const Vec3 n = normal_on_disc({0.3, 0.2});
  const EditedMatcap plain = unedited(lead());
  const EditedMatcap twice = edited(R"([{"edit": "intensity", "part": "high", "factor": 2}])");
  EXPECT_TRUE(evaluate_part(twice, Part::high, n).isApprox(2 * evaluate_part(plain, Part::high, n)));
  EXPECT_EQ(evaluate_part(twice, Part::low, n), evaluate_part(plain, Part::low, n));
  const EditedMatcap six = edited(
      R"([{"edit": "intensity", "part": "high", "factor": 2}, {"edit": "intensity", "part": "high", "factor": 3}])");
  EXPECT_EQ(six.look(Part::high).intensity, 6);
  const EditedMatcap red = edited(R"([{"edit": "color", "part": "low", "saturation": 0, "value": 0.5}])");
  EXPECT_NEAR(red.look(Part::low).base_color.maxCoeff(), 0.5 * plain.look(Part::low).base_color.maxCoeff(),
              1e-9);
  EXPECT_NEAR(rgb_to_hsv(red.look(Part::low).base_color).y(), 0, 1e-9);

  const EditedMatcap rim =
      edited(R"([{"edit": "silhouette", "part": "low", "theta0": 30, "m1": 0.5, "alpha1": 2}])");
  EXPECT_EQ(evaluate_part(rim, Part::low, Vec3::UnitZ()), evaluate_part(plain, Part::low, Vec3::UnitZ()));
  const double t = 0.5;  // theta 60 degrees lies halfway from 30 to 90
  const double expected = 1 + ((3 * t * t - 2 * t * t * t) + (t * t * t - t * t) * 0.5) *
                                  (2 - plain.look(Part::low).base_color.mean());
  const Vec3 at60 = test::direction_at(radians(60), 1);
  EXPECT_TRUE(
      evaluate_part(rim, Part::low, at60).isApprox(expected * evaluate_part(plain, Part::low, at60), 1e-9));
  const EditedMatcap dark = edited(R"([{"edit": "silhouette", "part": "low", "theta0": 30, "alpha1": -50}])");
  EXPECT_EQ(evaluate_part(dark, Part::low, at60), Vec3(0, 0, 0));
}

MatcapDecomposition decomposed_jade(int size, const DecomposeOptions& options = {}) {
  return decompose(test::example_matcap("jade", size), inscribed_disc(size, size), options, "jade");
}

/// lead() with the high part of another, after `before`.
EditedMatcap with_high_part_of(const MatcapDecomposition& other, const std::string& before = "") {
  const test::TemporaryFolder folder;
  write_matcap(folder / "other.ktx2", other);
  return edited("[" + before + R"({"edit": "mix", "part": "high", "from": "other.ktx2"}])", folder.path());
}

TEST(Edits, MixedMapsOfDifferentSizesGetTheLargerOnesSizeAndKeepTheirLight) {
  const MatcapDecomposition jade = decomposed_jade(64);
  const EditedMatcap mixed = with_high_part_of(jade);
  const std::size_t levels = lead()[Part::low].map.levels.size();
  for (const Part part : kParts) {
    ASSERT_EQ(mixed.matcap[part].map.levels.size(), levels);
    EXPECT_EQ(mixed.matcap[part].map.levels.front().size(), 96);
  }
  double difference = 0;
  double largest = 0;
  for (double angle = 0; angle < 6; angle += 0.3) {
    const Vec3 n = normal_on_disc(0.6 * Vec2(std::cos(angle), std::sin(angle)));
    const Vec3 expected = evaluate_part(unedited(jade), Part::high, n);
    difference = std::max(difference, (evaluate_part(mixed, Part::high, n) - expected).cwiseAbs().maxCoeff());
    largest = std::max(largest, expected.maxCoeff());
  }
  EXPECT_LT(difference, 0.05 * largest);
}

TEST(Edits, MixTakesAPartFromAnotherMatCapAndBitmapsShine) {
  const test::TemporaryFolder folder;
  const MatcapDecomposition jade = decomposed_jade(96);
  const EditedMatcap mixed = with_high_part_of(jade);
  const Vec3 n = normal_on_disc({0.6, 0.3});
  EXPECT_TRUE(
      evaluate_part(mixed, Part::high, n).isApprox(evaluate_part(unedited(jade), Part::high, n), 2e-3));
  EXPECT_EQ(evaluate_part(mixed, Part::low, n), evaluate_part(unedited(lead()), Part::low, n));
  // What was painted on the part goes with it.
  const EditedMatcap painted = with_high_part_of(
      jade, R"({"edit": "paint", "part": "high", "at": [0.6, 0.3], "size": 6, "intensity": 30},)");
  EXPECT_EQ(evaluate_part(painted, Part::high, n), evaluate_part(mixed, Part::high, n));
  DecomposeOptions linear;
  linear.space = AddUpSpace::linear;
  ASSERT_EQ(lead().space, AddUpSpace::display);
  EXPECT_THROW(with_high_part_of(decomposed_jade(48, linear)), Error);

  io::write_image(folder / "lamp.png", Image(20, 10, 3, 1));
  const EditedMatcap lamp = edited(
      R"([{"edit": "bitmap", "part": "high", "file": "lamp.png", "at": [-0.5, 0.2], "size": 40, "intensity": 50}])",
      folder.path());
  EXPECT_LT((brightest_point(lamp, Part::high) - Vec2(-0.5, 0.2)).norm(), 0.15);
}

TEST(Edits, MistakesAreNamedByNumberAndKey) {
  EXPECT_THAT(complaint("{"), HasSubstr("edits.json"));
  EXPECT_THAT(complaint("{}"), HasSubstr("list"));
  EXPECT_THAT(complaint("[4]"), HasSubstr("edit 1"));
  EXPECT_THAT(complaint(R"([{"edit": "spin"}])"), testing::AllOf(HasSubstr("spin"), HasSubstr("turn")));
  EXPECT_THAT(complaint(R"([{"edit": "turn"}, {"edit": "intensity", "part": "middle"}])"),
              HasSubstr("edit 2"));
  EXPECT_THAT(complaint(R"([{"edit": "turn", "degree": [1, 2, 3]}])"), HasSubstr("\"degree\" is unknown"));
  EXPECT_THAT(complaint(R"([{"edit": "turn", "degrees": [1, 2]}])"), HasSubstr("list of 3 numbers"));
  EXPECT_THAT(complaint(R"([{"edit": "align", "to": [0.9, 0.9]}])"), HasSubstr("off the sphere"));
  EXPECT_THAT(complaint(R"([{"edit": "mix", "part": "high", "from": "none.ktx2"}])"), HasSubstr("none.ktx2"));
}

}  // namespace
}  // namespace sateen::matcap
