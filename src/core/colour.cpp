// SPDX-License-Identifier: MIT
#include "sateen/core/colour.h"

#include <algorithm>
#include <cmath>

namespace sateen {
namespace {

template <class Function>
Image with_colour_channels(Image image, Function function) {
  const std::size_t channels = static_cast<std::size_t>(image.channels);
  const bool alpha = channels == 2 || channels == 4;
  for (std::size_t i = 0; i < image.data.size(); ++i) {
    if (!alpha || i % channels != channels - 1) image.data[i] = function(image.data[i]);
  }
  return image;
}

}  // namespace

float srgb_encode(float linear) {
  const float magnitude = std::abs(linear);
  const float encoded =
      magnitude <= 0.0031308f ? 12.92f * magnitude : 1.055f * std::pow(magnitude, 1 / 2.4f) - 0.055f;
  return std::copysign(encoded, linear);
}

float srgb_decode(float encoded) {
  const float magnitude = std::abs(encoded);
  const float linear =
      magnitude <= 0.04045f ? magnitude / 12.92f : std::pow((magnitude + 0.055f) / 1.055f, 2.4f);
  return std::copysign(linear, encoded);
}

Image srgb_encoded(Image linear) {
  return with_colour_channels(std::move(linear), srgb_encode);
}
Image srgb_decoded(Image encoded) {
  return with_colour_channels(std::move(encoded), srgb_decode);
}

double luminance(const Vec3& rgb) {
  return rgb.dot(Vec3(0.2126, 0.7152, 0.0722));
}

Vec3 rgb_to_hsv(const Vec3& rgb) {
  const double value = rgb.maxCoeff();
  const double chroma = value - rgb.minCoeff();
  if (chroma <= 0) return {0, 0, value};
  double sector = 0;
  if (value == rgb[0]) {
    sector = (rgb[1] - rgb[2]) / chroma;
  } else if (value == rgb[1]) {
    sector = 2 + (rgb[2] - rgb[0]) / chroma;
  } else {
    sector = 4 + (rgb[0] - rgb[1]) / chroma;
  }
  const double hue = sector / 6;
  return {hue - std::floor(hue), chroma / value, value};
}

Vec3 hsv_to_rgb(const Vec3& hsv) {
  const auto channel = [&](double offset) {
    const double sector = std::fmod(offset + 6 * (hsv[0] - std::floor(hsv[0])), 6.0);
    return hsv[2] - hsv[2] * hsv[1] * std::max(0.0, std::min({sector, 4 - sector, 1.0}));
  };
  return {channel(5), channel(3), channel(1)};
}

}  // namespace sateen
