// SPDX-License-Identifier: MIT
#include "sateen/capture/table/assemble.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

#include "sateen/capture/table/fill_unseen.h"
#include "sateen/core/direction.h"
#include "sateen/core/parallel.h"

namespace sateen::capture {
namespace {

constexpr double kWidestBridge = 1.0 / 9;  // turns

struct Sample {
  double angle = 0;                     // turns, within one period
  Eigen::Array4f weighted{0, 0, 0, 0};  // weight times 1, r, g, b

  std::array<float, 3> rgb() const {
    return {weighted[1] / weighted[0], weighted[2] / weighted[0], weighted[3] / weighted[0]};
  }
};

/// Weighted sums of a quadratic least-squares fit in u = (angle - target) / half width.
struct Moments {
  /// Of u^0 .. u^2 times 1, r, g, b; of u^3 and u^4 times 1 alone.
  std::array<Eigen::Array4f, 3> t{Eigen::Array4f::Zero(), Eigen::Array4f::Zero(), Eigen::Array4f::Zero()};
  float cubes = 0;
  float fourths = 0;
  float left = 0;
  int count = 0;

  void add(const Sample& sample, float u) {
    const float hat = 1 - u * u;
    const Eigen::Array4f w = hat * hat * sample.weighted;
    const Eigen::Array4f square = u * u * w;
    t[0] += w;
    t[1] += u * w;
    t[2] += square;
    cubes += u * square[0];
    fourths += u * u * square[0];
    if (u < 0) left += w[0];
    ++count;
  }

  /// The fit's value at u = 0, of the highest degree the samples carry.
  std::array<float, 3> value() const {
    const auto of = [](float sum) { return static_cast<double>(sum); };
    const std::array s{of(t[0][0]), of(t[1][0]), of(t[2][0]), of(cubes), of(fourths)};
    // Shares of the three right-hand sides in the constant term, by Cramer's rule.
    double a = 1 / s[0];
    double b = 0;
    double c = 0;
    const bool two_sided = of(left) > 0.05 * s[0] && of(left) < 0.95 * s[0];
    const double linear = s[0] * s[2] - s[1] * s[1];
    const double quadratic = s[0] * (s[2] * s[4] - s[3] * s[3]) - s[1] * (s[1] * s[4] - s[2] * s[3]) +
                             s[2] * (s[1] * s[3] - s[2] * s[2]);
    if (two_sided && count >= 4 && quadratic > 1e-4 * s[0] * s[0] * s[0]) {
      const double k = 1 / quadratic;
      a = k * (s[2] * s[4] - s[3] * s[3]);
      b = k * (s[2] * s[3] - s[1] * s[4]);
      c = k * (s[1] * s[3] - s[2] * s[2]);
    } else if (two_sided && linear > 1e-4 * s[0] * s[0]) {
      a = s[2] / linear;
      b = -s[1] / linear;
    }
    const Eigen::Array4f sum =
        static_cast<float>(a) * t[0] + static_cast<float>(b) * t[1] + static_cast<float>(c) * t[2];
    return {sum[1], sum[2], sum[3]};
  }
};

/// Typical distance between different angles: coinciding samples (a second turn, an equivalent slice) count
/// once.
double spacing_of(const std::vector<Sample>& samples, double period) {
  const double close = 0.25 * period / static_cast<double>(samples.size());
  int different = 1;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (samples[i].angle - samples[i - 1].angle > close) ++different;
  }
  return period / different;
}

/// How a texel's light at one angle is known.
enum class Known { no, bridged, measured };

/// The light at ascending angles from samples sorted by angle.
class Fit {
 public:
  /// Inside a gap wider than the fit (a masked seam passing) the two shores are blended; beyond `widest`
  /// nothing is known.
  Fit(const std::vector<Sample>& samples, double half_width, double widest)
      : samples_(samples), half_width_(half_width), widest_(widest) {}

