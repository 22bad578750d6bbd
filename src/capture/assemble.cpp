// SPDX-License-Identifier: MIT
#include "sateen/capture/assemble.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sateen/core/direction.h"
#include "sateen/core/parallel.h"

namespace sateen {
namespace {

constexpr double kWidestBridge = 1.0 / 9;  // turns

struct Sample {
  double angle = 0;  // turns, within one period
  float weight = 0;
  std::array<float, 3> rgb{};
};

/// Weighted sums of a quadratic least-squares fit in u = (angle - target) / half width.
struct Moments {
  std::array<double, 5> s{};                 // of u^0 .. u^4
  std::array<std::array<double, 3>, 3> t{};  // of u^0 .. u^2 times r, g, b
  double left = 0;
  double right = 0;
  int count = 0;

  void add(const Sample& sample, double u) {
    const double hat = 1 - u * u;
    const double w = hat * hat * static_cast<double>(sample.weight);
    double power = w;
    for (std::size_t p = 0; p < 5; ++p) {
      s[p] += power;
      if (p < 3) {
        for (std::size_t c = 0; c < 3; ++c) t[p][c] += power * static_cast<double>(sample.rgb[c]);
      }
      power *= u;
    }
    (u < 0 ? left : right) += w;
    ++count;
  }

  /// The fit's value at u = 0, of the highest degree the samples carry.
  std::array<float, 3> value() const {
    std::array<float, 3> result{};
    // Shares of the three right-hand sides in the constant term, by Cramer's rule.
    double a = 1 / s[0];
    double b = 0;
    double c = 0;
    const bool two_sided = left > 0.05 * s[0] && right > 0.05 * s[0];
    const double linear = s[0] * s[2] - s[1] * s[1];
    const double quadratic = s[0] * (s[2] * s[4] - s[3] * s[3]) - s[1] * (s[1] * s[4] - s[2] * s[3]) +
                             s[2] * (s[1] * s[3] - s[2] * s[2]);
    if (two_sided && count >= 4 && quadratic > 1e-4 * s[0] * s[0] * s[0]) {
      a = (s[2] * s[4] - s[3] * s[3]) / quadratic;
      b = -(s[1] * s[4] - s[2] * s[3]) / quadratic;
      c = (s[1] * s[3] - s[2] * s[2]) / quadratic;
    } else if (two_sided && linear > 1e-4 * s[0] * s[0]) {
      a = s[2] / linear;
      b = -s[1] / linear;
    }
    for (std::size_t i = 0; i < 3; ++i)
      result[i] = static_cast<float>(a * t[0][i] + b * t[1][i] + c * t[2][i]);
    return result;
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

/// The light at `target` from samples sorted by angle and repeated over three periods. Inside a gap wider
/// than the fit (a masked seam passing) the two shores are blended; beyond `widest` nothing is known.
Known fit_at(const std::vector<Sample>& samples, double target, double half_width, double widest,
             std::array<float, 3>& rgb) {
  const auto above = std::ranges::lower_bound(samples, target, {}, &Sample::angle);
  if (above == samples.begin() || above == samples.end()) return Known::no;
  const auto below = above - 1;
  const double gap = above->angle - below->angle;
  if (gap > widest) return Known::no;
  if (gap > 1.5 * half_width) {
    const auto mix = static_cast<float>((target - below->angle) / gap);
    for (std::size_t c = 0; c < 3; ++c) rgb[c] = below->rgb[c] + mix * (above->rgb[c] - below->rgb[c]);
    return Known::bridged;
  }
  Moments moments;
  auto it = std::ranges::lower_bound(samples, target - half_width, {}, &Sample::angle);
  for (; it != samples.end() && it->angle < target + half_width; ++it)
    moments.add(*it, (it->angle - target) / half_width);
  if (moments.count == 0) return Known::no;
  rgb = moments.value();
  return Known::measured;
}

/// Makes the `filled` texels of the disc as smooth as they can be between those that are known: each the mean
/// of its neighbours on the disc (Laplace's equation, by Gauss-Seidel with over-relaxation).
void smooth_filling(Image& slice, const std::vector<std::size_t>& filled) {
  const int size = slice.width;
  const auto on_disc = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < size && y < size && disc_of_pixel(x, y, size).norm() < 1;
  };
  struct Texel {
    float* rgb;
    std::array<const float*, 4> around;
    int count;
  };
  std::vector<Texel> inside;
  for (const std::size_t i : filled) {
    const int x = static_cast<int>(i) % size;
    const int y = static_cast<int>(i) / size;
    if (!on_disc(x, y)) continue;
    Texel texel{slice.pixel(x, y).data(), {}, 0};
    for (const auto& [u, v] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      if (on_disc(x + u, y + v))
        texel.around[static_cast<std::size_t>(texel.count++)] = slice.pixel(x + u, y + v).data();
    }
    if (texel.count > 0) inside.push_back(texel);
  }
  for (int round = 0; round < 60; ++round) {
    const float over = round < 56 ? 1.6f : 1.0f;
    for (const Texel& texel : inside) {
      for (int c = 0; c < 3; ++c) {
        float sum = 0;
        for (int i = 0; i < texel.count; ++i) sum += texel.around[static_cast<std::size_t>(i)][c];
        texel.rgb[c] += over * (sum / static_cast<float>(texel.count) - texel.rgb[c]);
      }
    }
  }
}

/// Calls body(index, weight) for the up to eight neighbours of a texel; those across a corner weigh less.
template <class Body>
void for_neighbours(int size, std::size_t index, const Body& body) {
  const int x = static_cast<int>(index) % size;
  const int y = static_cast<int>(index) / size;
  for (int v = std::max(0, y - 1); v <= std::min(size - 1, y + 1); ++v) {
    for (int u = std::max(0, x - 1); u <= std::min(size - 1, x + 1); ++u) {
      if (u != x || v != y) body(static_cast<std::size_t>(v * size + u), u != x && v != y ? 0.7f : 1.0f);
    }
  }
}

/// Grows known texels over unknown ones, ring by ring, as the mean of the known neighbours.
void grow_known(Image& slice, std::vector<std::uint8_t> known) {
  constexpr std::uint8_t kWaiting = 255;  // unknown, but next in turn
  const int size = slice.width;
  std::vector<std::size_t> ring;
  const auto queue_unknown_around = [&](std::size_t i, std::vector<std::size_t>& queue) {
    for_neighbours(size, i, [&](std::size_t j, float) {
      if (known[j] != 0) return;
      known[j] = kWaiting;
      queue.push_back(j);
    });
  };
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i] != 0 && known[i] != kWaiting) queue_unknown_around(i, ring);
  }
  std::vector<std::size_t> next;
  while (!ring.empty()) {
    next.clear();
    for (const std::size_t i : ring) {
      Vec3f sum(0, 0, 0);
      float weight = 0;
      for_neighbours(size, i, [&](std::size_t j, float w) {
        if (known[j] == 0 || known[j] == kWaiting) return;
        sum += w * slice.rgb(static_cast<int>(j) % size, static_cast<int>(j) / size);
        weight += w;
      });
      slice.set_rgb(static_cast<int>(i) % size, static_cast<int>(i) / size, sum / weight);
    }
    for (const std::size_t i : ring) known[i] = 1;
    for (const std::size_t i : ring) queue_unknown_around(i, next);
    ring.swap(next);
  }
}

