// SPDX-License-Identifier: MIT
// A 4096 x 4096 normal and anisotropy map to whole mip chains: everything, against the files alone. "io"
// decodes both inputs and encodes files of the same sizes and samples as the result's, without filtering in
// between.
#include <cstdint>
#include <filesystem>
#include <string>

#include <benchmark/benchmark.h>

#include "sateen/core/parallel.h"
#include "sateen/io/image_rows.h"
#include "sateen/texture/lobe_files.h"
#include "support/files.h"

namespace {

using namespace sateen;
namespace fs = std::filesystem;

constexpr int kSize = 4096;

/// A weave with threads of 16 texels and some noise, as 8-bit PNG.
class Maps {
 public:
  Maps() {
    io::ImageRowWriter normal(folder_ / "normal.png", "normal.png", kSize, kSize, 3, io::RowSamples::u8);
    io::ImageRowWriter aniso(folder_ / "aniso.png", "aniso.png", kSize, kSize, 3, io::RowSamples::u8);
    std::vector<float> n(kSize * 3);
    std::vector<float> a(kSize * 3);
    std::uint32_t state = 1;
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        state = state * 1664525u + 1013904223u;
        const double noise = static_cast<double>(state >> 8) / (1 << 24) * 0.04 - 0.02;
        const texture::LobeTexel t = texel(x, y, noise);
        const Vec3 c = texture::encode_anisotropy(t.s, texture::AnisotropyEncoding::root);
        for (int k = 0; k < 3; ++k) {
          n[static_cast<std::size_t>(x * 3 + k)] = static_cast<float>(t.normal[k] / 2 + 0.5);
          a[static_cast<std::size_t>(x * 3 + k)] = static_cast<float>(c[k]);
        }
      }
      normal.write(n);
      aniso.write(a);
    }
    normal.close();
    aniso.close();
  }

  static texture::LobeTexel texel(int x, int y, double noise) {
    const bool over = ((x / 16) + (y / 16)) % 2 == 0;
    const double across = ((over ? y : x) % 16 + 0.5) / 8 - 1;
    const double along = ((over ? x : y) % 16 + 0.5) / 8 - 1;
    Vec3 n(0.4 * along + noise, 0.7 * across - noise, 1);
    if (!over) std::swap(n.x(), n.y());
    return {n.normalized(), brdf::roughness_matrix({0.35 + noise, 0.12, over ? kPi / 2 + noise : noise})};
  }

  texture::LobeMapFiles files() const {
    texture::LobeMapFiles files;
    files.normals = folder_ / "normal.png";
    files.anisotropy = folder_ / "aniso.png";
    return files;
  }
  const test::TemporaryFolder& folder() const { return folder_; }

 private:
  test::TemporaryFolder folder_;
};

const Maps& maps() {
  static const Maps maps;
  return maps;
}

void report(benchmark::State& state) {
  state.counters["Mtexel/s"] = benchmark::Counter(static_cast<double>(kSize) * kSize / 1e6,
                                                  benchmark::Counter::kIsIterationInvariantRate);
}

void chain(benchmark::State& state, texture::LobeOutput::Kind kind, texture::MipKernel kernel,
           texture::Bc7Effort effort) {
  maps();
  for (auto _ : state) {
    texture::LobeFileSource source(maps().files());
    texture::LobeOutput output;
    output.kind = kind;
    output.effort = effort;
    output.zstd_level = 3;
    texture::ChainOptions options;
    options.kernel = kernel;
    texture::write_lobe_chain(source, maps().folder() / "out.png", options, output);
  }
  report(state);
}

/// Reads one of the maps and writes files of the sizes of its chain.
void copy_chain(const fs::path& path, const std::string& name) {
  io::ImageRowReader reader(path);
  std::vector<float> strip(static_cast<std::size_t>(kSize) * 64 * 3);
  io::ImageRowWriter writer(maps().folder() / (name + "_0.png"), name, kSize, kSize, 3, io::RowSamples::u8);
  for (int y = 0; y < kSize; y += 64) {
    reader.read(strip);
    writer.write(strip);
  }
  writer.close();
  // Rows of the smaller levels: the same texels, for the same kind of content.
  for (int size = kSize / 2; size >= 1; size /= 2) {
    io::ImageRowWriter level(maps().folder() / (name + "_n.png"), name, size, size, 3, io::RowSamples::u8);
    for (int y = 0; y < size; ++y) {
      level.write(std::span(strip).subspan(static_cast<std::size_t>(y % 64 * kSize * 3),
                                           static_cast<std::size_t>(size * 3)));
    }
    level.close();
  }
}

/// Both maps side by side, on as many threads as the chain uses for its files.
void io(benchmark::State& state) {
  maps();
  for (auto _ : state) {
    parallel_for(2, [](int map) {
      if (map == 0) {
        copy_chain(maps().files().normals, "io_normal");
      } else {
        copy_chain(maps().files().anisotropy, "io_aniso");
      }
    });
  }
  report(state);
}

class Memory : public texture::LobeSource {
 public:
  Memory() : strip_(static_cast<std::size_t>(kSize) * 64) {
    for (int i = 0; i < kSize * 64; ++i)
      strip_[static_cast<std::size_t>(i)] = Maps::texel(i % kSize, i / kSize, 0.01);
  }
  int width() const override { return kSize; }
  int height() const override { return kSize; }
  void read(std::span<texture::LobeTexel> out) override {
    std::copy_n(strip_.begin(), static_cast<std::ptrdiff_t>(out.size()), out.begin());
  }

 private:
  std::vector<texture::LobeTexel> strip_;
};

class Nowhere : public texture::LobeSink {
 public:
  void write(int level, std::span<const texture::LobeRow> rows) override {
    benchmark::DoNotOptimize(level);
    benchmark::DoNotOptimize(rows.data());
  }
};

void filter(benchmark::State& state, texture::MipKernel kernel) {
  for (auto _ : state) {
    Memory source;
    Nowhere sink;
    texture::ChainOptions options;
    options.kernel = kernel;
    texture::filter_lobe_chain(source, sink, options);
  }
  report(state);
}

#define SATEEN_CHAIN(name, ...)               \
  BENCHMARK_CAPTURE(chain, name, __VA_ARGS__) \
      ->Unit(benchmark::kMillisecond)         \
      ->UseRealTime()                         \
      ->MeasureProcessCPUTime()               \
      ->Iterations(1)

BENCHMARK(io)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime()->Iterations(1);
BENCHMARK_CAPTURE(filter, box, texture::MipKernel::box)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Iterations(1);
BENCHMARK_CAPTURE(filter, kaiser, texture::MipKernel::kaiser)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);
SATEEN_CHAIN(png8_box, texture::LobeOutput::Kind::png8, texture::MipKernel::box, texture::Bc7Effort::normal);
SATEEN_CHAIN(png8_kaiser, texture::LobeOutput::Kind::png8, texture::MipKernel::kaiser,
             texture::Bc7Effort::normal);
SATEEN_CHAIN(ktx2_plain, texture::LobeOutput::Kind::ktx2, texture::MipKernel::box,
             texture::Bc7Effort::normal);
SATEEN_CHAIN(ktx2_bc7_fast, texture::LobeOutput::Kind::ktx2_blocks, texture::MipKernel::box,
             texture::Bc7Effort::fast);
SATEEN_CHAIN(ktx2_bc7_normal, texture::LobeOutput::Kind::ktx2_blocks, texture::MipKernel::box,
             texture::Bc7Effort::normal);

}  // namespace
