// SPDX-License-Identifier: MIT
// One renderer, many frames: what changes between them shows, and nothing else does.
#include <array>
#include <numeric>

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include "brdf/layered_materials.h"
#include "sateen/amc/appearance.h"
#include "sateen/core/error.h"
#include "sateen/geometry/curvature.h"
#include "sateen/geometry/tangents.h"
#include "sateen/gpu/framebuffer.h"
#include "sateen/light/environment.h"
#include "sateen/matcap/decomposed_appearance.h"
#include "sateen/matcap/matcap.h"
#include "sateen/render/draw_picture.h"
#include "sateen/scene/constant.h"
#include "support/analytic_material.h"
#include "support/rendering.h"
#include "support/shapes.h"

namespace sateen::render {
namespace {

constexpr int kPictureSide = 96;

scene::View view_of(const scene::Scene& scene) {
  return scene::frame_object(scene.mesh, {}, std::array{rotation_xyz({0.4, 0.3, 0})}, 1)[0];
}

Image picture(const Renderer& renderer, const scene::View& view) {
  return renderer.render(view, {.width = kPictureSide, .height = kPictureSide, .samples = 1}).colour;
}

/// Whatever draw() puts into a framebuffer, tables ready or not.
Image drawn(const Renderer& renderer, const scene::View& view) {
  const gpu::Framebuffer target(kPictureSide, kPictureSide);
  target.bind();
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  renderer.draw(view);
  return target.read();
}

double largest_difference(const Image& a, const Image& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.data.size(); ++i) {
    largest = std::max(largest, std::abs(static_cast<double>(a.data[i]) - b.data[i]));
  }
  return largest;
}

TEST(Changes, LightingMaterialAndSwitchesOfARendererAreThoseOfANewOne) {
  test::context();
  const auto fuzz = std::make_shared<brdf::LayeredAppearance>(test::fuzzy());
  scene::Scene scene = test::scene_of(test::torus(), fuzz);
  Renderer renderer(scene);
  const scene::View view = view_of(scene);
  const Image dark = picture(renderer, view);
  scene.lighting = test::everything();
  renderer.set_lighting(scene.lighting);
  const Image lit = picture(renderer, view);
  EXPECT_GT(largest_difference(dark, lit), 0.1);
  EXPECT_EQ(largest_difference(lit, picture(Renderer(scene), view)), 0);

  scene.materials[0].appearance = std::make_shared<amc::AmcAppearance>(test::analytic_table(32, 32, 2));
  renderer.set_material(0, scene.materials[0]);
  EXPECT_EQ(largest_difference(picture(renderer, view), picture(Renderer(scene), view)), 0);
  scene.switches = {.tangent_angle = scene::TangentAngle::fragment, .perspective = scene::Perspective::none};
  renderer.set_switches(scene.switches);
  EXPECT_EQ(largest_difference(picture(renderer, view), picture(Renderer(scene), view)), 0);
  EXPECT_THROW(renderer.set_material(1, scene.materials[0]), Error);
  EXPECT_THROW(renderer.set_material(0, {}), Error);
}

/// The plain way: a latitude-longitude picture shifted along its rows, counter-clockwise seen from above.
Image turned_environment(const Image& environment, double angle) {
  if (angle == 0) return environment;
  Image turned(environment.width, environment.height, environment.channels);
  const double shift = angle / (2 * kPi) * environment.width;
  for (int y = 0; y < environment.height; ++y) {
    for (int x = 0; x < environment.width; ++x) {
      const double from = wrap(x + shift, environment.width);
      const int left = static_cast<int>(from);
      const auto blend = static_cast<float>(from - left);
      const int right = (left + 1) % environment.width;
      for (int c = 0; c < environment.channels; ++c) {
        turned.at(x, y, c) = (1 - blend) * environment.at(left, y, c) + blend * environment.at(right, y, c);
      }
    }
  }
  return turned;
}

TEST(Changes, TurningTheEnvironmentIsTurningItsPicture) {
  // A sky that is smooth enough for both: the picture resampled and filtered again, or the matrix.
  const Image sky = test::sky();
  const double angle = radians(70);
  const light::Surroundings by_matrix =
      light::turned(light::make_surroundings(sky), light::turn_about_vertical(angle));
  const light::Surroundings by_picture = light::make_surroundings(turned_environment(sky, angle));
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    const Vec3 d = Vec3::Random().normalized();
    for (const double alpha : {0.1, 0.5}) {
      const Vec3 expected = by_picture.radiance(d, alpha);
      EXPECT_LT((by_matrix.radiance(d, alpha) - expected).norm(), 0.03 * expected.norm() + 0.01) << alpha;
    }
    EXPECT_LT((by_matrix.harmonics.radiance(d) - by_picture.harmonics.radiance(d)).norm(), 2e-3);
  }
  // The GPU turns as the evaluator does, about any axis.
  light::Lighting lighting;
  lighting.surroundings = light::turned(light::make_surroundings(sky), rotation_xyz({0.4, 1.3, -0.8}));
  test::expect_matches_evaluator(test::torus(), std::make_shared<brdf::LayeredAppearance>(test::glossy()),
                                 4e-3, {}, {}, lighting);
}

