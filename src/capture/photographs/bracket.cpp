// SPDX-License-Identifier: MIT
#include "sateen/capture/photographs/bracket.h"

#include <algorithm>
#include <cmath>

#include "sateen/capture/photographs/lens_notes.h"

namespace sateen::capture {

std::vector<double> find_brackets(std::span<const std::filesystem::path> files) {
  if (files.size() < 4) return {};
  // A dozen notes decide; reading those of every picture is only worth it once they look like brackets.
  const auto times_of = [&](std::size_t n) {
    std::vector<double> times;
    for (std::size_t i = 0; i < n; ++i) times.push_back(read_lens_notes(files[i]).exposure_time);
    return times;
  };
  const auto same = [](double a, double b) { return std::abs(a - b) <= 0.02 * std::max(a, b); };
  std::vector<double> times = times_of(std::min<std::size_t>(files.size(), 20));
  if (std::ranges::any_of(times, [](double t) { return t <= 0; })) return {};
  for (std::size_t period = 2; period <= 9 && 2 * period <= times.size(); ++period) {
    if (files.size() % period != 0) continue;
    const auto repeats = [&] {
      for (std::size_t i = period; i < times.size(); ++i) {
        if (!same(times[i], times[i - period])) return false;
      }
      return true;
    };
    bool different = true;
    for (std::size_t i = 0; i < period; ++i) {
      for (std::size_t j = 0; j < i; ++j) different = different && !same(times[i], times[j]);
    }
    if (!different || !repeats()) continue;
    times = times_of(files.size());
    if (!repeats()) return {};
    times.resize(period);
    return times;
  }
  return {};
}

Photograph merge_brackets(std::span<const Photograph> group, std::span<const double> exposure_times) {
  const double longest = *std::ranges::max_element(exposure_times);
  const auto shortest =
      static_cast<std::size_t>(std::ranges::min_element(exposure_times) - exposure_times.begin());
  Image light(group[0].width(), group[0].height(), 3);
  float clip = 0;
  for (int y = 0; y < light.height; ++y) {
    for (int x = 0; x < light.width; ++x) {
      Vec3f sum(0, 0, 0);
      float weights = 0;
      for (std::size_t i = 0; i < group.size(); ++i) {
        const auto scale = static_cast<float>(longest / exposure_times[i]);
        const Vec3f value = group[i].rgb(x, y);
        // The darkest exposure speaks for what all others clip.
        float weight = i == shortest ? 1e-6f : 0;
        if (!group[i].clipped(x, y)) weight += std::max(1e-5f, value.maxCoeff()) / scale;
        sum += weight * scale * value;
        weights += weight;
      }
      light.set_rgb(x, y, sum / weights);
      if (group[shortest].clipped(x, y)) clip = std::max(clip, light.rgb(x, y).maxCoeff());
    }
  }
  const auto range = static_cast<float>(longest / exposure_times[shortest]);
  return {std::move(light),
          clip > 0 ? std::min(clip, 0.98f * range) : std::numeric_limits<float>::infinity()};
}

}  // namespace sateen::capture
