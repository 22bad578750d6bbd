// SPDX-License-Identifier: MIT
#include "sateen/matcap/filter_estimate.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "sateen/core/colour.h"
#include "sateen/core/error.h"
#include "sateen/core/parallel.h"

namespace sateen::matcap {
namespace {

constexpr double kSmallestWindow = 6;  // pixels at the middle of the sphere
constexpr double kContrast = 0.2;      // of the brightest value: how far a feature must stand out
constexpr double kShapeSlack = 0.1;    // of an edge's step: how far it may be from a blurred edge
constexpr double kPlateauSlack = 0.2;  // of an edge's step: how much the plateaus beside it may change
constexpr int kMeridians = 180;
constexpr double kBeside[] = {-4, -2, 2, 4};  // pixels: meridians that have to confirm a feature
constexpr int kConfirmations = 3;             // of those
constexpr double kMostTurned = 16;            // pixels from the middle
constexpr double kConfirmedContrast = 0.1;    // of the brightest value: how far it stands out there
constexpr double kAgreement = 1.5;            // of variances
constexpr double kNearRim = 1.35;             // radians: beyond, too little of the sphere is seen to measure
constexpr std::size_t kMostPixels = 256;      // of a region that are looked at

/// Something measured at one point of the sphere.
struct Measured {
  double variance = 0;
  Feature feature = Feature::line;
  double theta = 0;
  double azimuth = 0;
  Signature signature;
  double direction = 1;  ///< of an edge: 1 where it rises with theta, else -1
};

Image intensity_of(const Image& component, const Disc& disc) {
  Image result(component.width, component.height, 1);
  for (int y = 0; y < component.height; ++y) {
    for (int x = 0; x < component.width; ++x) {
      if (on_disc(disc, x, y)) result.at(x, y, 0) = std::max(0.0F, component.rgb(x, y).mean());
    }
  }
  return result;
}

double value_at(const MeridianProfile& p, double theta) {
  const double at = std::clamp((theta + kPi / 2) / p.step, 0.0, static_cast<double>(p.values.size() - 1));
  return p.values[static_cast<std::size_t>(at + 0.5)];
}

/// Whether the profile at theta is a step between two plateaus with the shape of a blurred edge of standard
/// deviation `s`, and neither a slope nor the flank of a bump: their derivatives would pass for a sharper
/// material.
bool is_step(const MeridianProfile& profile, double theta, double direction, double s, double brightest) {
  if (std::abs(theta) + 5 * s > kPi / 2) return false;
  const auto at = [&](double t) { return value_at(profile, theta + direction * t * s); };
  const double dark = at(-3);
  const double change = at(3) - dark;
  if (change < kContrast * brightest) return false;
  for (double t = -5; t <= 5; t += 0.5) {
    const double expected = 0.5 * std::erfc(-t / std::sqrt(2.0));
    if (std::abs((at(t) - dark) / change - expected) > (std::abs(t) > 3 ? kPlateauSlack : kShapeSlack))
      return false;
  }
  return true;
}

/// Whether the profile at theta falls on both sides as a bump of standard deviation `s` does. What the rim
/// cuts off cannot speak against it.
bool is_bump(const MeridianProfile& profile, double theta, double s, double brightest) {
  int seen = 0;
  for (const double way : {-1.0, 1.0}) {
    const double t = theta + way * 2.5 * s;
    if (std::abs(t) > kPi / 2) continue;
    ++seen;
    if (value_at(profile, theta) - value_at(profile, t) < kContrast * brightest) return false;
  }
  return seen > 0;
}

std::optional<Measured> measure(const MeridianProfile& profile, double theta, double azimuth,
                                double smallest) {
  Signature s = signature(profile, theta, smallest);
  if (!s.chosen) return std::nullopt;
  return Measured{s.variance[*s.chosen], Feature::line, theta, azimuth, std::move(s), 1};
}

/// Where `profile` is largest within `reach` of theta: the middle of the feature that was measured there.
double peak_near(const MeridianProfile& profile, double theta, double reach) {
  const auto index = [&](double t) {
    const double i = std::round((t + kPi / 2) / profile.step);
    return static_cast<std::ptrdiff_t>(std::clamp(i, 0.0, static_cast<double>(profile.values.size() - 1)));
  };
  const auto from = profile.values.begin() + index(theta - reach);
  const auto best = std::max_element(from, profile.values.begin() + index(theta + reach) + 1);
  return profile.angle(static_cast<std::size_t>(best - profile.values.begin()));
}

std::optional<Measured> measure_line(const MeridianProfile& profile, double theta, double azimuth,
                                     double smallest, double brightest) {
  auto measured = measure(profile, theta, azimuth, smallest);
  if (!measured) return measured;
  const double s = std::sqrt(measured->variance);
  if (!is_bump(profile, peak_near(profile, theta, s), s, brightest)) measured.reset();
  return measured;
}

std::optional<Measured> measure_edge(const MeridianProfile& profile, const MeridianProfile& slope,
                                     double theta, double azimuth, double smallest, double brightest) {
  MeridianProfile rising = slope;
  const double direction = value_at(slope, theta) < 0 ? -1 : 1;
  for (double& v : rising.values) v = std::max(0.0, direction * v);
  auto measured = measure(rising, theta, azimuth, smallest);
  if (!measured) return std::nullopt;
  const double s = std::sqrt(measured->variance);
  if (!is_step(profile, peak_near(rising, theta, s), direction, s, brightest)) return std::nullopt;
  measured->feature = Feature::edge;
  measured->direction = direction;
  return measured;
}

FilterEstimate concluded(const std::optional<Measured>& best, double fallback, const Disc& disc) {
  FilterEstimate result;
  if (!best) {
    result.variance = fallback;
    return result;
  }
  result.measured = true;
  result.variance = std::clamp(best->variance, 1 / (disc.radius * disc.radius), kFlattest);
  result.feature = best->feature;
  result.theta = best->theta;
  result.azimuth = best->azimuth;
  result.signature = best->signature;
  return result;
}

/// A place where a profile steps up or down with the shape of an edge blurred by `width` (standard
/// deviation).
struct Step {
  double theta;
  double width;
};

/// Steps from the narrowest on: where the difference across a width is largest and has that shape. Noise and
/// contours shift the steepest pixel, not this.
std::vector<Step> steps_of(const MeridianProfile& profile, double brightest) {
  std::vector<Step> steps;
  for (double s = 0.7 * 2 * profile.step; s < 0.3; s *= 1.4) {
    const auto difference = [&](double theta) {
      return std::abs(value_at(profile, theta + s) - value_at(profile, theta - s));
    };
    for (double theta = -kNearRim; theta <= kNearRim; theta += std::max(profile.step, 0.2 * s)) {
      const double here = difference(theta);
      if (here < 0.5 * kContrast * brightest) continue;
      const auto less = [&](double t) { return difference(theta + t * s) <= here; };
      if (!less(-0.25) || !less(0.25) || !less(-0.7) || !less(0.7)) continue;
      const double direction = value_at(profile, theta + s) < value_at(profile, theta - s) ? -1 : 1;
      if (is_step(profile, theta, direction, s, brightest)) steps.push_back({theta, s});
    }
  }
  return steps;
}

/// Ridges and edges of one meridian that stand out, measured.
std::vector<Measured> candidates_on(const Image& intensity, const Disc& disc, double azimuth,
                                    double brightest) {
  std::vector<Measured> found;
  const double smallest = kSmallestWindow / disc.radius;
  const MeridianProfile profile = meridian_profile(intensity, disc, azimuth);
  const MeridianProfile slope = derivative(profile);
  // Looked for at a scale of a few pixels: noise has peaks everywhere.
  const auto reach = static_cast<std::size_t>(std::max(2.0, 3 / disc.radius / profile.step));
  const auto peak = [&](const std::vector<double>& v, std::size_t i, double sign) {
    for (std::size_t d = 1; d <= reach; ++d) {
      if (sign * v[i] < sign * v[i - d] || sign * v[i] <= sign * v[i + d]) return false;
    }
    return true;
  };
  const auto stands_out = [&](std::size_t i) {  // from valleys on both sides before anything higher
    for (const int way : {-1, 1}) {
      double valley = profile.values[i];
      for (auto k = static_cast<std::ptrdiff_t>(i); k >= 0 && k < std::ssize(profile.values); k += way) {
        const double v = profile.values[static_cast<std::size_t>(k)];
        if (v > profile.values[i] + 1e-9) break;
        valley = std::min(valley, v);
      }
      if (profile.values[i] - valley < kContrast * brightest) return false;
    }
    return true;
  };
  for (std::size_t i = reach; i + reach < profile.values.size(); ++i) {
    if (std::abs(profile.angle(i)) > kNearRim || !peak(profile.values, i, 1) || !stands_out(i)) continue;
    if (auto m = measure_line(profile, profile.angle(i), azimuth, smallest, brightest))
      found.push_back(std::move(*m));
  }
  std::vector<double> edges;
  for (const Step& step : steps_of(profile, 0.8 * brightest)) {
    const auto same = [&](double theta) { return std::abs(theta - step.theta) < 0.5 * step.width; };
    if (std::ranges::any_of(edges, same)) continue;
    if (auto m = measure_edge(profile, slope, step.theta, azimuth, smallest, brightest)) {
      found.push_back(std::move(*m));
      edges.push_back(step.theta);
    }
  }
  return found;
}

/// Whether the meridians a few pixels to both sides show the same feature as sharp: noise does not go on from
/// pixel to pixel, features do.
bool is_confirmed(const Measured& m, const Image& intensity, const Disc& disc, double brightest) {
  const double s = std::sqrt(m.variance);
  int confirmed = 0;
  for (const double pixels : kBeside) {
    // Through the middle of the sphere go all meridians, and a line looks wider from the side.
    const double turn = pixels / std::max(disc.radius * std::abs(std::sin(m.theta)), kMostTurned);
    const double reach = (std::abs(pixels) + 1) / disc.radius + 0.5 * s;
    const MeridianProfile profile = meridian_profile(intensity, disc, m.azimuth + turn);
    MeridianProfile seen = profile;
    if (m.feature == Feature::edge) {
      seen = derivative(profile);
      for (double& v : seen.values) v = std::max(0.0, m.direction * v);
    }
    const double theta = peak_near(seen, m.theta, reach);
    const auto beside = measure(seen, theta, m.azimuth + turn, kSmallestWindow / disc.radius);
    if (!beside) continue;
    const double ratio = beside->variance / m.variance;
    if (ratio > kAgreement || ratio < 1 / kAgreement) continue;
    const double change = m.direction * (value_at(profile, theta + 3 * s) - value_at(profile, theta - 3 * s));
    if (m.feature == Feature::edge ? change > kConfirmedContrast * brightest
                                   : is_bump(profile, theta, s, kConfirmedContrast / kContrast * brightest))
      ++confirmed;
  }
  return confirmed >= kConfirmations;
}

Region around(const Measured& m, const Disc& disc, const Image& image) {
  const Vec2 p = disc_pixel(disc, std::sin(m.theta) * Vec2(std::cos(m.azimuth), std::sin(m.azimuth)));
  const int half = std::max(1, static_cast<int>(disc.radius / 32));
  const int x0 = std::clamp(static_cast<int>(p.x()) - half, 0, image.width - 1);
  const int y0 = std::clamp(static_cast<int>(p.y()) - half, 0, image.height - 1);
  return {x0, y0, std::min(2 * half + 1, image.width - x0), std::min(2 * half + 1, image.height - y0)};
}

float brightest_of(const Image& intensity) {
  return *std::ranges::max_element(intensity.data);
}

}  // namespace

FilterEstimate estimate_filter(const Image& component, const Disc& disc, const std::vector<Region>& regions,
                               double fallback, const std::string& name) {
  const Image intensity = intensity_of(component, disc);
  const double brightest = brightest_of(intensity);
  const double smallest = kSmallestWindow / disc.radius;
  std::optional<Measured> best;
  for (const Region& region : regions) {
    std::vector<Vec2> points;
    const Region inside = overlap(region, component.width, component.height);
    const double area = static_cast<double>(inside.width) * inside.height;
    const int stride =
        std::max(1, static_cast<int>(std::ceil(std::sqrt(area / static_cast<double>(kMostPixels)))));
    for (int y = inside.y; y < inside.y + inside.height; y += stride) {
      for (int x = inside.x; x < inside.x + inside.width; x += stride) {
        if (on_disc(disc, x, y)) points.push_back(disc_point(disc, x + 0.5, y + 0.5));
      }
    }
    if (points.empty()) {
      throw Error(fmt::format("{}: the region of interest {},{},{},{} has no pixel on the sphere", name,
                              region.x, region.y, region.width, region.height));
    }
    std::vector<std::optional<Measured>> found(points.size());
    parallel_for(static_cast<int>(points.size()), [&](int i) {
      const Vec2& p = points[static_cast<std::size_t>(i)];
      const double azimuth = std::atan2(p.y(), p.x());
      const double theta = std::asin(std::min(1.0, p.norm()));
      const MeridianProfile profile = meridian_profile(intensity, disc, azimuth);
      auto line = measure_line(profile, theta, azimuth, smallest, brightest);
      auto edge = measure_edge(profile, derivative(profile), theta, azimuth, smallest, brightest);
      if (edge && (!line || edge->variance < line->variance)) line = std::move(edge);
      found[static_cast<std::size_t>(i)] = std::move(line);
    });
    for (auto& m : found) {
      if (m && (!best || m->variance < best->variance)) best = std::move(m);
    }
  }
  FilterEstimate result = concluded(best, fallback, disc);
  result.regions = regions;
  return result;
}

FilterEstimate estimate_filter(const Image& component, const Disc& disc, double fallback) {
  const Image intensity = intensity_of(component, disc);
  const double brightest = brightest_of(intensity);
  std::vector<std::vector<Measured>> rows(kMeridians);
  if (brightest > 0) {
    parallel_for(kMeridians, [&](int i) {
      rows[static_cast<std::size_t>(i)] = candidates_on(intensity, disc, kPi * i / kMeridians, brightest);
    });
  }
  std::vector<Measured> all;
  for (auto& row : rows) std::ranges::move(row, std::back_inserter(all));
  std::ranges::stable_sort(all, {}, &Measured::variance);
  for (const Measured& m : all) {
    if (!is_confirmed(m, intensity, disc, brightest)) continue;
    FilterEstimate result = estimate_filter(component, disc, {around(m, disc, component)}, fallback, "found");
    result.automatic = true;
    if (result.measured) return result;
  }
  FilterEstimate result = concluded(std::nullopt, fallback, disc);
  result.automatic = true;
  return result;
}

Vec3 base_color_of(const Image& component, const Disc& disc) {
  Vec3 best = Vec3::Zero();
  double most = 0;
  for (int y = 0; y < component.height; ++y) {
    for (int x = 0; x < component.width; ++x) {
      if (!on_disc(disc, x, y)) continue;
      const Vec3 colour = component.rgb(x, y).cast<double>();
      const double l = luminance(colour);
      if (l > most) {
        most = l;
        best = colour;
      }
    }
  }
  if (!(most > 0)) return Vec3::Ones();
  return best.cwiseMax(1e-3 * best.maxCoeff());
}

}  // namespace sateen::matcap
