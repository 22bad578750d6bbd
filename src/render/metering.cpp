// SPDX-License-Identifier: MIT
#include "sateen/render/metering.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/exposure.h"

namespace sateen::render {

double metered_exposure(const Renderer& renderer, const scene::View& view, const PictureSettings& settings) {
  constexpr double kLongestSide = 256;
  const double scale = std::min(1.0, kLongestSide / std::max(settings.width, settings.height));
  const auto scaled = [scale](int side) { return std::max(1, static_cast<int>(std::lround(scale * side))); };
  const PictureSettings small{.width = scaled(settings.width),
                              .height = scaled(settings.height),
                              .samples = 1,
                              .tile = settings.tile};
  return automatic_exposure(renderer.render(view, small).colour);
}

}  // namespace sateen::render