  /// `target`: not below the last one.
  Known at(double target, std::array<float, 3>& rgb) {
    while (above_ < samples_.size() && samples_[above_].angle < target) ++above_;
    if (above_ == 0 || above_ == samples_.size()) return Known::no;
    const Sample& above = samples_[above_];
    const Sample& below = samples_[above_ - 1];
    const double gap = above.angle - below.angle;
    if (gap > widest_) return Known::no;
    if (gap > 1.5 * half_width_) {
      const auto mix = static_cast<float>((target - below.angle) / gap);
      const auto from = below.rgb();
      const auto to = above.rgb();
      for (std::size_t c = 0; c < 3; ++c) rgb[c] = from[c] + mix * (to[c] - from[c]);
      return Known::bridged;
    }
    while (first_ < samples_.size() && samples_[first_].angle < target - half_width_) ++first_;
    Moments moments;
    for (std::size_t i = first_; i < samples_.size() && samples_[i].angle < target + half_width_; ++i)
      moments.add(samples_[i], static_cast<float>((samples_[i].angle - target) / half_width_));
    if (moments.count == 0) return Known::no;
    rgb = moments.value();
    return Known::measured;
  }

 private:
  const std::vector<Sample>& samples_;
  double half_width_;
  double widest_;
  std::size_t above_ = 0;  // the first that is not below the target
  std::size_t first_ = 0;  // of those the fit reaches
};

/// Frames and slices lie far apart in memory: this many texels of a row are fetched and put there together.
constexpr int kTogether = 32;

/// Sorts by angle. A turn ascends from wherever it starts: that needs no more than a rotation.
void put_in_order(std::vector<Sample>& samples) {
  std::rotate(samples.begin(), std::ranges::is_sorted_until(samples, {}, &Sample::angle), samples.end());
  if (!std::ranges::is_sorted(samples, {}, &Sample::angle)) std::ranges::sort(samples, {}, &Sample::angle);
}

/// Of light, which is not negative: several at once.
void to_floats(std::span<const Half> halves, float* floats) {
  // A half's exponent and fraction in a float's place are short of the difference of the biases.
  constexpr float kBias = std::bit_cast<float>((127U + 127 - 15) << 23);
  for (std::size_t i = 0; i < halves.size(); ++i)
    floats[i] = std::bit_cast<float>(std::uint32_t{std::bit_cast<std::uint16_t>(halves[i])} << 13) * kBias;
}

/// Each texel's samples, from all frames of a stack.
class Samples {
 public:
  Samples(const RectifiedStack& stack, const SurfaceMask& mask, double first_angle, double period)
      : stack_(stack), mask_(mask), period_(period), axes_(stack.axis) {
    for (const double angle : stack.angles) {
      poles_.push_back(TangentAngle::pole(first_angle, angle));
      turned_.push_back(direction_of(angle));
    }
  }

  /// Of the `count` texels from `first` on, ascending in angle.
  void collect(std::size_t first, std::size_t count,
               std::array<std::vector<Sample>, kTogether>& samples) const {
    std::vector<TangentAngle> tangents;
    for (std::size_t u = 0; u < count; ++u) {
      samples[u].clear();
      tangents.emplace_back(stack_.points[first + u], stack_.frame, axes_);
    }
    std::array<float, 3 * kTogether> light;
    for (std::size_t f = 0; f < stack_.frames.size(); ++f) {
      const RectifiedFrame& frame = stack_.frames[f];
      to_floats(std::span(frame.rgb).subspan(3 * first, 3 * count), light.data());
      for (std::size_t u = 0; u < count; ++u) {
        const std::size_t i = first + u;
        const SeenPoint& point = stack_.points[i];
        if (!point.visible || frame.weight[i] == 0) continue;
        if (mask_.size > 0 && mask_.excludes(body_point(axes_, point.normal, turned_[f]))) continue;
        Sample sample;
        sample.angle = tangents[u].at(poles_[f]);
        if (period_ < 1) sample.angle -= period_ * static_cast<int>(sample.angle / period_);
        sample.weighted = static_cast<float>(frame.weight[i]) / 255.0f *
                          Eigen::Array4f(1, light[3 * u], light[3 * u + 1], light[3 * u + 2]);
        samples[u].push_back(sample);
      }
    }
    for (std::size_t u = 0; u < count; ++u) put_in_order(samples[u]);
  }

