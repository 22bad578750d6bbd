// SPDX-License-Identifier: MIT
// What a change between two frames costs, in frames of 512 x 512: the time from the change to the finished
// next frame, less a frame without one. The last line is the longest time the drawing thread was held while a
// fuzz's tables were made.
#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <vector>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "sateen/amc/appearance.h"
#include "sateen/core/direction.h"
#include "sateen/gpu/context.h"
#include "sateen/gpu/framebuffer.h"
#include "sateen/gpu/timer.h"
#include "sateen/io/image.h"
#include "sateen/light/environment.h"
#include "sateen/matcap/decomposed_appearance.h"
#include "sateen/matcap/sphere_disc.h"
#include "sateen/render/renderer.h"
#include "sateen/scene/load_scene.h"
#include "support/analytic_material.h"
#include "support/files.h"

namespace {

using namespace sateen;

constexpr int kSide = 512;
constexpr int kRounds = 15;

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

/// A jacket in one material, and the frames it is drawn in.
struct Stage {
  scene::Scene scene;
  render::Renderer renderer;
  scene::View view;
  const gpu::Framebuffer& target;

  Stage(scene::Scene drawn, const gpu::Framebuffer& on)
      : scene(std::move(drawn)),
        renderer(scene),
        view(scene::frame_object(scene.mesh, {}, std::array{rotation_xyz({0, 0.5, 0})}, 1)[0]),
        target(on) {}

  double frame(const std::function<void()>& change = {}) const {
    target.bind();
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    const gpu::Timer timer;
    if (change) change();
    renderer.draw(view);
    return timer.seconds();
  }
  appearance::Appearance& material() const { return *scene.materials[0].appearance; }
};

/// Frames with and without the change in turn, so that a busy machine slows them alike.
void report_change(const char* what, const Stage& stage, const std::function<void(int)>& change) {
  std::vector<double> with;
  std::vector<double> without;
  for (int i = 0; i < kRounds; ++i) {
    with.push_back(stage.frame([&] { change(i); }));
    without.push_back(stage.frame());
  }
  const double plain = median(without);
  fmt::print("{:<52} {:>8.2f} ms {:>8.2f} frames\n", what, plain * 1e3, median(with) / plain - 1);
}

scene::Scene jacket(std::shared_ptr<appearance::Appearance> appearance) {
  static const std::filesystem::path mesh = test::examples() / "garment" / "jacket.obj";
  scene::SceneOptions options;
  options.material = test::examples() / "materials" / "velvet.json";
  scene::Scene scene = scene::load_scene(mesh, options);
  scene.materials[0].appearance = std::move(appearance);
  scene.lighting.surroundings =
      light::make_surroundings(light::read_environment(test::examples() / "environments" / "studio.hdr"));
  return scene;
}

}  // namespace

int main() {
  const gpu::Context context;
  const gpu::Framebuffer target(kSide, kSide);
  fmt::print("{:<52} {:>11} {:>15}\n", fmt::format("{}, {} x {}", context.renderer(), kSide, kSide),
             "a frame", "the change");
  const auto example = [](const char* name) {
    return scene::load_appearance(test::examples() / "materials" / name);
  };

  Stage satin(jacket(example("satin.json")), target);
  const light::Lighting lighting = satin.scene.lighting;
  report_change("turning the environment", satin, [&](int i) {
    light::Lighting turned = lighting;
    turned.surroundings = light::turned(lighting.surroundings, light::turn_about_vertical(0.1 * i));
    satin.renderer.set_lighting(turned);
  });
  report_change("a colour of a layered material", satin,
                [&](int i) { satin.material().set("base.color", Vec3(0.05 * i, 0.3, 0.2)); });

  const Image ball = io::read_image(test::examples() / "matcaps" / "jade.exr");
  const auto matcap = std::make_shared<matcap::DecomposedAppearance>(
      matcap::unedited(matcap::decompose(ball, matcap::inscribed_disc(ball.width, ball.height), {}, "jade")));
  Stage decomposed(jacket(matcap), target);
  decomposed.frame([&] { matcap->set("turn_y", 1.0); });
  report_change("turning a decomposed MatCap's light", decomposed,
                [&](int i) { matcap->set("turn_y", 5.0 * i); });
  report_change("a colour of a decomposed MatCap", decomposed,
                [&](int i) { matcap->set("high.color", Vec3(1, 0.05 * i, 0.5)); });
  report_change("roughness of a decomposed MatCap", decomposed,
                [&](int i) { matcap->set("high.roughness", 0.005 * i); });

  Stage silk(jacket(std::make_shared<amc::AmcAppearance>(test::analytic_table(128, 128, 2))), target);
  report_change("the tangent angle of an AMC", silk, [&](int i) { silk.renderer.set_tangent_turn(0.1 * i); });
  report_change("another material (an AMC, seen before)", silk,
                [&](int) { silk.renderer.set_material(0, silk.scene.materials[0]); });

  Stage velvet(jacket(example("velvet.json")), target);
  std::vector<double> plain;
  for (int i = 0; i < kRounds; ++i) plain.push_back(velvet.frame());
  const std::uint64_t before = velvet.material().revision();
  double longest = velvet.frame([&] { velvet.material().set("fuzz.density", 0.5); });
  int frames = 1;
  for (; velvet.material().revision() == before && frames < 100000; ++frames)
    longest = std::max(longest, velvet.frame());
  fmt::print("{:<52} {:>8.2f} ms {:>8.2f} frames\n",
             fmt::format("fuzz density: longest wait, shown after {} frames", frames), median(plain) * 1e3,
             longest / median(plain) - 1);
  return 0;
}
