// SPDX-License-Identifier: MIT
// The separation beside comparing all pairs of pixels, and the whole decomposition. Brute force at 800 x 800
// would take minutes: it answers one in kStride packets of 64 directions, and its time is scaled up; the
// ratio is in the counters.
#include <chrono>

#include <benchmark/benchmark.h>

#include "sateen/core/image.h"
#include "sateen/core/parallel.h"
#include "sateen/matcap/decomposition.h"
#include "sateen/matcap/separation.h"
#include "support/matcaps.h"
#include "support/opening_brute_force.h"

namespace sateen {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Image values(int size) {
  return to_add_up_space(test::example_matcap("ceramic", size), AddUpSpace::display);
}

/// Erosion and dilation of three channels on one core by comparing all pairs, in seconds.
double brute_force_seconds(const Image& image, std::size_t stride) {
  const Disc disc = inscribed_disc(image.width, image.height);
  const test::SpherePixels pixels = test::sphere_pixels(image.width, image.height, disc);
  std::vector<float> x, y, z;
  for (std::size_t i = 0; i < pixels.pixel.size(); ++i) {
    const float s = 1 / std::max(image.data[3 * pixels.pixel[i]], 1e-20F);
    x.push_back(s * pixels.x[i]);
    y.push_back(s * pixels.y[i]);
    z.push_back(s * pixels.z[i]);
  }
  const auto start = Clock::now();
  benchmark::DoNotOptimize(test::support_brute_force(pixels, x, y, z, stride));
  return 6 * static_cast<double>(stride) * seconds_since(start);
}

void separation(benchmark::State& state) {
  limit_threads(1);
  const Image image = values(static_cast<int>(state.range(0)));
  const Disc disc = inscribed_disc(image.width, image.height);
  double total = 0;
  for (auto _ : state) {
    const auto start = Clock::now();
    benchmark::DoNotOptimize(separate(image, disc, Outliers::ignore, "ceramic"));
    total += seconds_since(start);
  }
  const double brute = brute_force_seconds(image, static_cast<std::size_t>(state.range(1)));
  state.counters["brute_force_s"] = brute;
  state.counters["times_faster"] = brute / (total / static_cast<double>(state.iterations()));
  limit_threads(0);
}
BENCHMARK(separation)->Args({400, 8})->Args({800, 64})->Unit(benchmark::kMillisecond)->UseRealTime();

void decomposition(benchmark::State& state) {
  const int size = static_cast<int>(state.range(0));
  const Image image = test::example_matcap("ceramic", size);
  const Disc disc = inscribed_disc(size, size);
  for (auto _ : state) benchmark::DoNotOptimize(decompose(image, disc, {}, "ceramic"));
}
BENCHMARK(decomposition)->Arg(400)->Arg(800)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace sateen
