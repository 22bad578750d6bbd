// SPDX-License-Identifier: MIT
#include "sateen/matcap/kept_pixels.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <iterator>

#include <fmt/format.h>

#include "sateen/core/colour.h"
#include "sateen/core/error.h"
#include "sateen/matcap/rim.h"

namespace sateen::matcap {
namespace {

constexpr float kClose = 0.5F / 255;  // display values
constexpr float kSteepest = 12.92F;   // slope of the encoding
constexpr std::size_t kMostShare = 8;
constexpr float kLargest = 65504;  // of half floats
constexpr std::size_t kIndexDigits = 8;
constexpr std::size_t kChannelDigits = 4;
constexpr std::size_t kPixelDigits = kIndexDigits + 3 * kChannelDigits;

std::uint32_t index_of(const Image& image, int x, int y) {
  return static_cast<std::uint32_t>(image.index(x, y) / static_cast<std::size_t>(image.channels));
}

Vec3f display(const Vec3f& linear) {
  return {srgb_encode(linear.x()), srgb_encode(linear.y()), srgb_encode(linear.z())};
}

std::uint32_t hexadecimal(std::string_view digits) {
  std::uint32_t value = 0;
  const auto end = digits.data() + digits.size();
  const auto [next, error] = std::from_chars(digits.data(), end, value, 16);
  if (error != std::errc() || next != end) throw Error(fmt::format("'{}' is no hexadecimal number", digits));
  return value;
}

}  // namespace

KeptPixels pixels_to_keep(const Image& picture, const Image& baked, const Disc& disc) {
  struct Missed {
    float difference;
    KeptPixel pixel;
  };
  std::vector<Missed> missed;
  std::size_t seen = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (!on_disc(disc, x, y)) continue;
      ++seen;
      const Vec3f colour = picture.rgb(x, y);
      const Vec3f shown = baked.rgb(x, y);
      if (kSteepest * (colour - shown).cwiseAbs().maxCoeff() <= kClose) continue;  // most pixels: no encoding
      const float difference = (display(colour) - display(shown)).cwiseAbs().maxCoeff();
      if (difference > kClose) missed.push_back({difference, {index_of(picture, x, y), colour}});
    }
  }
  if (missed.size() > seen / kMostShare) {
    const auto end = missed.begin() + static_cast<std::ptrdiff_t>(seen / kMostShare);
    std::ranges::nth_element(missed, end, std::greater(), &Missed::difference);
    missed.erase(end, missed.end());
    std::ranges::sort(missed, {}, [](const Missed& m) { return m.pixel.index; });
  }
  KeptPixels kept{picture.width, picture.height, disc, {}};
  for (const Missed& m : missed) kept.pixels.push_back(m.pixel);
  return kept;
}

KeptPixels pixels_of_rim(const Image& picture, const Disc& disc, double width) {
  KeptPixels kept{picture.width, picture.height, disc, {}};
  for (int y = 0; width > 0 && y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (on_rim(disc, width, x, y)) kept.pixels.push_back({index_of(picture, x, y), picture.rgb(x, y)});
    }
  }
  return kept;
}

void put_back(const KeptPixels& kept, Image& picture, const Disc& disc) {
  const bool same_place = disc.x == kept.disc.x && disc.y == kept.disc.y && disc.radius == kept.disc.radius;
  if (picture.width != kept.width || picture.height != kept.height || !same_place) return;
  const auto width = static_cast<std::uint32_t>(picture.width);
  for (const KeptPixel& pixel : kept.pixels) {
    picture.set_rgb(static_cast<int>(pixel.index % width), static_cast<int>(pixel.index / width),
                    pixel.colour);
  }
}

std::string text_of_pixels(const std::vector<KeptPixel>& pixels) {
  std::string text;
  text.reserve(pixels.size() * kPixelDigits);
  for (const KeptPixel& pixel : pixels) {
    fmt::format_to(std::back_inserter(text), "{:08x}", pixel.index);
    for (const float v : pixel.colour.cwiseMin(kLargest))
      fmt::format_to(std::back_inserter(text), "{:04x}", Half(v).x);
  }
  return text;
}

std::vector<KeptPixel> pixels_of_text(std::string_view text, std::size_t count) {
  if (text.size() % kPixelDigits != 0) {
    throw Error(fmt::format("{} digits are no whole number of pixels of {}", text.size(), kPixelDigits));
  }
  std::vector<KeptPixel> pixels;
  for (; !text.empty(); text.remove_prefix(kPixelDigits)) {
    KeptPixel pixel{hexadecimal(text.substr(0, kIndexDigits)), {}};
    if (pixel.index >= count) throw Error(fmt::format("pixel {} is outside the picture", pixel.index));
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t bits = hexadecimal(text.substr(kIndexDigits + c * kChannelDigits, kChannelDigits));
      const auto value =
          static_cast<float>(Half(Eigen::half_impl::raw_uint16_to_half(static_cast<std::uint16_t>(bits))));
      if (!std::isfinite(value)) throw Error(fmt::format("pixel {} is not finite", pixel.index));
      pixel.colour[static_cast<Eigen::Index>(c)] = value;
    }
    pixels.push_back(pixel);
  }
  return pixels;
}

}  // namespace sateen::matcap
