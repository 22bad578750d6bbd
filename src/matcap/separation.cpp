// SPDX-License-Identifier: MIT
#include "sateen/matcap/separation.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sateen/core/colour.h"
#include "sateen/core/error.h"
#include "sateen/core/parallel.h"
#include "sateen/matcap/support_function.h"

namespace sateen::matcap {
namespace {

// Values at or below this count as black: their reciprocal must stay finite, and so must sums of it.
constexpr float kBlack = 1e-20F;

std::vector<float> opening(const SphereTiles& tiles, const std::vector<float>& values,
                           const std::vector<char>& ignored) {
  const std::size_t lanes = tiles.pixel.size();
  LaneValues scale(lanes, 0);
  for (std::size_t i = 0; i < lanes; ++i) {
    if (tiles.pixel[i] < 0) continue;
    const auto pixel = static_cast<std::size_t>(tiles.pixel[i]);
    if (!ignored.empty() && ignored[pixel] != 0) continue;
    scale[i] = 1 / std::max(values[pixel], kBlack);
  }
  const LaneValues reciprocal = support_of_scaled_normals(tiles, scale);
  // Where no pixel counts for any direction there is nothing to erode with: eroded values of 0, so low is 0.
  for (std::size_t i = 0; i < lanes; ++i) {
    scale[i] = tiles.pixel[i] >= 0 && reciprocal[i] > 0 ? 1 / reciprocal[i] : 0;
  }
  const LaneValues dilated = support_of_scaled_normals(tiles, scale);
  std::vector<float> result(values.size(), 0);
  for (std::size_t i = 0; i < lanes; ++i) {
    if (tiles.pixel[i] < 0) continue;
    const auto pixel = static_cast<std::size_t>(tiles.pixel[i]);
    result[pixel] = std::clamp(dilated[i], 0.0F, std::max(values[pixel], 0.0F));
  }
  return result;
}

std::vector<float> channel_of(const Image& image, int c) {
  std::vector<float> values(image.data.size() / static_cast<std::size_t>(image.channels));
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = image.data[i * static_cast<std::size_t>(image.channels) + static_cast<std::size_t>(c)];
  }
  return values;
}

}  // namespace

std::vector<float> cosine_opening(const std::vector<float>& values, const std::vector<char>& ignored,
                                  int width, int height, const Disc& disc) {
  return opening(tile_sphere(width, height, disc), values, ignored);
}

std::vector<char> find_outliers(const std::vector<float>& values, int width, int height, const Disc& disc) {
  std::vector<char> outliers(values.size(), 0);
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  };
  const Disc inner{disc.x, disc.y, disc.radius - 1};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!on_disc(disc, x, y)) continue;
      if (!on_disc(inner, x, y)) {
        outliers[index(x, y)] = 1;
        continue;
      }
      if (values[index(x, y)] > 0) continue;
      int black = 0;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int nx = x + dx;
          const int ny = y + dy;
          const bool inside = nx >= 0 && ny >= 0 && nx < width && ny < height && on_disc(disc, nx, ny);
          if (inside && values[index(nx, ny)] <= 0) ++black;
        }
      }
      if (black <= 2) outliers[index(x, y)] = 1;
    }
  }
  return outliers;
}

Separation separate(const Image& picture, const Disc& disc, Outliers outliers, const std::string& name) {
  const Image image = with_channels(picture, 3);
  for (std::size_t i = 0; i < image.data.size(); ++i) {
    if (std::isfinite(image.data[i])) continue;
    const std::size_t pixel = i / 3;
    throw Error(fmt::format("{}: has a value that is not finite at pixel ({}, {})", name,
                            pixel % static_cast<std::size_t>(image.width),
                            pixel / static_cast<std::size_t>(image.width)));
  }
  const SphereTiles tiles = tile_sphere(image.width, image.height, disc);
  Separation result{Image(image.width, image.height, 3), Image(image.width, image.height, 3)};
  parallel_for(3, [&](int c) {
    const std::vector<float> values = channel_of(image, c);
    const std::vector<char> ignored = outliers == Outliers::ignore
                                          ? find_outliers(values, image.width, image.height, disc)
                                          : std::vector<char>{};
    const std::vector<float> low = opening(tiles, values, ignored);
    for (const int pixel : tiles.pixel) {
      if (pixel < 0) continue;
      const auto i = static_cast<std::size_t>(pixel);
      const std::size_t at = 3 * i + static_cast<std::size_t>(c);
      result.low.data[at] = low[i];
      result.high.data[at] = values[i] - low[i];
    }
  });
  return result;
}

Image to_add_up_space(const Image& linear, AddUpSpace space) {
  Image values = with_channels(linear, 3);
  return space == AddUpSpace::display ? srgb_encoded(std::move(values)) : values;
}

Image from_add_up_space(const Image& values, AddUpSpace space) {
  return space == AddUpSpace::display ? srgb_decoded(values) : values;
}

}  // namespace sateen::matcap
