// SPDX-License-Identifier: MIT
// What fuzz costs in the shader, beside anisotropic GGX alone: a square that fills 512 x 512 pixels, seen at
// an angle. Wall clock around glFinish, because timer queries mean nothing on software drivers; best of
// several rounds, each material in turn, so that a busy machine hits all alike.
#include <algorithm>
#include <limits>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "sateen/brdf/research/slides.h"
#include "sateen/core/direction.h"
#include "sateen/gpu/context.h"
#include "sateen/gpu/framebuffer.h"
#include "sateen/gpu/timer.h"
#include "sateen/render/renderer.h"
#include "sateen/scene/constant.h"
#include "support/shapes.h"

namespace {

using namespace sateen;

struct Case {
  const char* name;
  std::shared_ptr<appearance::Appearance> appearance;
  double best = std::numeric_limits<double>::infinity();
};

std::vector<Case> cases() {
  brdf::LayeredMaterial ggx;
  ggx.specular = brdf::GgxParameters{{0.2, 0.5, 0.3}, {0.1, 0.1, 0.1}, false};
  brdf::LayeredMaterial fuzz;
  fuzz.fuzz = brdf::FuzzParameters{};
  fuzz.fuzz->tilt = radians(30);
  const brdf::SlidesMaterial slides{.layers = fuzz, .polynomials = true};
  brdf::LayeredMaterial both = fuzz;
  both.specular = ggx.specular;
  const brdf::SlidesMaterial simple{.simple_fuzziness = 0.7};
  const auto look = [&](const brdf::LayeredMaterial& material) {
    return std::make_shared<brdf::LayeredAppearance>(material);
  };
  const auto printed = [](const brdf::SlidesMaterial& material) {
    return std::make_shared<brdf::SlidesAppearance>(material);
  };
  return {{"constant colour", std::make_shared<scene::Constant>(Vec3::Ones())},
          {"anisotropic GGX", look(ggx)},
          {"fuzz, table", look(fuzz)},
          {"fuzz, slides' polynomials", printed(slides)},
          {"fuzz over GGX", look(both)},
          {"simplified fuzz", printed(simple)}};
}

void measure(const char* title, const light::Lighting& lighting) {
  constexpr int kSize = 512;
  constexpr int kRounds = 9;
  std::vector<Case> all = cases();
  scene::Camera camera;
  camera.kind = scene::Camera::Kind::view_space;
  const std::vector<Mat3> pose{rotation_xyz({-0.4, 0.3, 0})};
  const gpu::Framebuffer target(kSize, kSize);
  std::vector<render::Renderer> renderers;
  scene::Scene scene;
  scene.mesh = test::plane();
  for (Vec3f& p : scene.mesh.positions) p *= 1.6f;
  scene.materials.resize(1);
  scene.lighting = lighting;
  for (const Case& one : all) {
    scene.materials[0].appearance = one.appearance;
    renderers.emplace_back(scene);
  }
  const scene::View view = scene::frame_object(scene.mesh, camera, pose, 1)[0];
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      target.bind();
      gpu::Timer timer;
      for (int repeat = 0; repeat < 4; ++repeat) {
        glClear(GL_DEPTH_BUFFER_BIT);
        renderers[i].draw(view);
      }
      const double seconds = timer.seconds() / 4;
      if (round > 0) all[i].best = std::min(all[i].best, seconds);
    }
  }
  fmt::print("{}\n{:<28} {:>12} {:>18}\n", title, "", "ns a pixel", "against GGX alone");
  for (const Case& one : all) {
    fmt::print("{:<28} {:>12.1f} {:>18.2f}\n", one.name, one.best * 1e9 / (kSize * kSize),
               one.best / all[1].best);
  }
  fmt::print("\n");
}

}  // namespace

int main() {
  const gpu::Context context;
  context.make_current();
  light::PunctualLight lamp;
  lamp.direction = Vec3(-0.4, 0.6, 0.7).normalized();
  light::Lighting lighting;
  lighting.surroundings.harmonics.c[0] = Vec3::Constant(0.3);
  lighting.lamps = {lamp};
  measure("one lamp and harmonics", lighting);
  lighting.lamps = {lamp, lamp, lamp, lamp};
  measure("four lamps and harmonics", lighting);
  lighting.lamps.clear();
  lighting.surroundings = light::make_surroundings(Image(64, 32, 3, 0.5f));
  measure("an environment map (eight lookups along the GGX lobe)", lighting);
  return 0;
}
