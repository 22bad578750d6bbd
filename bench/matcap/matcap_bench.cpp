// SPDX-License-Identifier: MIT
// The separation beside comparing all pairs of pixels, on flat pictures, which once were its worst case, and
// on two threads; and the whole decomposition. Brute force on large pictures would take minutes: it answers
// one in so many packets of 64 directions, and its time is scaled up; the ratio is in the counters.
#include <array>
#include <cmath>
#include <ctime>

#include <benchmark/benchmark.h>

#include "sateen/core/allocation.h"
#include "sateen/core/image.h"
#include "sateen/core/parallel.h"
#include "sateen/matcap/decomposition.h"
#include "sateen/matcap/separation.h"
#include "support/matcaps.h"
#include "support/opening_brute_force.h"

namespace sateen::matcap {
namespace {

/// Processor time of this program, which other programs do not lengthen; on one thread, what the clock on the
/// wall says on an idle machine.
double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
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
  const double start = processor_seconds();
  benchmark::DoNotOptimize(test::support_brute_force(pixels, x, y, z, stride));
  return 6 * static_cast<double>(stride) * (processor_seconds() - start);
}

/// Processor time of one separation.
double separation_seconds(benchmark::State& state, const Image& image, int threads) {
  limit_threads(threads);
  const Disc disc = inscribed_disc(image.width, image.height);
  const double start = processor_seconds();
  for (auto _ : state) benchmark::DoNotOptimize(separate(image, disc, Outliers::ignore, "bench"));
  const double total = processor_seconds() - start;
  limit_threads(0);
  return total / static_cast<double>(state.iterations());
}

void separation(benchmark::State& state) {
  const Image image = values(static_cast<int>(state.range(0)));
  const double seconds = separation_seconds(state, image, 1);
  const double brute = brute_force_seconds(image, static_cast<std::size_t>(state.range(1)));
  state.counters["brute_force_s"] = brute;
  state.counters["times_faster"] = brute / seconds;
}
BENCHMARK(separation)
    ->Args({400, 8})
    ->Args({800, 64})
    ->Args({2048, 2048})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void separation_two_threads(benchmark::State& state) {
  separation_seconds(state, values(static_cast<int>(state.range(0))), 2);
}
BENCHMARK(separation_two_threads)->Arg(400)->Arg(800)->Unit(benchmark::kMillisecond)->UseRealTime();

/// One colour; two halves; a gradient in 8 bits; a gradient in floating point.
Image flat_values(int size, int kind) {
  Image image(size, size, 3);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double across = (x + 0.5) / size;
      const double gradient = 0.2 + 0.4 * across + 0.2 * (y + 0.5) / size;
      const std::array<double, 4> value{0.3, across < 0.6 ? 0.3 : 0.6, std::round(255 * gradient) / 255,
                                        gradient};
      image.set_rgb(x, y, Vec3f::Constant(static_cast<float>(value[static_cast<std::size_t>(kind)])));
    }
  }
  return image;
}

void flat_separation(benchmark::State& state) {
  static constexpr std::array<const char*, 4> kKinds{"one colour", "two colours", "8-bit gradient",
                                                     "gradient"};
  const auto kind = static_cast<std::size_t>(state.range(1));
  state.SetLabel(kKinds[kind]);
  separation_seconds(state, flat_values(static_cast<int>(state.range(0)), static_cast<int>(kind)), 1);
}
BENCHMARK(flat_separation)
    ->ArgsProduct({{400, 800, 2048}, {0, 1, 2, 3}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void decomposition(benchmark::State& state) {
  keep_freed_memory();  // as the program does
  const int size = static_cast<int>(state.range(0));
  const Image image = test::example_matcap("ceramic", size);
  const Disc disc = inscribed_disc(size, size);
  for (auto _ : state) benchmark::DoNotOptimize(decompose(image, disc, {}, "ceramic"));
}
BENCHMARK(decomposition)->Arg(400)->Arg(800)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace sateen::matcap