TEST(Changes, AParameterShowsInTheNextFrameAndTheRestIsKept) {
  test::context();
  const auto material = std::make_shared<brdf::LayeredAppearance>(test::glossy());
  scene::Scene scene = test::scene_of(test::torus(), material, {}, test::everything());
  const Renderer renderer(scene);
  const scene::View view = view_of(scene);
  drawn(renderer, view);
  material->set("base.color", Vec3(0.9, 0.1, 0.2));
  brdf::LayeredMaterial expected = test::glossy();
  expected.base.color = {0.9, 0.1, 0.2};
  scene.materials[0].appearance = std::make_shared<brdf::LayeredAppearance>(expected);
  EXPECT_LT(largest_difference(drawn(renderer, view), picture(Renderer(scene), view)), 1e-6);
}

TEST(Changes, WhatTakesLongIsDrawnAsItWasUntilItIsReady) {
  test::context();
  const auto velvet = std::make_shared<brdf::LayeredAppearance>(test::fuzzy());
  const scene::Scene scene = test::scene_of(test::torus(), velvet, {}, test::everything());
  const Renderer renderer(scene);
  const scene::View view = view_of(scene);
  const Image before = drawn(renderer, view);
  velvet->set("fuzz.density", 0.9);
  EXPECT_EQ(std::get<double>(velvet->get("fuzz.density")), 0.9);
  EXPECT_EQ(velvet->material().fuzz->density, test::fuzzy().fuzz->density);
  EXPECT_EQ(largest_difference(drawn(renderer, view), before), 0);
  // Set again before the first is ready: the last one counts.
  velvet->set("fuzz.density", 0.5);
  velvet->settle(true);
  brdf::LayeredMaterial expected = test::fuzzy();
  expected.fuzz->density = 0.5;
  const scene::Scene fresh = test::scene_of(
      test::torus(), std::make_shared<brdf::LayeredAppearance>(expected), {}, test::everything());
  EXPECT_LT(largest_difference(drawn(renderer, view), picture(Renderer(fresh), view)), 1e-6);
}

