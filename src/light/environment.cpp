// SPDX-License-Identifier: MIT
#include "sateen/light/environment.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/io/image.h"

namespace sateen::light {

Vec3 environment_direction(const Vec2& uv) {
  const double azimuth = 2 * kPi * (uv.x() - 0.5);
  const double elevation = kPi * (0.5 - uv.y());
  return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
          -std::cos(azimuth) * std::cos(elevation)};
}

Vec2 environment_uv(const Vec3& direction) {
  const double u = std::atan2(direction.x(), -direction.z()) / (2 * kPi) + 0.5;
  return {u, 0.5 - std::asin(std::clamp(direction.y(), -1.0, 1.0)) / kPi};
}

Vec3 environment_radiance(const Image& environment, const Vec3& direction) {
  const Vec2 uv = environment_uv(direction);
  const double x = wrap(uv.x()) * environment.width - 0.5;
  const double y = std::clamp(uv.y() * environment.height - 0.5, 0.0, environment.height - 1.0);
  const int x0 = static_cast<int>(std::floor(x));
  const int y0 = static_cast<int>(y);
  const double fx = x - x0;
  const double fy = y - y0;
  const auto texel = [&](int i, int j) -> Vec3 {
    const int column = (i + environment.width) % environment.width;
    return environment.rgb(column, std::min(j, environment.height - 1)).cast<double>();
  };
  return (1 - fy) * ((1 - fx) * texel(x0, y0) + fx * texel(x0 + 1, y0)) +
         fy * ((1 - fx) * texel(x0, y0 + 1) + fx * texel(x0 + 1, y0 + 1));
}

Image read_environment(const std::filesystem::path& path) {
  Image image = with_channels(io::read_image(path), 3);
  if (std::abs(image.width - 2 * image.height) > 1) {
    throw Error(fmt::format(
        "{}: an environment map is a latitude-longitude picture, twice as wide as high; this one is "
        "{} x {}",
        path.string(), image.width, image.height));
  }
  for (float& value : image.data) value = std::max(value, 0.0F);
  return image;
}

}  // namespace sateen::light
