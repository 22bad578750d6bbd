// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "sateen/io/file_error.h"
#include "sateen/io/picture_codecs.h"

namespace sateen::io {
namespace {

using Rgbe = std::array<unsigned char, 4>;

Rgbe rgbe(const float* rgb) {
  const float largest = std::max({rgb[0], rgb[1], rgb[2]});
  if (!(largest >= 1e-32f)) return {};
  int exponent = 0;
  const float scale = std::frexp(largest, &exponent) * 256 / largest;
  Rgbe pixel{};
  for (std::size_t c = 0; c < 3; ++c) pixel[c] = static_cast<unsigned char>(std::max(rgb[c], 0.0f) * scale);
  pixel[3] = static_cast<unsigned char>(std::min(exponent + 128, 255));
  return pixel;
}

/// One channel of a row as runs: 128 + n repeats the byte behind n times, n up to 128 takes n bytes.
void append_runs(const std::vector<Rgbe>& row, std::size_t c, std::vector<unsigned char>& out) {
  constexpr std::size_t kShortestRun = 4;
  const auto run_at = [&](std::size_t x) {
    std::size_t end = x + 1;
    while (end < row.size() && end < x + 127 && row[end][c] == row[x][c]) ++end;
    return end - x;
  };
  for (std::size_t x = 0; x < row.size();) {
    std::size_t literal = x;
    std::size_t run = 0;
    while (literal < row.size() && literal < x + 128 && (run = run_at(literal)) < kShortestRun) ++literal;
    if (literal > x) {
      out.push_back(static_cast<unsigned char>(literal - x));
      for (; x < literal; ++x) out.push_back(row[x][c]);
    } else {
      out.push_back(static_cast<unsigned char>(128 + run));
      out.push_back(row[x][c]);
      x += run;
    }
  }
}

class HdrSink final : public PictureSink {
 public:
  HdrSink(std::FILE* stream, const std::string& name, const PictureLayout& layout)
      : stream_(stream), name_(name), row_(static_cast<std::size_t>(layout.width)) {
    if (layout.channel_count() != 3) fail(name, "a Radiance picture has three channels");
    const std::string header = fmt::format(
        "#?RADIANCE\nSOFTWARE=Sateen\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", layout.height, layout.width);
    bytes_.assign(header.begin(), header.end());
    put();
  }

  void write(int rows, const float* samples) override {
    for (int y = 0; y < rows; ++y) {
      for (Rgbe& pixel : row_) {
        pixel = rgbe(samples);
        samples += 3;
      }
      bytes_.clear();
      if (row_.size() >= 8 && row_.size() <= 0x7fff) {
        bytes_ = {2, 2, static_cast<unsigned char>(row_.size() >> 8),
                  static_cast<unsigned char>(row_.size() & 0xff)};
        for (std::size_t c = 0; c < 4; ++c) append_runs(row_, c, bytes_);
      } else {
        for (const Rgbe& pixel : row_) bytes_.insert(bytes_.end(), pixel.begin(), pixel.end());
      }
      put();
    }
  }

  void finish() override {}

 private:
  void put() {
    if (std::fwrite(bytes_.data(), 1, bytes_.size(), stream_) != bytes_.size())
      fail(name_, fmt::format("cannot be written: {}", std::strerror(errno)));
  }

  std::FILE* stream_;
  std::string name_;
  std::vector<Rgbe> row_;
  std::vector<unsigned char> bytes_;
};

}  // namespace

SinkPtr create_hdr(std::FILE* stream, const std::string& name, const PictureLayout& layout) {
  return std::make_unique<HdrSink>(stream, name, layout);
}

}  // namespace sateen::io
