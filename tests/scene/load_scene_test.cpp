// SPDX-License-Identifier: MIT
#include "sateen/scene/load_scene.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "support/files.h"
#include "support/gltf.h"

namespace sateen::scene {
namespace {

using testing::HasSubstr;

/// A folder with a glTF triangle that has maps and tangents of its own, and materials of light and of none.
class LoadScene : public testing::Test {
 protected:
  LoadScene() {
    for (const auto& [name, size] :
         {std::pair{"own.png", 2}, std::pair{"other.png", 4}, std::pair{"third.png", 8}})
      io::write_data(folder / name, Image(size, size, 3, 0.5f));
    test::GltfTriangle triangle;
    triangle.picture_uri = "own.png";
    triangle.tangents = true;
    triangle.tangent_values.fill({0, 1, 0, 1});
    test::write_gltf(folder / "cloth.glb", triangle);
    io::write_image(folder / "clay.exr", Image(8, 8, 3, 0.25f));
    io::write_image(folder / "sky.exr", Image(8, 4, 3, 0.5f));
    lit("plain", "");
    lit("lamp", R"(, "lights": [{"direction": [0, 0, 1], "color": 2}])");
    lit("dim", R"(, "ambient": 0.125)");
    spot("narrow", 20);
    spot("wide", 40);
  }
  void lit(const std::string& name, const std::string& light) const {
    io::write_text(folder / (name + ".json"), R"({"model": "layered", "base": {"color": 0.5})" + light + "}");
  }
  void spot(const std::string& name, int cone) const {
    lit(name, fmt::format(R"(, "lights": [{{"kind": "spot", "position": [0, 0, 1], "direction": [0, 0, -1],
                              "outer_cone": {}}}])",
                          cone));
  }
  SceneOptions with(const std::string& material) const { return {.material = folder / material}; }
  Scene load(const SceneOptions& options) const { return load_scene(folder / "cloth.glb", options); }

  test::TemporaryFolder folder;
};

TEST_F(LoadScene, AFilesOwnMapsAreUsedUnlessOthersAreGiven) {
  const Material own = load(with("clay.exr")).materials.at(0);
  ASSERT_TRUE(own.normal_map.texture);
  EXPECT_EQ(own.normal_map.texture->width, 2);
  EXPECT_EQ(own.normal_map.texture->wrap_u, TextureData::Wrap::repeat);
  EXPECT_EQ(own.normal_map.texture->wrap_v, TextureData::Wrap::repeat);
  EXPECT_LT((own.normal_map.scale - Vec2f(4, 8)).norm(), 1e-5f);
  EXPECT_LT((own.normal_map.offset - Vec2f(0.1f, -7.2f)).norm(), 1e-5f);  // v up
  EXPECT_TRUE(own.occlusion_map.texture);
  EXPECT_EQ(own.normal_scale, 1);

  SceneOptions options = with("clay.exr");
  options.normal_map = folder / "other.png";
  options.direction_map = folder / "third.png";
  options.occlusion_map = folder / "other.png";
  options.normal_scale = 0.5f;
  const Material given = load(options).materials.at(0);
  EXPECT_EQ(given.normal_map.texture->width, 4);
  EXPECT_EQ(given.normal_map.scale, Vec2f(1, 1));
  EXPECT_EQ(given.direction_map.texture->width, 8);
  EXPECT_EQ(given.occlusion_map.texture->width, 4);
  EXPECT_EQ(given.normal_scale, 0.5f);
}

TEST_F(LoadScene, OcclusionIsThatOfTheFileOrNoneOrTraced) {
  SceneOptions options = with("clay.exr");
  EXPECT_TRUE(load(options).switches.occlusion);
  options.occlusion = OcclusionSource::none;
  const Scene none = load(options);
  EXPECT_FALSE(none.switches.occlusion);
  EXPECT_FALSE(none.materials[0].occlusion_map.texture);
  options.occlusion = OcclusionSource::compute;
  const Scene traced = load(options);
  EXPECT_EQ(traced.mesh.occlusion.size(), 3u);
  EXPECT_FALSE(traced.materials[0].occlusion_map.texture);
}

