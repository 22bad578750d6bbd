// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "sateen/core/image.h"
#include "sateen/core/vector.h"

namespace sateen::matcap {

/// Where the sphere of a MatCap lies in its picture: continuous pixel coordinates (pixel centres at +0.5, y
/// down from the top row) and radius in pixels.
struct Disc {
  double x = 0;
  double y = 0;
  double radius = 0;
};

/// The largest disc in the middle of a picture: where the sphere is when nothing says otherwise.
Disc inscribed_disc(int width, int height);

/// Finds the sphere in a picture: by alpha if it varies, else as the round thing on a background of one
/// colour. The inscribed disc of a square picture stands in when there is no such background (many MatCaps
/// fill it) or the sphere is within 2 % of it. Throws Error naming `name` when a picture that is not square
/// shows no sphere, or when the picture is too small to hold one.
Disc find_disc(const Image& image, const std::string& name);

/// Throws Error naming `name` when the disc is not whole inside the picture (half a pixel is forgiven) or its
/// radius is below 2 pixels.
void check_disc(const Disc& disc, int width, int height, const std::string& name);

/// Disc point, (x, y) of the unit normal with y up, at continuous pixel coordinates; and back.
inline Vec2 disc_point(const Disc& disc, double x, double y) {
  return {(x - disc.x) / disc.radius, (disc.y - y) / disc.radius};
}
inline Vec2 disc_pixel(const Disc& disc, const Vec2& point) {
  return {disc.x + disc.radius * point.x(), disc.y - disc.radius * point.y()};
}

/// Whether the centre of pixel (x, y) lies on the sphere.
inline bool on_disc(const Disc& disc, int x, int y) {
  return disc_point(disc, x + 0.5, y + 0.5).squaredNorm() < 1;
}

}  // namespace sateen::matcap
