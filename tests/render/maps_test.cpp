// SPDX-License-Identifier: MIT
#include "sateen/core/direction.h"
#include "sateen/core/picture_texture.h"
#include "sateen/matcap/matcap.h"
#include "support/rendering.h"
#include "support/shapes.h"

namespace sateen::render {
namespace {

using test::Shot;

scene::SurfaceMap constant_map(const Vec3f& value) {
  Image image(2, 2, 3);
  for (int i = 0; i < 4; ++i) image.set_rgb(i % 2, i / 2, value);
  return {.texture = std::make_shared<const TextureData>(picture_texture(image, TextureData::Wrap::repeat))};
}

scene::Scene plane_scene() {
  return test::scene_of(test::plane(), std::make_shared<matcap::MatCap>(test::test_matcap()));
}

appearance::Surface centre(const scene::Scene& scene, const Mat3& rotation = Mat3::Identity()) {
  test::Shot picture{.width = 9, .height = 9};
  picture.camera.kind = scene::Camera::Kind::view_space;
  picture.rotation = rotation;
  return *scene::surface_at(*test::render(scene, picture).surfaces, 4, 4);
}

// Stored as 0.5 + 0.5 n, x along u, green (y) along v, which grows upwards.
TEST(NormalMap, IsReadInTheFrameOfTheUvs) {
  const Vec3f bump = Vec3f(0.3f, 0.5f, 0.8f).normalized();
  scene::Scene scene = plane_scene();
  scene.materials[0].normal_map = constant_map((bump + Vec3f::Ones()) / 2);
  EXPECT_LT((centre(scene).normal - bump.cast<double>()).norm(), 2e-3);

  const Mat3 turn = rotation_xyz({0.4, -0.3, 0.9});
  EXPECT_LT((centre(scene, turn).normal - turn * bump.cast<double>()).norm(), 2e-3);

  // Seen from behind, the surface's normal there is the opposite of the front's.
  const Mat3 behind = rotation_xyz({kPi, 0, 0});
  EXPECT_LT((centre(scene, behind).normal + behind * bump.cast<double>()).norm(), 2e-3);

  // A mirrored UV chart turns green around.
  for (Vec4f& t : scene.mesh.tangents) t.w() = -1;
  EXPECT_LT((centre(scene).normal - Vec3(bump.x(), -bump.y(), bump.z())).norm(), 2e-3);

  scene = plane_scene();
  scene.materials[0].normal_map = constant_map((bump + Vec3f::Ones()) / 2);
  scene.materials[0].normal_scale = 0;
  EXPECT_LT((centre(scene).normal - Vec3::UnitZ()).norm(), 1e-5);
}

TEST(NormalMap, KeepsTheFrameOfTheUvsWhenTangentsPointElsewhere) {
  const Vec3f bump = Vec3f(0.6f, 0, 0.8f);
  scene::Scene scene = plane_scene();
  scene.materials[0].normal_map = constant_map((bump + Vec3f::Ones()) / 2);
  scene.map_tangents = scene.mesh.tangents;
  for (Vec4f& t : scene.mesh.tangents) t = Vec4f(0, 1, 0, 1);
  const appearance::Surface surface = centre(scene);
  EXPECT_LT((surface.normal - bump.cast<double>()).norm(), 2e-3);
  EXPECT_LT((surface.tangent - Vec3::UnitY()).norm(), 2e-3);
  EXPECT_NEAR(surface.tangent_angle, 0.25, 1e-4);
}

TEST(DirectionMap, ReplacesTheTangent) {
  for (const double degrees : {0.0, 30.0, 120.0, 200.0, 345.0}) {
    const double angle = radians(degrees);
    scene::Scene scene = plane_scene();
    const Vec3f stored(static_cast<float>(0.5 + 0.5 * std::cos(angle)),
                       static_cast<float>(0.5 + 0.5 * std::sin(angle)), 0);
    scene.materials[0].direction_map = constant_map(stored);
    const appearance::Surface surface = centre(scene);
    EXPECT_LT((surface.tangent - Vec3(std::cos(angle), std::sin(angle), 0)).norm(), 2e-3);
    const double turns = surface.tangent_angle - degrees / 360;
    EXPECT_LT(std::abs(turns - std::round(turns)), 1e-3);
  }
}

TEST(OcclusionMap, MultipliesTheMeshsOwnAndTakesItsFirstChannel) {
  scene::Scene scene = plane_scene();
  scene.mesh.occlusion.assign(scene.mesh.positions.size(), 0.5f);
  scene.materials[0].occlusion_map = constant_map({0.5f, 1, 1});
  EXPECT_NEAR(centre(scene).occlusion, 0.25, 1e-4);
  scene.switches.occlusion = false;
  EXPECT_NEAR(centre(scene).occlusion, 1, 1e-6);
}

TEST(SurfaceMap, ScaleAndOffsetMoveThePictureWithVUp) {
  Image image(1, 4, 3);
  for (int y = 0; y < 4; ++y)
    image.set_rgb(0, y, Vec3f::Constant(static_cast<float>(4 - y) / 4));  // grows upwards
  scene::Scene scene = plane_scene();
  scene::SurfaceMap& map = scene.materials[0].occlusion_map;
  map.texture = std::make_shared<const TextureData>(picture_texture(image, TextureData::Wrap::repeat));
  map.scale = {1, 0};
  map.offset = {0, 0.125f};  // the lowest texel's centre
  EXPECT_NEAR(centre(scene).occlusion, 0.25, 5e-3);
  map.offset = {0, 0.875f};
  EXPECT_NEAR(centre(scene).occlusion, 1, 5e-3);
}

}  // namespace
}  // namespace sateen::render