TEST(Changes, ADecomposedMatCapIsDrawnByItsFormulaWhileEditedAndByItsTableWhenIdle) {
  test::context();
  const Image ball = test::test_matcap(96);
  matcap::DecomposeOptions options;
  options.map_size = 96;
  const auto matcap = std::make_shared<matcap::DecomposedAppearance>(
      matcap::unedited(matcap::decompose(ball, {48, 48, 47.5}, options, "ball")));
  const scene::Scene scene = test::scene_of(test::torus(), matcap);
  const Renderer renderer(scene);
  const scene::View view = view_of(scene);
  matcap->set("turn_y", 25.0);
  matcap->set("high.color", Vec3(1, 0.8, 0.6));
  matcap->set("high.roughness", 0.02);
  const Image formula = drawn(renderer, view);
  EXPECT_EQ(matcap->shader().entry, "matcap_decomposition");
  const auto difference = test::against_evaluator(
      test::render(scene, {.width = kPictureSide, .height = kPictureSide}), scene, 0.02);
  EXPECT_EQ(matcap->shader().entry, "matcap_by_normal");  // a finished picture waits for it
  EXPECT_LT(difference.failing_share(), 0.02) << difference.largest;
  const Image table = picture(renderer, view);
  Image apart = formula;
  for (std::size_t i = 0; i < apart.data.size(); ++i) apart.data[i] -= table.data[i];
  const double rms =
      std::sqrt(std::inner_product(apart.data.begin(), apart.data.end(), apart.data.begin(), 0.0) /
                static_cast<double>(apart.data.size()));
  EXPECT_LT(rms, 5e-3);
  // Left alone for a while it finds its table by itself.
  matcap->set("turn_y", -40.0);
  EXPECT_GT(largest_difference(drawn(renderer, view), formula), 0.05);
  for (int i = 0; i < 500 && matcap->shader().entry != "matcap_by_normal"; ++i) drawn(renderer, view);
  EXPECT_EQ(matcap->shader().entry, "matcap_by_normal");
}

TEST(Changes, TurningTangentsOnTheGpuIsTurningThoseOfTheMesh) {
  test::context();
  scene::Scene scene =
      test::scene_of(test::torus(), std::make_shared<amc::AmcAppearance>(test::analytic_table(32, 64, 1)),
                     {.tangent_angle = scene::TangentAngle::fragment});
  Renderer renderer(scene);
  const scene::View view = view_of(scene);
  const Image straight = picture(renderer, view);
  renderer.set_tangent_turn(radians(35));
  const Image turned = picture(renderer, view);
  geometry::rotate_tangents(scene.mesh, radians(35));
  EXPECT_GT(largest_difference(straight, turned), 0.1);
  EXPECT_LT(largest_difference(turned, picture(Renderer(scene), view)), 2e-3);
}

TEST(Changes, OpenGlStateIsPutBack) {
  test::context();
  const auto material = std::make_shared<brdf::LayeredAppearance>(test::glossy());
  const scene::Scene scene = test::scene_of(test::torus(), material, {}, test::everything());
  const scene::View view = view_of(scene);
  GLuint texture = 0;
  GLuint sampler = 0;
  GLuint vertex_array = 0;
  glGenTextures(1, &texture);
  glGenSamplers(1, &sampler);
  glGenVertexArrays(1, &vertex_array);
  const gpu::Framebuffer window(32, 16);
  window.bind();
  glViewport(1, 2, 3, 4);
  glClearColor(0.1f, 0.2f, 0.3f, 0.4f);
  glEnable(GL_BLEND);
  glEnable(GL_CULL_FACE);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, 1, 1);
  glDisable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  glColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_3D, texture);
  glBindSampler(1, sampler);
  glActiveTexture(GL_TEXTURE3);
  glBindVertexArray(vertex_array);
  const auto state = [] {
    std::vector<GLint> values;
    for (const int name : {GL_DRAW_FRAMEBUFFER_BINDING, GL_READ_FRAMEBUFFER_BINDING, GL_CURRENT_PROGRAM,
                           GL_VERTEX_ARRAY_BINDING, GL_ARRAY_BUFFER_BINDING, GL_ACTIVE_TEXTURE, GL_BLEND,
                           GL_CULL_FACE, GL_SCISSOR_TEST, GL_DEPTH_TEST, GL_DEPTH_WRITEMASK,
                           GL_UNPACK_ALIGNMENT, GL_PACK_ALIGNMENT, GL_DEPTH_FUNC, GL_RENDERBUFFER_BINDING}) {
      glGetIntegerv(static_cast<GLenum>(name), &values.emplace_back());
    }
    std::array<GLint, 4> four{};
    glGetIntegerv(GL_VIEWPORT, four.data());
    values.insert(values.end(), four.begin(), four.end());
    glGetIntegerv(GL_COLOR_WRITEMASK, four.data());
    values.insert(values.end(), four.begin(), four.end());
    std::array<GLfloat, 4> clear{};
    glGetFloatv(GL_COLOR_CLEAR_VALUE, clear.data());
    for (const GLfloat c : clear) values.push_back(static_cast<GLint>(100 * c + 0.5f));
    glActiveTexture(GL_TEXTURE1);
    glGetIntegerv(GL_TEXTURE_BINDING_3D, &values.emplace_back());
    glGetIntegerv(GL_SAMPLER_BINDING, &values.emplace_back());
    glActiveTexture(GL_TEXTURE3);
    return values;
  };
  const auto before = state();
  {
    Renderer renderer(scene);
    EXPECT_EQ(state(), before);
    picture(renderer, view);
    EXPECT_EQ(state(), before);
    renderer.draw(view);
    EXPECT_EQ(state(), before);
  }
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glBindSampler(1, 0);
  glBindVertexArray(0);
  glDeleteTextures(1, &texture);
  glDeleteSamplers(1, &sampler);
  glDeleteVertexArrays(1, &vertex_array);
}

