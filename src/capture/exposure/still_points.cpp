// SPDX-License-Identifier: MIT
#include "sateen/capture/exposure/still_points.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/median.h"

namespace sateen::capture {

StillPoints still_points(const FirstLook& look) {
  constexpr std::size_t kMost = 1000;
  const Scouting& scouting = look.scouting;
  const double nearest = scouting.radius + (look.reach + 6 + 0.05 * look.outline.radius);
  std::vector<Eigen::Vector2i> candidates;  // grey pixels
  for (int y = 2; y < scouting.height - 2; y += 2) {
    for (int x = 2; x < scouting.width - 2; x += 2) {
      if ((Vec2(x + 0.5, y + 0.5) - scouting.centre).norm() < nearest) continue;
      const auto i = pixel_index(x, y, scouting.width);
      if (static_cast<double>(scouting.activity[i]) > 3 * scouting.noise) continue;
      if (scouting.mean[i] < 40 || scouting.mean[i] > 235) continue;
      candidates.emplace_back(x, y);
    }
  }
  StillPoints points;
  const std::size_t n = std::min(kMost, candidates.size());
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2i& at = candidates[i * candidates.size() / n];
    points.pixels.emplace_back(at * look.factor + Eigen::Vector2i::Constant(look.factor / 2));
    const auto code = static_cast<double>(scouting.mean[pixel_index(at.x(), at.y(), scouting.width)]);
    points.grey.push_back(code * code / (255.0 * 255.0));
  }
  return points;
}

std::vector<Vec3f> sample_still_points(const StillPoints& points, const Photograph& frame) {
  std::vector<Vec3f> samples;
  samples.reserve(points.pixels.size());
  for (const Eigen::Vector2i& p : points.pixels) {
    Vec3f sum(0, 0, 0);
    bool clipped = false;
    for (int y = p.y() - 1; y <= p.y() + 1; ++y) {
      for (int x = p.x() - 1; x <= p.x() + 1; ++x) {
        clipped = clipped || frame.clipped(x, y);
        sum += frame.rgb(x, y);
      }
    }
    samples.push_back(clipped ? Vec3f(-1, -1, -1) : Vec3f(sum / 9));
  }
  return samples;
}

double mean_light(const std::vector<Vec3f>& samples) {
  double sum = 0;
  for (const Vec3f& light : samples) sum += light.y() < 0 ? 1 : static_cast<double>(light.y());
  return samples.empty() ? 1 : sum / static_cast<double>(samples.size());
}

double code_gain(const StillPoints& points, const std::vector<Vec3f>& samples) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i][0] < 0 || points.grey[i] <= 0) continue;
    const double grey = 0.25 * static_cast<double>(samples[i][0] + 2 * samples[i][1] + samples[i][2]);
    ratios.push_back(grey / points.grey[i]);
  }
  if (ratios.size() < 50) return 1;
  return std::sqrt(std::max(1e-3, middle_of(ratios)));
}

}  // namespace sateen::capture