/// Fills what nobody saw: smoothly on the disc, and beyond it so that no filter sees an edge.
void fill_from_neighbours(Image& slice, std::vector<std::uint8_t> known) {
  grow_known(slice, known);
  std::vector<std::size_t> filled;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i] == 0) filled.push_back(i);
  }
  smooth_filling(slice, filled);
  for (const std::size_t i : filled) {
    const auto texel = static_cast<int>(i);
    const bool inside = disc_of_pixel(texel % slice.width, texel / slice.width, slice.width).norm() < 1;
    if (inside) known[i] = 1;
  }
  grow_known(slice, std::move(known));
}

}  // namespace

AssembledSlices assemble(const RectifiedStack& stack, const SurfaceMask& mask, double first_angle, int count,
                         int symmetry) {
  const int size = stack.size;
  const auto texels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  const double period = 1.0 / symmetry;
  const AxisFrame axes(stack.axis);
  std::vector<Vec2> poles;
  std::vector<Vec2> turned;
  for (const double angle : stack.angles) {
    poles.push_back(TangentAngle::pole(first_angle, angle));
    turned.push_back(direction_of(angle));
  }
  const bool masked = mask.size > 0;
  AssembledSlices result;
  result.slices.assign(static_cast<std::size_t>(count), Image(size, size, 3));
  result.seen.assign(texels * static_cast<std::size_t>(count), 0);
  parallel_for(size, [&](int y) {
    std::vector<Sample> samples;
    std::vector<Sample> repeated;
    for (int x = 0; x < size; ++x) {
      const auto i = static_cast<std::size_t>(y * size + x);
      const SeenPoint& point = stack.points[i];
      if (!point.visible) continue;
      const TangentAngle tangent(point, stack.frame, axes);
      samples.clear();
      for (std::size_t f = 0; f < stack.frames.size(); ++f) {
        const RectifiedFrame& frame = stack.frames[f];
        if (frame.weight[i] == 0) continue;
        if (masked && mask.excludes(body_point(axes, point.normal, turned[f]))) continue;
        Sample sample;
        sample.angle = wrap(tangent.at(poles[f]), period);
        sample.weight = static_cast<float>(frame.weight[i]) / 255.0f;
        for (std::size_t c = 0; c < 3; ++c) sample.rgb[c] = static_cast<float>(frame.rgb[i * 3 + c]);
        samples.push_back(sample);
      }
      if (samples.size() < 3) continue;
      std::ranges::sort(samples, {}, &Sample::angle);
      const double spacing = std::max(spacing_of(samples, period), period / count);
      repeated.clear();
      for (const double turn : {-period, 0.0, period}) {
        for (Sample sample : samples) {
          sample.angle += turn;
          repeated.push_back(sample);
        }
      }
      for (int slice = 0; slice < count; ++slice) {
        std::array<float, 3> rgb{};
        const Known known =
            fit_at(repeated, period * slice / count, 2 * spacing, std::max(4 * spacing, kWidestBridge), rgb);
        if (known == Known::no) continue;
        result.slices[static_cast<std::size_t>(slice)].set_rgb(
            x, y, Vec3f(std::max(0.0f, rgb[0]), std::max(0.0f, rgb[1]), std::max(0.0f, rgb[2])));
        result.seen[static_cast<std::size_t>(slice) * texels + i] = known == Known::measured ? 1 : 2;
      }
    }
  });
  parallel_for(count, [&](int slice) {
    const auto first =
        result.seen.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(slice) * texels);
    fill_from_neighbours(result.slices[static_cast<std::size_t>(slice)],
                         {first, first + static_cast<std::ptrdiff_t>(texels)});
  });
  double inside = 0;
  double seen = 0;
  for (std::size_t i = 0; i < result.seen.size(); ++i) {
    const auto texel = static_cast<int>(i % texels);
    if (disc_of_pixel(texel % size, texel / size, size).norm() >= 1) continue;
    ++inside;
    seen += result.seen[i] == 1 ? 1 : 0;
  }
  result.seen_share = seen / inside;
  return result;
}

}  // namespace sateen
