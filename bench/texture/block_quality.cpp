// SPDX-License-Identifier: MIT
// Quality and time of the block encoders: block_quality PICTURE...
// Every picture is compressed with each encoder, decoded by OpenImageIO and compared: peak signal-to-noise
// ratio over the channels the format holds, and million texels a second over all threads.
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "sateen/core/error.h"
#include "sateen/io/image.h"
#include "sateen/texture/block_compression.h"
#include "texture/dds.h"

namespace {

using namespace sateen;

struct Encoder {
  const char* name;
  texture::BlockFormat format;
  texture::Bc7Effort effort;
  std::size_t channels;
};

constexpr Encoder kEncoders[] = {{"bc1", texture::BlockFormat::bc1, {}, 3},
                                 {"bc5", texture::BlockFormat::bc5, {}, 2},
                                 {"bc7 fast", texture::BlockFormat::bc7, texture::Bc7Effort::fast, 3},
                                 {"bc7 normal", texture::BlockFormat::bc7, texture::Bc7Effort::normal, 3},
                                 {"bc7 best", texture::BlockFormat::bc7, texture::Bc7Effort::best, 3}};

void measure(const std::filesystem::path& path) {
  const Image image = io::read_data(path);
  std::vector<std::uint8_t> rgba(static_cast<std::size_t>(image.width) *
                                 static_cast<std::size_t>(image.height) * 4);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Vec3f v = image.rgb(x, y);
      const std::size_t at = (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                              static_cast<std::size_t>(x)) *
                             4;
      for (std::size_t c = 0; c < 3; ++c) {
        rgba[at + c] = static_cast<std::uint8_t>(
            std::lround(std::clamp(v[static_cast<Eigen::Index>(c)], 0.0f, 1.0f) * 255));
      }
      rgba[at + 3] = 255;
    }
  }
  fmt::print("{:34}", path.filename().string().substr(0, 34));
  const auto dds = std::filesystem::temp_directory_path() / "sateen_block_quality.dds";
  for (const Encoder& encoder : kEncoders) {
    texture::Bc7Options options;
    options.effort = encoder.effort;
    const std::clock_t start = std::clock();
    const auto blocks = texture::compress_blocks(encoder.format, rgba, image.width, image.height, options);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const auto decoded = test::decode_blocks(encoder.format, blocks, image.width, image.height, dds);
    double sum = 0;
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
      for (std::size_t c = 0; c < encoder.channels; ++c)
        sum += std::pow(double(rgba[i + c]) - double(decoded[i + c]), 2);
    }
    const double mse = sum / (static_cast<double>(rgba.size() / 4) * static_cast<double>(encoder.channels));
    fmt::print("  {} {:5.2f} dB {:5.1f} MT/s", encoder.name, 10 * std::log10(255 * 255 / std::max(mse, 1e-9)),
               static_cast<double>(rgba.size() / 4) / seconds / 1e6);
  }
  fmt::print("\n");
  std::fflush(stdout);
  std::filesystem::remove(dds);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    for (int i = 1; i < argc; ++i) measure(argv[i]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "block_quality: {}\n", error.what());
    return 1;
  }
}
