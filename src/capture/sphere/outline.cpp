// SPDX-License-Identifier: MIT
#include "sateen/capture/sphere/outline.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "sateen/core/error.h"
#include "sateen/core/median.h"
#include "sateen/core/parallel.h"

namespace sateen::capture {
namespace {

constexpr int kAzimuths = 240;
constexpr double kProfileStep = 0.5;  // pixels between samples of a profile

/// The four pixels of a picture around a point, clamped to the edge, and how far it lies from the first.
struct FourPixels {
  std::array<std::size_t, 4> pixels;
  double fx, fy;

  FourPixels(int width, int height, const Vec2& p) {
    const double cx = std::clamp(p.x() - 0.5, 0.0, width - 1.0);
    const double cy = std::clamp(p.y() - 0.5, 0.0, height - 1.0);
    const int x0 = static_cast<int>(cx);
    const int y0 = static_cast<int>(cy);
    const auto row = static_cast<std::size_t>(width);
    const std::size_t right = x0 + 1 < width ? 1 : 0;
    const std::size_t down = y0 + 1 < height ? row : 0;
    const std::size_t first = static_cast<std::size_t>(y0) * row + static_cast<std::size_t>(x0);
    pixels = {first, first + right, first + down, first + down + right};
    fx = cx - x0;
    fy = cy - y0;
  }
  double between(double a, double b, double c, double d) const {
    return (1 - fy) * ((1 - fx) * a + fx * b) + fy * ((1 - fx) * c + fx * d);
  }
};

/// Edges are mixtures of light, not of codes.
double light_at(const GreyPicture& picture, const FourPixels& at) {
  const auto light = [&](std::size_t corner) {
    return kLightOfCode<double>[picture.codes[at.pixels[corner]]];
  };
  return at.between(light(0), light(1), light(2), light(3));
}

/// Over the plate's known pixels; negative when any of the four is hidden.
double plate_at(const Plate& plate, const FourPixels& at) {
  const auto light = [&](std::size_t corner) { return static_cast<double>(plate.light[at.pixels[corner]]); };
  if (std::min({light(0), light(1), light(2), light(3)}) < 0) return -1;
  return at.between(light(0), light(1), light(2), light(3));
}

struct EdgePoint {
  std::size_t azimuth = 0;  // of kAzimuths
  Vec2 outward{0, 0};       // pixel direction
  double offset = 0;        // pixels along it
  double strength = 0;      // light per pixel
};

/// The steepest change of `difference` to the background along the profile, as the centroid of its slope.
bool find_edge(const std::vector<double>& difference, double reach, EdgePoint& edge) {
  const std::size_t n = difference.size();
  std::vector<double> slope(n, 0);
  std::size_t peak = 0;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    slope[i] = (difference[i + 1] - difference[i - 1]) / (2 * kProfileStep);
    if (std::abs(slope[i]) > std::abs(slope[peak])) peak = i;
  }
  if (peak < 3 || peak + 3 >= n) return false;
  double sum = 0;
  double moment = 0;
  for (std::size_t i = peak - 3; i <= peak + 3; ++i) {
    const double s = slope[i] * (slope[peak] > 0 ? 1 : -1);
    if (s <= 0) continue;
    sum += s;
    moment += s * static_cast<double>(i);
  }
  edge.offset = moment / sum * kProfileStep - reach;
  edge.strength = std::abs(slope[peak]);
  return true;
}

/// Robust least squares of offset = shift . outward + growth (Tukey's biweight).
OutlineOffset fit_offset(const std::vector<EdgePoint>& edges, bool fixed_radius) {
  OutlineOffset result;
  double scale = 2;
  for (int round = 0; round < 12; ++round) {
    Mat3 normal = Mat3::Identity() * 1e-9;
    Vec3 right = Vec3::Zero();
    double weights = 0;
    double squares = 0;
    int inside = 0;
    for (const EdgePoint& edge : edges) {
      const Vec3 row(edge.outward.x(), edge.outward.y(), fixed_radius ? 0 : 1);
      const double residual = edge.offset - edge.outward.dot(result.shift) - result.growth;
      const double u = residual / (4 * scale);
      if (std::abs(u) >= 1) continue;
      const double w = (1 - u * u) * (1 - u * u) * edge.strength / (edge.strength + 0.02);
      normal += w * row * row.transpose();
      right += w * row * residual;
      weights += w;
      squares += w * residual * residual;
      ++inside;
    }
    if (inside < 12) break;
    const Vec3 step = normal.ldlt().solve(right);
    result.shift += step.head<2>();
    if (!fixed_radius) result.growth += step.z();
    result.residual = std::sqrt(squares / weights);
    result.support = static_cast<double>(inside) / kAzimuths;
    scale = std::clamp(1.2 * result.residual, 0.12, scale);
  }
  return result;
}

/// The mean with up to `reach` neighbours on both sides, cyclic or as far as there are any.
void box_blur(std::vector<double>& values, int reach, bool cyclic) {
  const auto n = static_cast<int>(values.size());
  const std::vector<double> original = values;
  for (int i = 0; i < n; ++i) {
    double sum = 0;
    int count = 0;
    for (int j = i - reach; j <= i + reach; ++j) {
      if (!cyclic && (j < 0 || j >= n)) continue;
      sum += original[static_cast<std::size_t>((j + n) % n)];
      ++count;
    }
    values[static_cast<std::size_t>(i)] = sum / count;
  }
}

/// Averages profiles (one per azimuth) with their neighbours, and each along itself: the more, the noisier
/// the picture. The outline lies at about the same place in all of them.
void quieten(std::vector<std::vector<double>>& profiles, double noise) {
  const int reach = noise < 1.8 ? 0 : noise < 3 ? 1 : noise < 4.5 ? 2 : 3;
  if (reach == 0) return;
  std::vector<double> ring(profiles.size());
  for (std::size_t j = 0; j < profiles[0].size(); ++j) {
    for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = profiles[i][j];
    box_blur(ring, reach, true);
    for (std::size_t i = 0; i < ring.size(); ++i) profiles[i][j] = ring[i];
  }
  for (std::vector<double>& profile : profiles) {
    for (int pass = 0; pass < 2; ++pass) box_blur(profile, 1, false);
  }
}

/// The outline's seen points within `reach` pixels of where `sphere` predicts it.
std::vector<EdgePoint> find_edges(const GreyPicture& frame, double gain, const Plate& plate,
                                  const Camera& camera, const SphereView& sphere, double reach) {
  const Vec2 centre = sphere.centre_pixel(camera);
  const auto n = static_cast<std::size_t>(2 * reach / kProfileStep) + 1;
  const double light_gain = gain * gain;
  std::vector<std::vector<double>> profiles(kAzimuths, std::vector<double>(n));
  std::vector<Vec2> outward(kAzimuths);
  std::vector<double> lights(n);
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    std::vector<double>& difference = profiles[i];
    const Vec2 rim = sphere.outline_pixel(camera, 2 * kPi * static_cast<double>(i) / kAzimuths);
    outward[i] = (rim - centre).normalized();
    double background = -1;
    for (std::size_t j = n; j-- > 0;) {
      const Vec2 p = rim + (static_cast<double>(j) * kProfileStep - reach) * outward[i];
      const FourPixels at(frame.width, frame.height, p);
      const double known = plate_at(plate, at);
      // Behind the sphere the background is unknown: it goes on as it was last seen.
      if (known >= 0) background = known;
      lights[j] = light_at(frame, at) / light_gain;
      difference[j] = lights[j] - std::max(0.0, background);
    }
    if (background < 0) difference = lights;
  }
  quieten(profiles, plate.noise);
  std::vector<EdgePoint> edges;
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    EdgePoint edge;
    edge.azimuth = i;
    edge.outward = outward[i];
    if (find_edge(profiles[i], reach, edge) && edge.strength > 0.004) edges.push_back(edge);
  }
  return edges;
}

