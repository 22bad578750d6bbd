// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/image.h"
#include "sateen/core/vector.h"
#include "sateen/matcap/sphere_map.h"

namespace sateen::matcap {

/// Where on the sphere of directions a light is drawn, and how it is turned: flat coordinates around
/// `centre`, in which distances from the centre are angles (azimuthal equidistant). `up` is a direction that
/// points upwards in the light's own picture.
struct LightPlace {
  Vec3 centre{0, 0, 1};  ///< unit
  Vec3 up{0, 1, 0};
};

/// Flat coordinates (right, up) in radians of unit direction `w`.
Vec2 flat_coordinates(const LightPlace& place, const Vec3& w);

/// A brush whose blur by a material filter has a closed form (Zubiaga et al. 2015, section 5.1): convolving
/// with a Gaussian adds variances.
struct Footprint {
  enum class Shape {
    gaussian,  ///< exp(-d^2 / 2 size.x^2)
    box,       ///< 1 within size (half width, half height), Erf edges of standard deviation `softness`
  };
  Shape shape = Shape::gaussian;
  Vec2 size{0.1, 0.1};  ///< radians
  double softness = 0;  ///< radians
};

/// The footprint at flat coordinates `p`, blurred by `variance` (radians^2).
double value_of(const Footprint& footprint, const Vec2& p, double variance);

/// Adds `color` times the blurred footprint to every texel.
void paint(SphereMap& map, const LightPlace& place, const Footprint& footprint, const Vec3& color,
           double variance);

/// A picture as a light: 3 channels, `width` radians across, blurred by `variance`.
class BitmapLight {
 public:
  BitmapLight(const Image& picture, double width, double variance);

  /// The colour at flat coordinates `p`; black outside the blurred picture.
  Vec3 operator()(const Vec2& p) const;

 private:
  Image blurred_;     // with a margin for the blur
  double pixel_ = 0;  // radians
};

/// Adds `color` times the bitmap to every texel.
void paint(SphereMap& map, const LightPlace& place, const BitmapLight& light, const Vec3& color);

}  // namespace sateen::matcap
