// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "sateen/core/image.h"
#include "sateen/matcap/sphere_disc.h"

namespace sateen::matcap {

/// A MatCap component along the great circle through the view axis and a point of the sphere, the dimension
/// in which its filter is measured (Zubiaga et al. 2015, section 3.3). Sample i is at angle theta = -pi/2 + i
/// * step from the view axis, positive on the point's side; both ends are at the rim.
struct MeridianProfile {
  double step = 0;             ///< radians
  std::vector<double> values;  ///< intensity
  double angle(std::size_t i) const { return -1.5707963267948966 + static_cast<double>(i) * step; }
};

/// The meridian of `component` (1 channel) at azimuth `azimuth` (radians from x to y), two samples a pixel at
/// the middle of the sphere.
MeridianProfile meridian_profile(const Image& component, const Disc& disc, double azimuth);

/// The profile's derivative by theta, a central difference.
MeridianProfile derivative(const MeridianProfile& profile);

/// Mean and variance of a normal distribution that has been cut to an interval.
struct Moments {
  double mean = 0;
  double variance = 0;
};

/// Moments of the normal distribution `normal` cut to [a, b].
Moments truncated_moments(const Moments& normal, double a, double b);

/// The normal distribution that has `moments` when cut to [a, b]; nothing if no normal distribution has
/// (variances at or above the uniform distribution's, (b - a)^2 / 12).
std::optional<Moments> untruncated(const Moments& moments, double a, double b);

/// The variance of the feature around theta seen through the window W of half width eps, a Gaussian of
/// standard deviation eps / 3 cut at eps and at the rim. Equation (6) with its denominator's sign put right,
///   Var[R] = Var[W] Var[R W] / (Var[W] - Var[R W]),
/// and with the variances of the cut Gaussians replaced by those of the whole ones (untruncated), which (6)
/// ignores. Negative values count as 0. Nothing where the computation degenerates: no energy in the window,
/// or a profile that is not like a Gaussian there (the paper's case d).
std::optional<double> windowed_variance(const MeridianProfile& profile, double theta, double eps);

/// Variance as a function of the window: the signature of Figure 4.
struct Signature {
  std::vector<double> eps;            ///< radians, increasing by a constant factor
  std::vector<double> variance;       ///< radians^2; NaN where degenerate
  std::optional<std::size_t> chosen;  ///< the window that captures the feature best; nothing: discarded
  enum class Case {
    minimum,
    inflection,
    widest,
    degenerate
  } found = Case::degenerate;  ///< (a) to (d) of Figure 4
};

/// The signature at theta for windows from `smallest` to pi/2, and the window chosen as Figure 4 says: the
/// first minimum after the second inflection, else the second inflection, else the widest.
Signature signature(const MeridianProfile& profile, double theta, double smallest);

}  // namespace sateen::matcap
