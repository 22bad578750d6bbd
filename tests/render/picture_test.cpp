// SPDX-License-Identifier: MIT
#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/matcap/matcap.h"
#include "sateen/scene/constant.h"
#include "sateen/scene/surface_images.h"
#include "support/rendering.h"
#include "support/shapes.h"

namespace sateen::render {
namespace {

using test::Shot;

scene::View one_view(const scene::Scene& scene, const scene::Camera& camera, double aspect) {
  const std::vector<Mat3> still{Mat3::Identity()};
  return scene::frame_object(scene.mesh, camera, still, aspect)[0];
}

scene::Scene white(Mesh mesh) {
  return test::scene_of(std::move(mesh), std::make_shared<scene::Constant>(Vec3(1, 1, 1)));
}

TEST(Picture, IsTransparentWhereNothingIsAndAssociatedAtEdges) {
  const render::Picture frame = test::render(white(test::sphere(256, 128)),
                                             {.width = 65, .height = 33, .samples = 4, .surfaces = false});
  EXPECT_EQ(frame.colour.width, 65);
  EXPECT_EQ(frame.colour.height, 33);
  EXPECT_EQ(frame.colour.at(0, 0, 3), 0);
  EXPECT_EQ(frame.colour.at(0, 0, 0), 0);
  EXPECT_EQ(frame.colour.at(32, 16, 3), 1);
  int partial = 0;
  for (int y = 0; y < 33; ++y) {
    for (int x = 0; x < 65; ++x) {
      const float alpha = frame.colour.at(x, y, 3);
      EXPECT_NEAR(frame.colour.at(x, y, 0), alpha, 1e-6);
      partial += alpha > 0 && alpha < 1 ? 1 : 0;
    }
  }
  EXPECT_GT(partial, 30);
}

// A sphere's silhouette covers pi r^2 of the picture: box-filtered coverage sums to that area.
TEST(Picture, SupersamplingMeasuresCoverage) {
  test::Shot picture{.width = 40, .height = 40, .samples = 8, .surfaces = false};
  picture.camera.kind = scene::Camera::Kind::view_space;
  const render::Picture frame = test::render(white(test::sphere(512, 256)), picture);
  double area = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) area += frame.colour.at(x, y, 3);
  }
  EXPECT_NEAR(area, kPi * 20 * 20, 2);
}

// Half black, half white in one pixel is 0.5 of linear light, whatever the display makes of it.
TEST(Picture, SamplesAreAveragedInLinearLight) {
  Mesh mesh = test::plane();
  for (Vec3f& p : mesh.positions) p.x() = (p.x() - 1) / 2;  // the left half
  test::Shot picture{.width = 1, .height = 1, .samples = 4, .surfaces = false};
  picture.camera.kind = scene::Camera::Kind::view_space;
  EXPECT_NEAR(test::render(white(mesh), picture).colour.at(0, 0, 0), 0.5, 1e-6);
}

TEST(Picture, AColouredBackgroundIsOpaqueAndBlendsAtEdges) {
  test::context();
  const scene::Scene scene = white(test::sphere());
  PictureSettings settings{.width = 32, .height = 32, .samples = 4, .background = Vec3f(0, 0.5f, 0)};
  const render::Picture frame = Renderer(scene).render(one_view(scene, {}, 1), settings);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      EXPECT_EQ(frame.colour.at(x, y, 3), 1);
      EXPECT_NEAR(frame.colour.at(x, y, 1), 0.5 + 0.5 * frame.colour.at(x, y, 0), 1e-6);
    }
  }
}

TEST(Picture, TilesDoNotShow) {
  test::context();
  const scene::Scene scene =
      test::scene_of(test::torus(), std::make_shared<matcap::MatCap>(test::test_matcap()));
  const Renderer renderer(scene);
  const scene::View view = one_view(scene, {}, 101.0 / 67);
  PictureSettings settings{.width = 101, .height = 67, .samples = 2, .background = {}, .surfaces = true};
  const render::Picture whole = renderer.render(view, settings);
  settings.tile = 50;  // 25 pixels a tile
  const render::Picture tiled = renderer.render(view, settings);
  test::Difference difference;
  for (int y = 0; y < 67; ++y) {
    for (int x = 0; x < 101; ++x) {
      const float apart = (whole.colour.rgb(x, y) - tiled.colour.rgb(x, y)).cwiseAbs().maxCoeff();
      difference.add(x, y, apart, 1e-3);
    }
  }
  // A sample exactly on an edge may fall to the other side.
  EXPECT_LE(difference.failing, 3) << difference.largest;
  EXPECT_EQ(scene::aov(*whole.surfaces, "mask").at(50, 5, 0),
            scene::aov(*tiled.surfaces, "mask").at(50, 5, 0));
}

