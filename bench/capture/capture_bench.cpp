// SPDX-License-Identifier: MIT
// 128 photographs of 1280 x 720 to an AMC, beside decoding them twice: the least any two-pass capture has to
// do.
#include <chrono>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <sys/resource.h>

#include "capture/simulator.h"
#include "sateen/capture/capture.h"
#include "sateen/core/parallel.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "support/files.h"

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

void photographs_to_amc(benchmark::State& state) {
  sateen::test::Simulation s;
  s.width = 1280;
  s.height = 720;
  s.focal = 2489;
  s.centre = {712, 381};
  s.radius = 150;
  s.frames = 128;
  s.noise = 1;
  s.seam = true;
  s.samples = 1;
  const sateen::test::TemporaryFolder folder;
  sateen::parallel_for(s.frames, [&](int i) {
    const sateen::Picture8 picture = s.render(i);
    sateen::Image image(s.width, s.height, 3);
    for (std::size_t k = 0; k < picture.rgb.size(); ++k)
      image.data[k] = static_cast<float>(picture.rgb[k]) / 255;
    for (float& v : image.data) v = v * v;  // any encoding compresses alike
    sateen::write_image(folder / fmt::format("frame_{:03}.jpg", i), image);
  });
  const auto files = sateen::expand_inputs({folder.path()}, sateen::image_extensions());
  sateen::CaptureOptions options;
  options.fov = 0.5;
  double decode = 0;
  double decode_cpu = 0;
  double build = 0;
  double build_cpu = 0;
  for (auto _ : state) {
    auto start = Clock::now();
    double cpu = cpu_seconds();
    for (int pass = 0; pass < 2; ++pass) {
      sateen::parallel_for(s.frames, [&](int i) {
        benchmark::DoNotOptimize(sateen::read_picture8(files[static_cast<std::size_t>(i)]));
      });
    }
    decode += seconds_since(start);
    decode_cpu += cpu_seconds() - cpu;
    start = Clock::now();
    cpu = cpu_seconds();
    benchmark::DoNotOptimize(sateen::build_capture({folder.path()}, options));
    build += seconds_since(start);
    build_cpu += cpu_seconds() - cpu;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto n = static_cast<double>(state.iterations());
  state.counters["decode_twice_s"] = decode / n;
  state.counters["build_s"] = build / n;
  state.counters["times_decoding"] = build / decode;
  state.counters["times_decoding_cpu"] = build_cpu / decode_cpu;
  state.counters["peak_MB"] = static_cast<double>(usage.ru_maxrss) / 1024;
}
BENCHMARK(photographs_to_amc)->Unit(benchmark::kSecond)->Iterations(2);

}  // namespace
