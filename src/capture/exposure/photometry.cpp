// SPDX-License-Identifier: MIT
#include "sateen/capture/exposure/photometry.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sateen/core/median.h"
#include "sateen/core/parallel.h"

namespace sateen::capture {
namespace {

constexpr std::size_t kFewest = 60;  // still points below which nothing is corrected

}  // namespace

Photometry solve_photometry(std::span<const std::vector<Vec3f>> samples,
                            std::span<const Eigen::Vector2i> points, int height) {
  const std::size_t frames = samples.size();
  const std::size_t n = points.size();
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
          if (c == 1) half[points[p].y() * 2 < height ? 0 : 1].push_back(ratio);
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

std::vector<std::string> advice(const Photometry& photometry) {
  std::vector<std::string> warnings;
  if (!photometry.measured) {
    warnings.emplace_back(
        "too little of the picture stands still and is lit, so exposure drift was not removed. Leave some "
        "lit background around the sphere, or fix the camera's exposure");
  }
  if (photometry.drift > 0.15) {
    warnings.push_back(
        fmt::format("the exposure changes by up to {:.0f} %: the light flickers or the camera adapts. It was "
                    "removed; fix exposure and white balance for less noise",
                    100 * photometry.drift));
  }
  if (photometry.banding > 0.02) {
    warnings.push_back(fmt::format(
        "the upper and lower half of the picture flicker apart by {:.1f} %: a lamp pulses faster than the "
        "camera reads a frame. Use a flicker-free lamp or an exposure of a whole mains period (1/50 or "
        "1/60 s)",
        100 * photometry.banding));
  }
  return warnings;
}

}  // namespace sateen::capture