TEST(Picture, NothingOfTheObjectIsCutOff) {
  for (const scene::Camera::Kind kind :
       {scene::Camera::Kind::perspective, scene::Camera::Kind::orthographic}) {
    for (const double turn : {0.0, 0.6, 1.5}) {
      test::Shot picture{.width = 120, .height = 50, .surfaces = false};
      picture.camera.kind = kind;
      picture.rotation = rotation_xyz({turn, turn / 2, turn});
      const render::Picture frame = test::render(white(test::torus()), picture);
      int covered = 0;
      for (int y = 0; y < 50; ++y) {
        for (int x = 0; x < 120; ++x) {
          if (frame.colour.at(x, y, 3) == 0) continue;
          ++covered;
          EXPECT_TRUE(x > 0 && x < 119 && y > 0 && y < 49) << x << ", " << y;
        }
      }
      EXPECT_GT(covered, 400);
    }
  }
}

TEST(Picture, NearerSurfacesHideOthers) {
  Mesh mesh = test::plane();
  const Mesh other = test::plane();
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::size_t i = 0; i < other.positions.size(); ++i) {
    mesh.positions.push_back(other.positions[i] + Vec3f(0, 0, 0.3f));
    mesh.normals.push_back(other.normals[i]);
    mesh.tangents.push_back(other.tangents[i]);
    mesh.uvs.push_back(other.uvs[i]);
  }
  mesh.material_ids.assign(2, 0);
  for (const auto& t : other.triangles) {
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    mesh.material_ids.push_back(1);
  }
  mesh.material_names = {"behind", "in front"};
  scene::Scene scene = white(mesh);
  scene.materials.push_back({.appearance = std::make_shared<scene::Constant>(Vec3(0, 0, 1))});
  test::Shot picture{.width = 4, .height = 4};
  picture.camera.kind = scene::Camera::Kind::view_space;
  render::Picture frame = test::render(scene, picture);
  EXPECT_EQ(frame.colour.rgb(1, 1), Vec3f(0, 0, 1));
  EXPECT_EQ(scene::surface_at(*frame.surfaces, 1, 1)->material, 1);
  picture.rotation = rotation_xyz({kPi, 0, 0});
  frame = test::render(scene, picture);
  EXPECT_EQ(frame.colour.rgb(1, 1), Vec3f(1, 1, 1));
  EXPECT_EQ(scene::surface_at(*frame.surfaces, 1, 1)->material, 0);
}

TEST(Aov, VectorsAreInViewSpaceWithTheTopRowUp) {
  test::Shot picture{.width = 64, .height = 64};
  picture.camera.kind = scene::Camera::Kind::view_space;
  const render::Picture frame = test::render(white(test::sphere(256, 128)), picture);
  const Image normal = scene::aov(*frame.surfaces, "normal");
  const Image position = scene::aov(*frame.surfaces, "position");
  const Image mask = scene::aov(*frame.surfaces, "mask");
  const Image uv = scene::aov(*frame.surfaces, "uv");
  EXPECT_GT(normal.at(32, 3, 1), 0.8);
  EXPECT_LT(normal.at(3, 32, 0), -0.8);
  EXPECT_EQ(mask.at(0, 0, 0), 0);
  EXPECT_EQ(normal.at(0, 0, 2), 0);
  EXPECT_GT(uv.at(32, 3, 1), 0.8);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      if (mask.at(x, y, 0) == 0) continue;
      EXPECT_NEAR(position.at(x, y, 0), 2 * (x + 0.5) / 64 - 1, 1e-5);
      EXPECT_NEAR(position.at(x, y, 1), 1 - 2 * (y + 0.5) / 64, 1e-5);
      EXPECT_LT((normal.rgb(x, y) - position.rgb(x, y).normalized()).norm(), 0.02);
    }
  }
  EXPECT_THROW(scene::aov(*frame.surfaces, "colour"), Error);
}

TEST(Renderer, SaysWhatTheMeshLacks) {
  test::context();
  scene::Scene scene = white(test::sphere());
  scene.mesh.normals.clear();
  EXPECT_THROW(Renderer{scene}, Error);
  scene = white(test::sphere());
  scene.mesh.material_ids.assign(scene.mesh.triangles.size(), 1);
  EXPECT_THROW(Renderer{scene}, Error);
  scene = white(test::sphere());
  scene.materials[0].normal_map.texture = std::make_shared<const TextureData>();
  scene.mesh.uvs.clear();
  EXPECT_THROW(Renderer{scene}, Error);
}

}  // namespace
}  // namespace sateen::render
