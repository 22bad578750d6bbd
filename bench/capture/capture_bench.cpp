// SPDX-License-Identifier: MIT
// 128 photographs of 1280 x 720 to an AMC, beside decoding them twice with the same decoder and as many
// threads: the least any two-pass capture has to do. One round takes about four seconds on two cores.
#include <chrono>
#include <cmath>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sys/resource.h>

#include "capture/simulator.h"
#include "sateen/capture/capture.h"
#include "sateen/core/median.h"
#include "sateen/core/parallel.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "support/files.h"

namespace {

using Clock = std::chrono::steady_clock;

rusage usage_now() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage;
}

double cpu_seconds() {
  const rusage usage = usage_now();
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

/// Seconds by the clock and of all processors, one entry a round.
struct Cost {
  std::vector<double> clock;
  std::vector<double> cpu;
};

void measure(Cost& cost, const std::function<void()>& work) {
  const auto start = Clock::now();
  const double cpu = cpu_seconds();
  work();
  cost.cpu.push_back(cpu_seconds() - cpu);
  cost.clock.push_back(std::chrono::duration<double>(Clock::now() - start).count());
}

sateen::test::Simulation photographed() {
  sateen::test::Simulation s;
  s.width = 1280;
  s.height = 720;
  s.focal = 2489;
  s.centre = {712, 381};
  s.radius = 150;
  s.frames = 128;
  s.noise = 1;
  s.blur = 0;
  s.seam = true;
  s.samples = 1;
  return s;
}

void write_photographs(const sateen::test::Simulation& s, const std::filesystem::path& folder) {
  static_cast<void>(s.render(0));  // draws the background that all share
  sateen::parallel_for(s.frames, [&](int i) {
    sateen::io::Picture8 picture = s.render(i);
    cv::Mat pixels(s.height, s.width, CV_8UC3, picture.rgb.data());
    cv::cvtColor(pixels, pixels, cv::COLOR_RGB2BGR);
    cv::imwrite((folder / fmt::format("frame_{:03}.jpg", i)).string(), pixels,
                {cv::IMWRITE_JPEG_QUALITY, 90});
  });
}

void photographs_to_amc(benchmark::State& state) {
  const sateen::test::Simulation s = photographed();
  const sateen::test::TemporaryFolder folder;
  write_photographs(s, folder.path());
  const auto files = sateen::io::expand_inputs({folder.path()}, sateen::io::image_extensions());
  sateen::capture::CaptureOptions options;
  options.lens.fov = 2 * std::atan(s.width / 2.0 / s.focal);
  options.tangent.given = true;
  Cost decode;
  Cost build;
  for (auto _ : state) {
    measure(decode, [&] {
      for (int pass = 0; pass < 2; ++pass) {
        sateen::parallel_for(s.frames, [&](int i) {
          benchmark::DoNotOptimize(sateen::io::read_picture8(files[static_cast<std::size_t>(i)]));
        });
      }
    });
    measure(build,
            [&] { benchmark::DoNotOptimize(sateen::capture::build_capture({folder.path()}, options)); });
  }
  const double decode_seconds = sateen::median(decode.clock);
  const double build_seconds = sateen::median(build.clock);
  state.counters["decode_twice_s"] = decode_seconds;
  state.counters["build_s"] = build_seconds;
  state.counters["times_decoding"] = build_seconds / decode_seconds;
  state.counters["times_decoding_cpu"] = sateen::median(build.cpu) / sateen::median(decode.cpu);
  state.counters["peak_MB"] = static_cast<double>(usage_now().ru_maxrss) / 1024;
}
BENCHMARK(photographs_to_amc)->Unit(benchmark::kSecond)->Iterations(3);

}  // namespace
