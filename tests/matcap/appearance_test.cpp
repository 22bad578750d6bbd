// SPDX-License-Identifier: MIT
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sateen/core/colour.h"
#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/matcap/decomposed_appearance.h"
#include "sateen/matcap/decomposition_file.h"
#include "sateen/matcap/edits.h"
#include "sateen/matcap/sphere_map.h"
#include "sateen/scene/registry.h"
#include "support/matcaps.h"
#include "support/rendering.h"
#include "support/shapes.h"

namespace sateen::matcap {
namespace {

using testing::HasSubstr;

// Half floats, the driver's 8-bit filter weights, and display values decoded to light, which doubles
// differences.
constexpr double kTolerance = 0.012;

const MatcapDecomposition& carpaint() {
  static const MatcapDecomposition matcap =
      decompose(test::example_matcap("carpaint", 128), inscribed_disc(128, 128), {}, "carpaint");
  return matcap;
}

constexpr const char* kChanges = R"([{"edit": "turn", "degrees": [20, -50, 10]},
                            {"edit": "roughness", "part": "high", "add": 0.02},
                            {"edit": "color", "part": "low", "hue": 120},
                            {"edit": "intensity", "part": "high", "factor": 0.7},
                            {"edit": "silhouette", "part": "low", "theta0": 40, "m1": 0.5, "alpha1": 0.9}])";

EditedMatcap changed(const std::string& json) {
  return apply_edits(carpaint(), parse_edits(json, {}, "edits"));
}

void expect_matches(EditedMatcap matcap, ModulationMaps maps) {
  test::Shot picture;
  picture.width = picture.height = 96;
  test::expect_matches_evaluator(test::torus(),
                                 std::make_shared<DecomposedAppearance>(std::move(matcap), std::move(maps)),
                                 kTolerance, {}, picture);
}

/// Without textures the GPU reads a table of normals, four times the maps' size across. It must lie between
/// the evaluator's values within a texel of the table around; on smooth parts these are nearly one.
void expect_between_neighbours(const scene::Scene& scene) {
  test::Shot picture;
  picture.width = picture.height = 96;
  const render::Picture frame = test::render(scene, picture);
  const double texel = 2.0 / (4 * carpaint()[Part::high].map.levels.front().size());
  test::Difference outside;
  test::Difference difference;
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 96; ++x) {
      const auto surface = scene::surface_at(*frame.surfaces, x, y);
      if (!surface) continue;
      const auto& appearance = dynamic_cast<const appearance::BakedLight&>(
          *scene.materials[static_cast<std::size_t>(surface->material)].appearance);
      const Vec3 shown = frame.colour.rgb(x, y).cast<double>();
      Vec3 least = Vec3::Constant(std::numeric_limits<double>::infinity());
      Vec3 most = -least;
      const Vec2 t = map_of_direction(surface->eye_normal);
      for (int j = -2; j <= 2; ++j) {
        for (int i = -2; i <= 2; ++i) {
          appearance::Surface near = *surface;
          near.eye_normal = direction_of_map(t + texel / 2 * Vec2(i, j), false);
          const Vec3 value = appearance.evaluate(near);
          least = least.cwiseMin(value);
          most = most.cwiseMax(value);
        }
      }
      outside.add(x, y, std::max({0.0, (least - shown).maxCoeff(), (shown - most).maxCoeff()}), kTolerance);
      difference.add(x, y, (appearance.evaluate(*surface) - shown).cwiseAbs().maxCoeff(), kTolerance);
    }
  }
  EXPECT_GT(outside.pixels, 96 * 96 / 10);
  EXPECT_EQ(outside.failing, 0) << outside.largest << " at " << outside.x << ", " << outside.y;
  EXPECT_LT(difference.failing_share(), 0.02) << difference.largest;
}

void expect_between_neighbours(const EditedMatcap& matcap) {
  expect_between_neighbours(test::scene_of(test::torus(), std::make_shared<DecomposedAppearance>(matcap)));
}

TEST(DecomposedOnGpu, EqualsTheEvaluator) {
  expect_between_neighbours(unedited(carpaint()));
}

TEST(DecomposedOnGpu, EqualsTheEvaluatorWithTurnedLightAndChangedMaterial) {
  expect_between_neighbours(changed(kChanges));
}

TEST(DecomposedOnGpu, EqualsTheEvaluatorWithTextures) {
  ModulationMaps maps;
  maps.low_color = Image(8, 8, 3);
  maps.high_color = Image(4, 4, 3, 0.5F);
  maps.roughness = Image(6, 6, 1);
  maps.occlusion = Image(3, 3, 1, 0.8F);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x)
      maps.low_color.set_rgb(
          x, y, {0.3F + 0.05F * static_cast<float>(x), 0.5F, 0.3F + 0.05F * static_cast<float>(y)});
  }
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 6; ++x) maps.roughness.at(x, y, 0) = 0.15F * static_cast<float>(x);
  }
  maps.roughness_scale = 0.1;
  expect_matches(unedited(carpaint()), maps);
  expect_matches(changed(kChanges), maps);
}

