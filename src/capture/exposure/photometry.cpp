// SPDX-License-Identifier: MIT
#include "sateen/capture/exposure/photometry.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/median.h"
#include "sateen/core/parallel.h"

namespace sateen::capture {
namespace {

constexpr std::size_t kFewest = 60;  // still points below which nothing is corrected

}  // namespace

StillPoints still_points(const Scouting& scouting, int grey_width, int grey_height, int factor,
                         double clearance, std::size_t count) {
  std::vector<Eigen::Vector2i> candidates;
  for (int y = 2; y < grey_height - 2; y += 2) {
    for (int x = 2; x < grey_width - 2; x += 2) {
      if ((Vec2(x + 0.5, y + 0.5) - scouting.centre).norm() < scouting.radius + clearance) continue;
      const auto i = pixel_index(x, y, grey_width);
      if (static_cast<double>(scouting.activity[i]) > 3 * scouting.noise) continue;
      if (scouting.mean[i] < 40 || scouting.mean[i] > 235) continue;
      candidates.emplace_back(x * factor + factor / 2, y * factor + factor / 2);
    }
  }
  StillPoints points;
  const std::size_t n = std::min(count, candidates.size());
  for (std::size_t i = 0; i < n; ++i) points.pixels.push_back(candidates[i * candidates.size() / n]);
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

Photometry solve_photometry(std::span<const std::vector<Vec3f>> samples, const StillPoints& points,
                            int height) {
  const std::size_t frames = samples.size();
  const std::size_t n = points.pixels.size();
  Photometry result;
  result.gain.assign(frames, Vec3(1, 1, 1));
  if (n < kFewest || frames == 0) return result;

  std::vector<Vec3> halves(frames, Vec3(0, 0, 0));  // green: upper, lower
  std::vector<Vec3f> reference(n, Vec3f(0, 0, 0));
  for (int round = 0; round < 3; ++round) {
    // The reference light of each point, gains removed; then each frame's gain against it.
    std::vector<Vec3f> inverse(frames);
    for (std::size_t f = 0; f < frames; ++f) inverse[f] = result.gain[f].cwiseInverse().cast<float>();
    parallel_for(static_cast<int>(n), [&](int point) {
      const auto p = static_cast<std::size_t>(point);
      std::vector<float> values;
      values.reserve(frames);
      for (int c = 0; c < 3; ++c) {
        values.clear();
        for (std::size_t f = 0; f < frames; ++f) {
          if (samples[f][p][c] >= 0) values.push_back(samples[f][p][c] * inverse[f][c]);
        }
        reference[p][c] = values.size() * 2 > frames ? middle_of(values) : -1;
      }
    });
    parallel_for(static_cast<int>(frames), [&](int frame) {
      const auto f = static_cast<std::size_t>(frame);
      std::vector<float> values;
      std::vector<float> half[2];
      for (int c = 0; c < 3; ++c) {
        values.clear();
        for (std::size_t p = 0; p < n; ++p) {
          if (samples[f][p][c] < 0 || reference[p][c] < 0.004f) continue;
          const float ratio = samples[f][p][c] / reference[p][c];
          values.push_back(ratio);
          if (c == 1) half[points.pixels[p].y() * 2 < height ? 0 : 1].push_back(ratio);
        }
        result.gain[f][c] = values.size() >= kFewest ? static_cast<double>(middle_of(values)) : 1;
      }
      if (half[0].size() >= kFewest && half[1].size() >= kFewest) {
        halves[f] = {static_cast<double>(middle_of(half[0])), static_cast<double>(middle_of(half[1])), 0};
      }
    });
    Vec3 mean(0, 0, 0);
    for (const Vec3& gain : result.gain) mean += gain.array().log().matrix() / static_cast<double>(frames);
    for (Vec3& gain : result.gain) gain = (gain.array() / mean.array().exp()).matrix();
  }
  double squares = 0;
  for (std::size_t f = 0; f < frames; ++f) {
    const Vec3& gain = result.gain[f];
    result.drift = std::max(result.drift, std::abs(gain.y() - 1));
    result.colour_drift =
        std::max({result.colour_drift, std::abs(gain.x() / gain.y() - 1), std::abs(gain.z() / gain.y() - 1)});
    squares += std::pow(halves[f].x() - halves[f].y(), 2);
  }
  result.banding = std::sqrt(squares / static_cast<double>(frames));
  result.measured = true;
  return result;
}

}  // namespace sateen::capture
