// SPDX-License-Identifier: MIT
// The cost of looking at an appearance: constant colour, plain MatCap, decomposed MatCap, AMC with the two-k
// trick and with its angle per fragment; on an object that fills the picture with few triangles, and on a
// dense mesh. docs/rendering.md says how to read it. The last case is `sateen render` from the command line
// to its first picture.
#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>
#include <epoxy/gl.h>

#include "sateen/amc/amc_file.h"
#include "sateen/amc/appearance.h"
#include "sateen/core/direction.h"
#include "sateen/gpu/context.h"
#include "sateen/gpu/framebuffer.h"
#include "sateen/gpu/timer.h"
#include "sateen/matcap/decomposed_appearance.h"
#include "sateen/matcap/matcap.h"
#include "sateen/render/renderer.h"
#include "sateen/scene/constant.h"
#include "support/analytic_material.h"
#include "support/files.h"
#include "support/shapes.h"

namespace sateen::render {
namespace {

constexpr int kSide = 1024;

enum Subject : std::size_t { kConstant, kMatCap, kDecomposed, kAmc, kAmcPerFragment };

/// Full-screen: 2048 triangles over every pixel, bent so that normals and tangents vary.
Mesh sheet() {
  Mesh mesh = test::plane(32);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3 p = mesh.positions[i].cast<double>();
    const Vec3 n = Vec3(0.6 * std::sin(5 * p.x()), 0.6 * std::cos(4 * p.y()), 1).normalized();
    const double angle = 3 * p.x() + 2 * p.y();
    const Vec3 t = Vec3(std::cos(angle), std::sin(angle), 0);
    mesh.normals[i] = n.cast<float>();
    mesh.tangents[i] << (t - n * n.dot(t)).normalized().cast<float>(), 1;
  }
  return mesh;
}

std::shared_ptr<appearance::Appearance> appearance(Subject subject) {
  if (subject == kConstant) return std::make_shared<scene::Constant>(Vec3(0.2, 0.4, 0.6));
  amc::AmcTable table = test::analytic_table(128, 128, 2);
  table.encoding = amc::AmcEncoding::srgb8;
  amc::quantise(table);
  if (subject == kDecomposed) {
    return std::make_shared<matcap::DecomposedAppearance>(matcap::unedited(
        matcap::decompose(amc::isotropic_average(table), matcap::inscribed_disc(128, 128), {}, "matcap")));
  }
  if (subject == kMatCap) return std::make_shared<matcap::MatCap>(amc::isotropic_average(table));
  return std::make_shared<amc::AmcAppearance>(table);
}

constexpr std::array kSubjects{kConstant, kMatCap, kDecomposed, kAmc, kAmcPerFragment};
constexpr std::array kNames{"constant", "matcap", "decomposed_matcap", "amc", "amc_per_fragment"};

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

/// Draws all subjects in turn in every iteration, so that a busy machine slows them alike. Reports the median
/// milliseconds of the plain MatCap's frame, and the others' as multiples of it.
void draw(benchmark::State& state, const Mesh& mesh, const scene::Camera& camera) {
  const gpu::Context context;
  std::vector<Renderer> renderers;
  for (const Subject subject : kSubjects) {
    scene::Scene scene;
    scene.mesh = mesh;
    scene.materials.resize(1);
    scene.materials[0].appearance = appearance(subject);
    if (subject == kAmcPerFragment) scene.switches.tangent_angle = scene::TangentAngle::fragment;
    renderers.emplace_back(scene);
  }
  const std::vector<Mat3> pose{Mat3::Identity()};
  const scene::View view = scene::frame_object(mesh, camera, pose, 1)[0];
  const gpu::Framebuffer target(kSide, kSide);
  const auto frame = [&](const Renderer& renderer) {
    gpu::Timer timer;
    target.bind();
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    renderer.draw(view);
    return timer.seconds();
  };
  for (const Renderer& renderer : renderers) frame(renderer);
  std::array<std::vector<double>, kSubjects.size()> times;
  for (auto _ : state) {
    for (std::size_t i = 0; i < renderers.size(); ++i) times[i].push_back(frame(renderers[i]));
  }
  const double matcap = median(times[kMatCap]);
  state.counters["matcap_ms"] = matcap * 1e3;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (i != kMatCap) state.counters[kNames[i]] = median(times[i]) / matcap;
  }
  state.SetLabel(context.renderer());
}

void full_screen(benchmark::State& state) {
  draw(state, sheet(), {.kind = scene::Camera::Kind::view_space});
}

/// 295 thousand triangles.
void dense_mesh(benchmark::State& state) {
  draw(state, test::torus(0.4, 512, 288), {});
}

BENCHMARK(full_screen)->UseRealTime()->Unit(benchmark::kMillisecond)->MinTime(2);
BENCHMARK(dense_mesh)->UseRealTime()->Unit(benchmark::kMillisecond)->MinTime(2);

void first_picture(benchmark::State& state) {
  const test::TemporaryFolder folder;
  amc::AmcTable table = test::analytic_table(128, 128, 2);
  table.encoding = amc::AmcEncoding::srgb8;
  amc::quantise(table);
  amc::write_amc(folder / "material.ktx2", table);
  const std::string arguments =
      fmt::format("render {} --material {} -o {} --size 1024x1024",
                  (test::examples() / "garment" / "jacket.obj").string(), (folder / "material.ktx2").string(),
                  (folder / "picture.png").string());
  for (auto _ : state) {
    if (test::run_program(arguments).exit_code != 0) state.SkipWithError("the program failed");
  }
}
BENCHMARK(first_picture)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace sateen::render
