// SPDX-License-Identifier: MIT
#include "sateen/core/view_transform.h"

#include <algorithm>
#include <cmath>

namespace sateen {
namespace {

Vec3 clamped(const Vec3& light) {
  return light.cwiseMax(0.0).cwiseMin(1.0);
}

// The numbers of the specification.
constexpr double kFresnel = 0.04;  // what a dielectric reflects of the surroundings, taken off again
constexpr double kCompressed = 0.8 - kFresnel;
constexpr double kDesaturation = 0.15;

Vec3 neutral(const Vec3& light) {
  const double least = light.minCoeff();
  const double toe = least < 2 * kFresnel ? least - least * least / (4 * kFresnel) : kFresnel;
  const Vec3 colour = light - Vec3::Constant(toe);
  const double peak = colour.maxCoeff();
  if (peak < kCompressed) return colour;
  const double room = 1 - kCompressed;
  const double lower = 1 - room * room / (peak + room - kCompressed);
  const double kept = 1 / (kDesaturation * (peak - lower) + 1);
  return colour * (lower / peak) * kept + Vec3::Constant(lower * (1 - kept));
}

Mat3 rows(const Vec3& r, const Vec3& g, const Vec3& b) {
  Mat3 matrix;
  matrix << r.transpose(), g.transpose(), b.transpose();
  return matrix;
}

// ITU-R BT.2087: linear Rec. 709 to Rec. 2020; the way back is its inverse.
const Mat3 kWide = rows({0.627403896, 0.329283039, 0.043313066}, {0.069097289, 0.919540395, 0.011362316},
                        {0.016391439, 0.088013308, 0.895595253});
const Mat3 kNarrow = kWide.inverse();
// AgX for those primaries: Filament's inset, and an outset that is not quite its inverse.
const Mat3 kInset = rows({0.856627153315983, 0.0951212405381588, 0.0482516061458583},
                         {0.137318972929847, 0.761241990602591, 0.101439036467562},
                         {0.11189821299995, 0.0767994186031903, 0.811302368396859});
const Mat3 kOutset = rows({1.1271005818144368, -0.11060664309660323, -0.016493938717834573},
                          {-0.1413297634984383, 1.157823702216272, -0.016493938717834257},
                          {-0.14132976349843826, -0.11060664309660294, 1.2519364065950405});
// log2(0.18) - 10 and + 6.5: the stops about middle grey that the curve spans.
constexpr double kDarkestStop = -12.47393;
constexpr double kBrightestStop = 4.026069;
constexpr double kAgxPower = 2.2;  // from the curve's values to linear light

double agx_curve(double light) {
  const double stops = std::log2(std::max(light, 1e-10));
  const double x = std::clamp((stops - kDarkestStop) / (kBrightestStop - kDarkestStop), 0.0, 1.0);
  return -0.00232 + x * (0.1191 + x * (0.4298 + x * (-6.868 + x * (31.96 + x * (-40.14 + x * 15.5)))));
}

Vec3 agx(const Vec3& light) {
  const Vec3 inset = kInset * (kWide * light);
  const Vec3 outset = kOutset * inset.unaryExpr([](double v) { return agx_curve(v); });
  return clamped(kNarrow * outset.unaryExpr([](double v) { return std::pow(std::max(v, 0.0), kAgxPower); }));
}

}  // namespace

Vec3 shown_light(ViewTransform view, const Vec3& light) {
  const Vec3 possible = light.cwiseMax(0.0).cwiseMin(kBrightestShown);
  switch (view) {
    case ViewTransform::neutral:
      return neutral(possible);
    case ViewTransform::agx:
      return agx(possible);
    case ViewTransform::none:
    case ViewTransform::srgb:
      break;
  }
  return clamped(possible);
}

}  // namespace sateen