// The file's tangents run along y, its u along x.
TEST_F(LoadScene, TangentsAreTheFilesUnlessOthersAreAskedFor) {
  const auto tangent = [&](const TangentSource& source) -> Vec3f {
    SceneOptions options = with("clay.exr");
    options.tangents = source;
    return load(options).mesh.tangents.at(0).head<3>();
  };
  using Kind = TangentSource::Kind;
  EXPECT_LT((tangent({}) - Vec3f::UnitY()).norm(), 1e-6f);
  EXPECT_LT((tangent({.kind = Kind::uv}) - Vec3f::UnitX()).norm(), 1e-6f);
  EXPECT_LT((tangent({.angle = radians(90)}) + Vec3f::UnitX()).norm(), 1e-6f);
  EXPECT_LT((tangent({.kind = Kind::along, .axis = {1, 1, 0}}) - Vec3f(1, 1, 0).normalized()).norm(), 1e-6f);
  // Around the middle of the box, (1/2, 1/2): at the corner (0, 0) towards (1, -1).
  EXPECT_LT((tangent({.kind = Kind::around, .axis = {0, 0, 1}}) - Vec3f(1, -1, 0).normalized()).norm(),
            1e-6f);
}

TEST_F(LoadScene, MapsStayWhereTheyAreWhenTangentsTurn) {
  SceneOptions options = with("clay.exr");
  EXPECT_TRUE(load(options).map_tangents.empty());
  options.tangents.angle = radians(90);
  const Scene turned = load(options);
  ASSERT_EQ(turned.map_tangents.size(), 3u);
  EXPECT_LT((turned.map_tangents[0].head<3>() - Vec3f::UnitY()).norm(), 1e-6f);
}

TEST_F(LoadScene, TheLightIsTheUsersOrTheMaterialsOrAStandard) {
  EXPECT_EQ(load(with("plain.json")).lighting.lamps.size(), 2u);  // the standard has two
  const light::Lighting lamp = load(with("lamp.json")).lighting;
  ASSERT_EQ(lamp.lamps.size(), 1u);
  EXPECT_EQ(lamp.lamps[0].colour, Vec3(2, 2, 2));
  EXPECT_TRUE(load(with("dim.json")).lighting.surroundings.harmonics.c[0].isApprox(Vec3::Constant(0.125)));
  // An environment replaces surroundings and leaves lamps.
  SceneOptions options = with("lamp.json");
  options.lighting.environment = folder / "sky.exr";
  const light::Lighting both = load(options).lighting;
  EXPECT_EQ(both.lamps.size(), 1u);
  EXPECT_NEAR(both.surroundings.harmonics.c[0].x(), 0.5, 1e-3);
  options.material = folder / "clay.exr";
  EXPECT_THAT([&] { load(options); }, testing::ThrowsMessage<Error>(HasSubstr("sky.exr")));
}

TEST_F(LoadScene, OfSeveralLightsTheFirstIsTakenWithAWarning) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  io::write_text(folder / "two.obj", corners + "usemtl front\nf 1 2 3\nusemtl sleeve\nf 3 2 1\n");
  const auto warnings = [&](const std::string& front, const std::string& sleeve,
                            const std::string& environment = "") {
    SceneOptions options;
    options.materials = {{"front", folder / front}, {"sleeve", folder / sleeve}};
    if (!environment.empty()) options.lighting.environment = folder / environment;
    int count = 0;
    options.warn = [&](const std::string&) { ++count; };
    load_scene(folder / "two.obj", options);
    return count;
  };
  EXPECT_EQ(warnings("lamp.json", "dim.json"), 1);
  EXPECT_EQ(warnings("narrow.json", "wide.json"), 1) << "spots differ in their cones, too";
  EXPECT_EQ(warnings("lamp.json", "lamp.json"), 0);
  EXPECT_EQ(warnings("lamp.json", "plain.json"), 0);
  EXPECT_EQ(warnings("lamp.json", "dim.json", "sky.exr"), 0);
}

TEST_F(LoadScene, ASceneIsLitWhenAllItsMaterialsAre) {
  EXPECT_TRUE(load(with("plain.json")).lit());
  Scene scene = load(with("plain.json"));
  scene.materials.push_back(load(with("clay.exr")).materials[0]);
  EXPECT_FALSE(scene.lit());
}

}  // namespace
}  // namespace sateen::scene