/// The background in a ring around the spheres, as the median over the frames that show it clear of the
/// outline. One instance serves a capture; beyond the reach of every frame's sphere nothing changes.
class Background {
 public:
  Background(std::span<const GreyPicture> frames, const Scouting& scouting, const Camera& camera)
      : frames_(frames), scouting_(scouting), camera_(camera) {
    plate_.width = frames[0].width;
    plate_.height = frames[0].height;
    plate_.noise = scouting.noise;
    plate_.light.assign(frames[0].codes.size(), -1);
    clear_.assign(plate_.light.size(), 0);
  }

  /// With the spheres at `centres`, widened by `margin` pixels. An outline is a cone of rays about the
  /// direction of the sphere: that holds for the ellipses of a near camera as well.
  const Plate& around(const std::vector<Vec2>& centres, double radius, double margin) {
    const double focal = camera_.focal.mean();
    std::vector<Vec3> spheres;
    Vec3 middle(0, 0, 0);
    for (const Vec2& c : centres) {
      spheres.push_back(camera_.ray(c));
      middle += spheres.back();
    }
    middle.normalize();
    double spread = 0;
    for (const Vec3& sphere : spheres)
      spread = std::max(spread, std::acos(std::min(1.0, sphere.dot(middle))));
    const double cone = std::atan(radius / focal) + margin / focal;
    const double own = std::cos(cone);
    const double ring = std::cos(std::atan((radius * 1.1 + 12) / focal));
    const double clear_of_all = std::cos(cone + spread);
    const double hidden_in_all = std::cos(std::max(0.0, cone - spread));
    const Vec2 seen_middle = camera_.project(middle);
    const double farthest = 2 * radius + 24;  // the longest ellipse there may be
    parallel_for(plate_.height, [&](int y) {
      const double beside = farthest * farthest - std::pow(y + 0.5 - seen_middle.y(), 2);
      if (beside <= 0) return;
      const int first = std::max(0, static_cast<int>(seen_middle.x() - std::sqrt(beside)));
      const int end = std::min(plate_.width, static_cast<int>(seen_middle.x() + std::sqrt(beside)) + 1);
      std::vector<float> values;
      for (int x = first; x < end; ++x) {
        const Vec2 p(x + 0.5, y + 0.5);
        const Vec3 ray = camera_.ray(p);
        const double cosine = ray.dot(middle);
        if (cosine < ring) continue;
        const auto i = pixel_index(x, y, plate_.width);
        const bool clear = cosine <= clear_of_all;
        if (clear && clear_[i] != 0) continue;
        clear_[i] = clear ? 1 : 0;
        plate_.light[i] = -1;
        if (cosine > hidden_in_all) continue;
        values.clear();
        for (std::size_t f = 0; f < frames_.size(); ++f) {
          if (!clear && ray.dot(spheres[f]) > own) continue;
          const double gain = static_cast<double>(scouting_.gain[f]);
          values.push_back(static_cast<float>(kLightOfCode<double>[frames_[f].codes[i]] / (gain * gain)));
        }
        if (values.empty()) continue;
        plate_.light[i] = middle_of(values);
      }
    });
    return plate_;
  }

