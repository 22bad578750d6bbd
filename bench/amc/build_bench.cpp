// SPDX-License-Identifier: MIT
//
// Building an AMC from 128 JPEG frames of 1280 x 720 against only decoding them, both on all processors.

#include <array>
#include <cstdint>

#include <OpenImageIO/imageio.h>
#include <benchmark/benchmark.h>

#include "sateen/amc/amc_file.h"
#include "sateen/amc/build.h"
#include "sateen/core/parallel.h"
#include "sateen/io/image.h"
#include "support/analytic_material.h"
#include "support/files.h"

namespace sateen::amc {
namespace {

constexpr int kFrames = 128;
constexpr int kSphere = 640;
constexpr PixelRect kCrop{320, 40, kSphere, kSphere};

/// The frames, written once: a turning sphere on a noisy wall, as a camera would store it.
const std::vector<std::filesystem::path>& frames() {
  static const test::TemporaryFolder folder;
  static const std::vector<std::filesystem::path> files = [] {
    std::vector<std::filesystem::path> result;
    for (int i = 0; i < kFrames; ++i) result.push_back(folder / fmt::format("frame_{:03}.jpg", i));
    parallel_for(kFrames, [&](int i) {
      Image picture(1280, 720, 3);
      std::uint32_t state = static_cast<std::uint32_t>(i) + 1;
      for (float& v : picture.data) {
        state = state * 1664525u + 1013904223u;
        v = 0.2f + 0.02f * static_cast<float>(state >> 8) / static_cast<float>(1 << 24);
      }
      const Image sphere = test::photograph(
          kSphere, [&](const Vec3& n) { return test::analytic_colour(n, i / 128.0, 2); }, -1);
      for (int y = 0; y < kSphere; ++y) {
        for (int x = 0; x < kSphere; ++x) {
          if (sphere.at(x, y, 0) >= 0) picture.set_rgb(x + kCrop.x, y + kCrop.y, sphere.rgb(x, y));
        }
      }
      io::write_image(result[static_cast<std::size_t>(i)], picture);
    });
    return result;
  }();
  return files;
}

void decode_only() {
  parallel_for(kFrames, [&](int i) {
    const auto input = OIIO::ImageInput::open(frames()[static_cast<std::size_t>(i)].string());
    std::vector<std::uint8_t> pixels(input->spec().image_bytes());
    input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, pixels.data());
    benchmark::DoNotOptimize(pixels.data());
  });
}

void build() {
  LoadFramesOptions options;
  options.crop = kCrop;
  const LoadedFrames loaded = load_frames(frames(), options);
  const AmcTable table = build_amc(loaded.frames, analyse_symmetry(loaded.frames), {});
  static const test::TemporaryFolder output;
  write_amc(output / "x.ktx2", table);
}

template <class Work>
double seconds(Work work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// One of each in turn, so that a drifting clock meets both; the counter is the ratio.
void BuildAgainstDecode(benchmark::State& state) {
  frames();
  double decoding = 0;
  double building = 0;
  for (auto _ : state) {
    decoding += seconds(decode_only);
    building += seconds(build);
  }
  state.counters["decode_s"] = benchmark::Counter(decoding, benchmark::Counter::kAvgIterations);
  state.counters["build_s"] = benchmark::Counter(building, benchmark::Counter::kAvgIterations);
  state.counters["ratio"] = building / decoding;
}
BENCHMARK(BuildAgainstDecode)->Unit(benchmark::kSecond)->Iterations(3)->UseRealTime();

}  // namespace
}  // namespace sateen::amc