 private:
  const RectifiedStack& stack_;
  const SurfaceMask& mask_;
  double period_;
  AxisFrame axes_;
  std::vector<Vec2> poles_;   // per frame, as TangentAngle takes it
  std::vector<Vec2> turned_;  // per frame, as direction_of
};

/// With those of the periods before and after that lie within `reach` of this one.
void repeat(const std::vector<Sample>& samples, double period, double reach, std::vector<Sample>& repeated) {
  repeated.clear();
  for (const double turn : {-period, 0.0, period}) {
    for (const Sample& sample : samples) {
      const double angle = sample.angle + turn;
      if (angle >= -reach && angle <= period + reach) repeated.push_back({angle, sample.weighted});
    }
  }
}

}  // namespace

AssembledSlices assemble(const RectifiedStack& stack, const SurfaceMask& mask, double first_angle, int count,
                         int symmetry) {
  const int size = stack.size;
  const auto texels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  const double period = 1.0 / symmetry;
  const Samples all(stack, mask, first_angle, period);
  AssembledSlices result;
  result.slices.resize(static_cast<std::size_t>(count));
  parallel_for(count,
               [&](int slice) { result.slices[static_cast<std::size_t>(slice)] = Image(size, size, 3); });
  result.seen.assign(texels * static_cast<std::size_t>(count), 0);
  parallel_for(size, [&](int y) {
    std::array<std::vector<Sample>, kTogether> samples;
    std::vector<Sample> repeated;
    std::vector<float> light(static_cast<std::size_t>(count * kTogether * 3));
    std::vector<std::uint8_t> known(static_cast<std::size_t>(count * kTogether));
    for (int x = 0; x < size; x += kTogether) {
      const auto first = pixel_index(x, y, size);
      const auto width = static_cast<std::size_t>(std::min(kTogether, size - x));
      all.collect(first, width, samples);
      std::ranges::fill(light, 0.0f);
      std::ranges::fill(known, std::uint8_t{0});
      for (std::size_t u = 0; u < width; ++u) {
        if (samples[u].size() < 3) continue;
        const double spacing = std::max(spacing_of(samples[u], period), period / count);
        const double widest = std::max(4 * spacing, kWidestBridge);
        repeat(samples[u], period, widest, repeated);
        Fit fit(repeated, 2 * spacing, widest);
        for (std::size_t slice = 0; slice < static_cast<std::size_t>(count); ++slice) {
          std::array<float, 3> rgb{};
          const Known how = fit.at(period * static_cast<double>(slice) / count, rgb);
          if (how == Known::no) continue;
          known[slice * kTogether + u] = how == Known::measured ? 1 : 2;
          for (std::size_t c = 0; c < 3; ++c) light[(slice * kTogether + u) * 3 + c] = std::max(0.0f, rgb[c]);
        }
      }
      for (std::size_t slice = 0; slice < static_cast<std::size_t>(count); ++slice) {
        std::copy_n(&light[slice * kTogether * 3], width * 3, &result.slices[slice].data[first * 3]);
        std::copy_n(&known[slice * kTogether], width, &result.seen[slice * texels + first]);
      }
    }
  });
  fill_unseen(result.slices, result.seen);
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < texels; ++i) {
    const auto texel = static_cast<int>(i);
    if (disc_of_pixel(texel % size, texel / size, size).norm() < 1) inside.push_back(i);
  }
  std::size_t seen = 0;
  for (std::size_t slice = 0; slice < result.seen.size(); slice += texels) {
    for (const std::size_t i : inside) seen += result.seen[slice + i] == 1 ? 1 : 0;
  }
  result.seen_share = static_cast<double>(seen) / static_cast<double>(inside.size() * result.slices.size());
  return result;
}

}  // namespace sateen::capture