TEST(Changes, AContextThatSomebodyElseMadeIsAdopted) {
  const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE) {
    GTEST_SKIP() << "no surfaceless display";
  }
  const scene::Scene scene =
      test::scene_of(test::torus(), std::make_shared<matcap::MatCap>(test::test_matcap()));
  test::context();
  const Image expected = picture(Renderer(scene), view_of(scene));
  eglBindAPI(EGL_OPENGL_API);
  constexpr std::array<EGLint, 5> wanted{EGL_CONTEXT_MAJOR_VERSION_KHR, 3, EGL_CONTEXT_MINOR_VERSION_KHR, 3,
                                         EGL_NONE};
  const EGLContext context = eglCreateContext(display, nullptr, EGL_NO_CONTEXT, wanted.data());
  ASSERT_NE(context, EGL_NO_CONTEXT);
  ASSERT_EQ(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context), EGL_TRUE);
  const Image there = draw_picture(scene, {.width = kPictureSide, .height = kPictureSide, .samples = 1}, {},
                                   rotation_xyz({0.4, 0.3, 0}))
                          .colour;
  EXPECT_EQ(eglGetCurrentContext(), context);
  EXPECT_EQ(largest_difference(there, expected), 0);
  eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display, context);
}

/// Round holes cut along u and v, and a colour by uv: an appearance from outside the library.
class Holes final : public appearance::BakedLight {
 public:
  Vec3 evaluate(const appearance::Surface& s) const override {
    return {0.5 + 0.5 * s.uv.x(), s.uv.y(), 0.25};
  }
  double cover(appearance::Surface& s) const override {
    const Vec2 cell = 4 * s.uv - (4 * s.uv).array().floor().matrix() - Vec2(0.5, 0.5);
    return cell.norm() > 0.3 ? 1 : 0;
  }
  appearance::ShaderModule shader() const override {
    return {.texts = {{"holes.glsl",
                       "// needs: surface.glsl\n"
                       "uniform float holes_radius;\n"
                       "vec3 holes(Surface s) { return vec3(0.5 + 0.5 * s.uv.x, s.uv.y, 0.25); }\n"
                       "float holes_cover(inout Surface s) {\n"
                       "  return length(fract(4.0 * s.uv) - 0.5) > holes_radius ? 1.0 : 0.0;\n"
                       "}\n"}},
            .defines = {},
            .entry = "holes",
            .point = "",
            .covers = true};
  }
  appearance::ShaderValues values() const override {
    return {.uniforms = {{"holes_radius", 0.3f}}, .textures = {}};
  }
  appearance::Needs needs() const override { return {.uvs = true}; }
};

