// SPDX-License-Identifier: MIT
#include "sateen/core/display.h"

#include <cmath>

#include "sateen/core/colour.h"

namespace sateen {
namespace {

bool has_alpha(const Image& image) {
  return image.channels == 2 || image.channels == 4;
}

Vec3f shown_pixel(const Vec3f& light, const DisplaySettings& settings, double gain) {
  Vec3f shown = shown_light(settings.view, light.cast<double>() * gain).cast<float>();
  if (settings.view == ViewTransform::none) shown = shown.unaryExpr([](float v) { return srgb_decode(v); });
  return shown;
}

}  // namespace

double display_gain(const DisplaySettings& settings) {
  return std::exp2(settings.exposure);
}

Image displayed(Image light, const DisplaySettings& settings) {
  const double gain = display_gain(settings);
  for (int y = 0; y < light.height; ++y) {
    for (int x = 0; x < light.width; ++x) {
      const float alpha = has_alpha(light) ? light.at(x, y, light.channels - 1) : 1;
      if (alpha <= 0) continue;
      const Vec3f shown = shown_pixel(light.rgb(x, y) / alpha, settings, gain) * alpha;
      for (int c = 0; c < light.channels - (has_alpha(light) ? 1 : 0); ++c) light.at(x, y, c) = shown[c];
    }
  }
  return light;
}

Image over_background(Image associated, const Vec3f& background) {
  if (!has_alpha(associated)) return associated;
  const int colours = associated.channels - 1;
  for (int y = 0; y < associated.height; ++y) {
    for (int x = 0; x < associated.width; ++x) {
      const float through = 1 - associated.at(x, y, colours);
      for (int c = 0; c < colours; ++c) associated.at(x, y, c) += through * background[c];
      associated.at(x, y, colours) = 1;
    }
  }
  return associated;
}

}  // namespace sateen