// Figure 14: MatCaps by material, their main highlights brought to one place and turned together.
TEST(DecomposedOnGpu, SeveralByMaterialAlignedAndTurnedTogetherEqualTheEvaluator) {
  scene::Scene scene;
  scene.mesh = test::torus();
  scene.mesh.material_names = {"left", "right"};
  for (const auto& triangle : scene.mesh.triangles) {
    const float x = scene.mesh.positions[static_cast<std::size_t>(triangle[0])].x();
    scene.mesh.material_ids.push_back(x < 0 ? 0 : 1);
  }
  const char* together = R"([{"edit": "align", "to": [-0.3, 0.4]}, {"edit": "turn", "degrees": [0, 40, 0]}])";
  scene.materials.resize(2);
  const MatcapDecomposition lead =
      decompose(test::example_matcap("lead", 128), inscribed_disc(128, 128), {}, "lead");
  scene.materials[0].appearance = std::make_shared<DecomposedAppearance>(changed(together));
  scene.materials[1].appearance =
      std::make_shared<DecomposedAppearance>(apply_edits(lead, parse_edits(together, {}, "edits")));
  expect_between_neighbours(scene);
}

TEST(DecomposedAppearance, IsLoadedByTheRegistryAsTextureAndAsMaterial) {
  const test::TemporaryFolder folder;
  write_matcap(folder / "paint.ktx2", carpaint());
  appearance::Surface surface;
  surface.eye_normal = normal_on_disc({0.2, -0.3});
  surface.occlusion = 0.5;
  const Vec3 expected = 0.5 * evaluate(unedited(carpaint()), surface.eye_normal);
  EXPECT_TRUE(scene::load_appearance(folder / "paint.ktx2")->radiance(surface, {}).isApprox(expected, 2e-3));
  io::write_text(folder / "paint.json", R"({"model": "matcap-decomposition", "matcap": "paint.ktx2",
                                        "edits": [{"edit": "intensity", "part": "low", "factor": 0}]})");
  EditedMatcap dark = unedited(carpaint());
  dark.look(Part::low).intensity = 0;
  EXPECT_TRUE(scene::load_appearance(folder / "paint.json")
                  ->radiance(surface, {})
                  .isApprox(0.5 * evaluate(dark, surface.eye_normal), 2e-3));
  io::write_text(folder / "odd.json",
                 R"({"model": "matcap-decomposition", "matcap": "paint.ktx2", "shine": 3})");
  try {
    scene::load_appearance(folder / "odd.json");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("odd.json"), HasSubstr("shine")));
  }
}

TEST(DecomposedAppearance, TexturesAreThoseOfTheMaterialAndMultiply) {
  const test::TemporaryFolder folder;
  write_matcap(folder / "paint.ktx2", carpaint());
  ASSERT_EQ(carpaint().space, AddUpSpace::display);
  io::write_image(folder / "half.png", Image(2, 2, 3, srgb_decode(128 / 255.0F)));
  io::write_image(folder / "quarter.exr", Image(2, 2, 1, 0.25F));
  io::write_text(folder / "paint.json",
                 R"({"model": "matcap-decomposition", "matcap": "paint.ktx2", "low_color": "half.png",
                     "roughness": "quarter.exr", "roughness_scale": 0.1, "occlusion": "quarter.exr"})");
  appearance::Surface surface;
  surface.eye_normal = normal_on_disc({0.2, -0.3});
  surface.uv = {0.3, 0.7};
  surface.occlusion = 0.5;
  Modulation modulation;
  modulation.low_color = Vec3::Constant(128 / 255.0);  // the parts add up as they are displayed
  modulation.added_variance = 0.1 * 0.25;
  modulation.occlusion = 0.5 * 0.25;
  const Vec3 expected = evaluate(unedited(carpaint()), surface.eye_normal, modulation);
  EXPECT_TRUE(scene::load_appearance(folder / "paint.json")->radiance(surface, {}).isApprox(expected, 3e-3));
}

TEST(DecomposedAppearance, TurnsInDegreesAndForgetsItsTable) {
  DecomposedAppearance turned(unedited(carpaint()));
  turned.settle(true);
  EXPECT_EQ(turned.shader().entry, "matcap_by_normal");
  turned.set("turn_y", 90.0);
  EXPECT_EQ(turned.shader().entry, "matcap_decomposition");
  appearance::Surface surface;
  surface.eye_normal = normal_on_disc({0.2, -0.3});
  EditedMatcap expected = unedited(carpaint());
  expected.light = rotation_xyz({0, kPi / 2, 0});
  EXPECT_TRUE(turned.evaluate(surface).isApprox(evaluate(expected, surface.eye_normal), 1e-9));
}

}  // namespace
}  // namespace sateen::matcap