 private:
  std::span<const GreyPicture> frames_;
  const Scouting& scouting_;
  Camera camera_;
  Plate plate_;
  std::vector<std::uint8_t> clear_;  // 1: the median of all frames is known
};

}  // namespace

OutlineOffset measure_outline(const GreyPicture& frame, double gain, const Plate& plate, const Camera& camera,
                              const SphereView& sphere, double reach, bool fixed_radius) {
  return fit_offset(find_edges(frame, gain, plate, camera, sphere, reach), fixed_radius);
}

std::vector<Vec2> mean_outline(std::span<const GreyPicture> frames, const Scouting& scouting,
                               const Camera& camera, const OutlineFit& fit, double reach) {
  std::vector<std::vector<EdgePoint>> edges(frames.size());
  parallel_for(static_cast<int>(frames.size()), [&](int f) {
    const auto i = static_cast<std::size_t>(f);
    edges[i] = find_edges(frames[i], static_cast<double>(scouting.gain[i]), fit.plate, camera,
                          sphere_at(camera, fit.centres[i], fit.radius), reach);
  });
  std::vector<std::vector<double>> offsets(kAzimuths);
  for (const std::vector<EdgePoint>& frame : edges) {
    for (const EdgePoint& edge : frame) offsets[edge.azimuth].push_back(edge.offset);
  }
  Vec2 middle(0, 0);
  for (const Vec2& c : fit.centres) middle += c / static_cast<double>(fit.centres.size());
  const SphereView sphere = sphere_at(camera, middle, fit.radius);
  std::vector<Vec2> outline;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    if (offsets[i].size() * 3 < frames.size() || offsets[i].empty()) continue;
    const Vec2 rim = sphere.outline_pixel(camera, 2 * kPi * static_cast<double>(i) / kAzimuths);
    outline.push_back(rim + median(offsets[i]) * (rim - middle).normalized());
  }
  return outline;
}

OutlineFit fit_outlines(std::span<const GreyPicture> frames, const Scouting& scouting, const Camera& camera) {
  const std::size_t n = frames.size();
  OutlineFit fit;
  fit.radius = scouting.radius;
  fit.centres.assign(n, scouting.centre);
  fit.residuals.assign(n, 0);
  Background background(frames, scouting, camera);
  // The swept circle is larger than the sphere by the wobble, which is unknown yet: the first search is wide.
  const double widest = std::clamp(0.15 * scouting.radius, 8.0, 30.0);
  const std::vector<double> reaches{widest, std::max(6.0, widest / 2), 6, 4, 3, 3};
  for (std::size_t round = 0; round < reaches.size(); ++round) {
    fit.plate = background.around(fit.centres, fit.radius, round == 0 ? 3 : 2);
    std::vector<OutlineOffset> offsets(n);
    parallel_for(static_cast<int>(n), [&](int f) {
      const auto i = static_cast<std::size_t>(f);
      const SphereView sphere = sphere_at(camera, fit.centres[i], fit.radius);
      offsets[i] = measure_outline(frames[i], static_cast<double>(scouting.gain[i]), fit.plate, camera,
                                   sphere, reaches[round], false);
    });
    std::vector<double> growths;
    for (const OutlineOffset& offset : offsets) {
      if (offset.support > 0.3) growths.push_back(offset.growth);
    }
    if (growths.size() * 2 < n) {
      throw Error(
          "the sphere's outline cannot be told from the background; put something plain behind it that is "
          "brighter or "
          "darker than the material");
    }
    const double growth = median(growths);
    fit.radius += growth;
    fit.support = 0;
    for (std::size_t i = 0; i < n; ++i) {
      // With the common radius the shift is what is left; growth and shift are independent around a whole
      // outline.
      if (offsets[i].support > 0.3) fit.centres[i] += offsets[i].shift;
      fit.residuals[i] = offsets[i].residual;
      fit.support += offsets[i].support / static_cast<double>(n);
    }
  }
  return fit;
}

}  // namespace sateen::capture