TEST(Changes, AnAppearanceFromOutsideMayHaveHoles) {
  const scene::Scene scene = test::scene_of(test::plane(), std::make_shared<Holes>());
  const Picture frame = test::render(scene, test::in_view_space(64));
  const Image mask = scene::aov(*frame.surfaces, "mask");
  int holes = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      appearance::Surface s;
      s.uv = Vec2((x + 0.5) / 64, 1 - (y + 0.5) / 64);
      const float expected = static_cast<float>(Holes().cover(s));
      EXPECT_EQ(mask.at(x, y, 0), expected);
      EXPECT_EQ(frame.colour.at(x, y, 3), expected);
      if (expected < 0.5f) {
        ++holes;
      } else {
        EXPECT_LT((frame.colour.rgb(x, y).cast<double>() - Holes().evaluate(s)).norm(), 1e-4);
      }
    }
  }
  EXPECT_NEAR(holes / 4096.0, kPi * 0.09, 0.02);
}

TEST(SurfaceFields, FootprintIsTheChangeOfUvFromPixelToPixel) {
  const scene::Scene scene = test::scene_of(test::plane(), std::make_shared<scene::Constant>(Vec3::Ones()));
  const Picture frame = test::render(scene, test::in_view_space(64));
  const Image footprint = scene::aov(*frame.surfaces, "footprint");
  for (const auto& [x, y] : {std::pair{5, 7}, std::pair{40, 22}}) {
    EXPECT_NEAR(footprint.at(x, y, 0), 1.0 / 64, 1e-6);
    EXPECT_NEAR(footprint.at(x, y, 1), 0, 1e-6);
    EXPECT_NEAR(footprint.at(x, y, 2), 0, 1e-6);
    EXPECT_NEAR(footprint.at(x, y, 3), 1.0 / 64, 1e-6);
  }
}

TEST(SurfaceFields, CurvatureOfATorusAlongItsTangents) {
  // Around the tube 1 / r; around the ring cos(b) / (R + r cos(b)).
  Mesh mesh = test::torus(0.4, 192, 96);
  geometry::compute_curvature(mesh);
  const scene::Scene scene = test::scene_of(mesh, std::make_shared<scene::Constant>(Vec3::Ones()));
  const Picture frame = test::render(
      scene, {.width = kPictureSide, .height = kPictureSide, .rotation = rotation_xyz({0.5, 0.3, 0})});
  const Mat4 to_view =
      scene::frame_object(mesh, {}, std::array{rotation_xyz({0.5, 0.3, 0})}, 1)[0].view_from_object;
  int seen = 0;
  for (int y = 0; y < kPictureSide; ++y) {
    for (int x = 0; x < kPictureSide; ++x) {
      const auto s = scene::surface_at(*frame.surfaces, x, y);
      if (!s) continue;
      const Vec3 p = (to_view.inverse() * s->position.homogeneous()).head<3>();
      const double out = p.head<2>().norm();
      // Seen from behind, at the rim, what was convex is concave.
      const double ring = s->side * (out - 1) / 0.4 / out;
      const double tube = s->side * 2.5;
      ++seen;
      EXPECT_NEAR(s->curvature_tensor[0], ring, 0.06) << x << " " << y;
      EXPECT_NEAR(s->curvature_tensor[1], 0, 0.06);
      EXPECT_NEAR(s->curvature_tensor[2], tube, 0.06);
      EXPECT_NEAR(s->curvature, (ring + tube) / 2, 0.06);
    }
  }
  EXPECT_GT(seen, 1000);
}

}  // namespace
}  // namespace sateen::render
