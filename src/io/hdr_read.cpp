// SPDX-License-Identifier: MIT
// Radiance pictures, as Ward's "Real Pixels" (Graphics Gems II) and the Radiance manual describe them.
#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "sateen/io/file_error.h"
#include "sateen/io/picture_codecs.h"
#include "sateen/io/picture_source.h"

namespace sateen::io {
namespace {

using Rgbe = std::array<unsigned char, 4>;

constexpr std::size_t kMaxHeader = std::size_t{1} << 16;
constexpr Chromaticities kXyz{{1, 0, 0, 1, 0, 0, 1 / 3.0, 1 / 3.0}};

/// Numbers behind the equals sign of a header line; none if they are not all there.
template <std::size_t N>
std::optional<std::array<double, N>> numbers(const std::string& text) {
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  std::array<double, N> values{};
  for (double& value : values) {
    if (!(in >> value) || !std::isfinite(value)) return std::nullopt;
  }
  return values;
}

class HdrSource final : public PictureSource {
 public:
  explicit HdrSource(PictureBytes bytes) : bytes_(std::move(bytes)) {
    header_.channels = 3;
    header_.samples = SampleType::f32;
    header_.floating = true;
    header_.bits = 32;
    read_line();  // "#?RADIANCE" or "#?RGBE"
    for (std::string line = read_line(); !line.empty(); line = read_line()) read_variable(line);
    read_size(read_line());
  }

  void read(int rows, void* out) override {
    auto* light = static_cast<float*>(out);
    row_.resize(static_cast<std::size_t>(header_.width));
    for (int y = 0; y < rows; ++y) {
      read_row();
      for (const Rgbe& p : row_) {
        const float unit = p[3] == 0 ? 0.0f : static_cast<float>(std::ldexp(1.0, p[3] - (128 + 8)));
        for (std::size_t c = 0; c < 3; ++c) *light++ = static_cast<float>(p[c]) * unit;
      }
    }
  }

 private:
  [[noreturn]] void fail_header(const std::string& what) const {
    fail(bytes_.name, "cannot be read as a picture: " + what);
  }

  std::string read_line() {
    std::string line;
    for (int c = std::getc(bytes_.stream.get()); c != '\n'; c = std::getc(bytes_.stream.get())) {
      if (c == EOF || ++header_bytes_ > kMaxHeader) fail_header("its header does not end");
      line += static_cast<char>(c);
    }
    if (line.ends_with('\r')) line.pop_back();
    return line;
  }

  void read_variable(const std::string& line) {
    const std::size_t equals = line.find('=');
    if (line.starts_with('#') || equals == std::string::npos) return;  // a remark, or a program that was run
    const std::string name = line.substr(0, equals);
    const std::string value = line.substr(equals + 1);
    StoredColour& colour = header_.colour;
    if (name == "FORMAT") {
      const bool xyz = value.find("xyze") != std::string::npos;
      if (!xyz && value.find("rgbe") == std::string::npos) fail_header("its FORMAT is " + value);
      if (xyz) colour.chromaticities = kXyz;
    } else if (name == "EXPOSURE") {
      if (const auto exposure = numbers<1>(value))
        divide_scale({(*exposure)[0], (*exposure)[0], (*exposure)[0]});
    } else if (name == "COLORCORR") {
      if (const auto factors = numbers<3>(value)) divide_scale(*factors);
    } else if (name == "PRIMARIES") {
      if (const auto xy = numbers<8>(value)) colour.chromaticities = Chromaticities{*xy};
    } else if (name == "PIXASPECT") {
      if (const auto aspect = numbers<1>(value); aspect && (*aspect)[0] != 1)
        colour.ignored.push_back("PIXASPECT, pixels that are not square");
    }
  }

  /// Several lines work together: each tells of one more program that multiplied the values.
  void divide_scale(const std::array<double, 3>& factors) {
    std::array<double, 3> scale = header_.colour.scale.value_or(std::array<double, 3>{1, 1, 1});
    for (std::size_t c = 0; c < 3; ++c) {
      if (!(factors[c] > 0)) fail_header("its EXPOSURE or COLORCORR is not positive");
      scale[c] /= factors[c];
    }
    header_.colour.scale = scale;
  }

  /// "-Y 23 +X 37": 23 rows from top to bottom, each from left to right; X and Y may change places and signs.
  void read_size(const std::string& line) {
    char axis[2][3] = {};
    int count[2] = {};
    if (std::sscanf(line.c_str(), "%2s %9d %2s %9d", axis[0], &count[0], axis[1], &count[1]) != 4)
      fail_header("its size is missing");
    header_.height = count[0];
    header_.width = count[1];
    constexpr std::string_view kOrders[] = {"-Y+X", "-Y-X", "+Y-X", "+Y+X", "+X-Y", "-X-Y", "-X+Y", "+X+Y"};
    const auto* order = std::ranges::find(kOrders, fmt::format("{}{}", axis[0], axis[1]));
    if (order == std::end(kOrders))
      fail_header(fmt::format("its size is \"{}\", \"-Y 100 +X 200\" would be right", line));
    header_.orientation = static_cast<int>(order - std::begin(kOrders)) + 1;
  }

  void get(unsigned char* to, std::size_t count) {
    if (std::fread(to, 1, count, bytes_.stream.get()) != count)
      fail(bytes_.name, "is truncated or corrupt: it ends within its pixels");
  }

  void read_row() {
    Rgbe first{};
    get(first.data(), first.size());
    const bool by_channel = header_.width >= 8 && header_.width <= 0x7fff && first[0] == 2 && first[1] == 2 &&
                            (first[2] & 0x80) == 0;
    if (!by_channel) {
      read_pixels(first);
      return;
    }
    if ((first[2] << 8 | first[3]) != header_.width) fail_runs();
    for (std::size_t c = 0; c < 4; ++c) read_channel(c);
  }

  /// Runs of one channel: a length above 128 repeats the value behind it, another takes that many.
  void read_channel(std::size_t c) {
    for (std::size_t x = 0; x < row_.size();) {
      unsigned char code[2];
      get(code, 1);
      const bool run = code[0] > 128;
      const std::size_t count = run ? code[0] - 128u : code[0];
      if (count == 0 || count > row_.size() - x) fail_runs();
      if (run) get(code + 1, 1);
      for (std::size_t i = 0; i < count; ++i, ++x) {
        if (!run) get(code + 1, 1);
        row_[x][c] = code[1];
      }
    }
  }

  /// Pixels one after the other; the first is read already. In old files 1, 1, 1, n repeats the pixel before
  /// n times, and directly behind another such one 256 n times, and so on.
  void read_pixels(Rgbe pixel) {
    int shift = 0;
    for (std::size_t x = 0; x < row_.size();) {
      if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
        const std::size_t count = std::size_t{pixel[3]} << shift;
        if (x == 0 || count > row_.size() - x) fail_runs();
        std::fill_n(row_.begin() + static_cast<std::ptrdiff_t>(x), count, row_[x - 1]);
        x += count;
        shift = std::min(shift + 8, 24);
      } else {
        row_[x++] = pixel;
        shift = 0;
      }
      if (x < row_.size()) get(pixel.data(), pixel.size());
    }
  }

  [[noreturn]] void fail_runs() const {
    fail(bytes_.name, "is truncated or corrupt: a run of pixels leaves its row");
  }

  PictureBytes bytes_;
  std::size_t header_bytes_ = 0;
  std::vector<Rgbe> row_;
};

}  // namespace

SourcePtr open_hdr(PictureBytes bytes) {
  return std::make_unique<HdrSource>(std::move(bytes));
}

}  // namespace sateen::io
