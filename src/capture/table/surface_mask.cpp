// SPDX-License-Identifier: MIT
#include "sateen/capture/table/surface_mask.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <span>

#include <opencv2/imgproc.hpp>

#include "sateen/capture/table/stack.h"
#include "sateen/core/direction.h"
#include "sateen/core/parallel.h"

namespace sateen::capture {
namespace {

constexpr double kNear = 0.06;      // radians: neighbours closer than this may still show the blemish itself
constexpr double kFar = 0.40;       // radians: beyond, the shading has changed
constexpr double kSmallest = 0.12;  // log light: below this it is the material's own unevenness

/// The light below which a sample is noise: 2 % of the light that 95 % of the samples stay below.
float dark_floor(const RectifiedStack& stack) {
  std::vector<float> values;
  for (std::size_t f = 0; f < stack.frames.size(); f += 4) {
    const RectifiedFrame& frame = stack.frames[f];
    for (std::size_t i = 0; i < frame.weight.size(); i += 17) {
      if (frame.weight[i] > 0) values.push_back(static_cast<float>(frame.rgb[i * 3 + 1]));
    }
  }
  if (values.empty()) return 1e-3f;
  const auto high = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 95 / 100);
  std::ranges::nth_element(values, high);
  return std::max(1e-5f, 0.02f * *high);
}

constexpr std::int8_t kUnknown = -128;
constexpr std::size_t kMostNeighbours = 16;  // a median needs no more
constexpr int kColumns = 8;

/// A value for each of kColumns texels beside each other.
using Columns = Eigen::Array<float, kColumns, 1>;

/// What one frame has for kColumns texels beside each other.
struct BlockLight {
  std::array<Columns, 3> light;                 // log, per channel
  std::array<std::uint8_t, kColumns> usable{};  // 0: unseen, 1: seen, 2: seen but known to be a blemish
  bool whole = false;                           // all are 1
};

std::size_t usable_in(std::span<const BlockLight* const> rows, std::size_t column) {
  std::size_t count = 0;
  for (const BlockLight* row : rows) count += row->usable[column] == 1 ? 1 : 0;
  return count;
}

/// Exchanges where the first is above the second.
void in_order(Columns& a, Columns& b) {
  const Columns smaller = a.min(b);
  b = a.max(b);
  a = smaller;
}

/// Batcher's odd-even merge sort of eight.
void sort_eight(Columns* v) {
  constexpr std::array kFirst{0, 2, 4, 6, 0, 1, 4, 5, 1, 5, 0, 1, 2, 3, 2, 3, 1, 3, 5};
  constexpr std::array kSecond{1, 3, 5, 7, 2, 3, 6, 7, 2, 6, 4, 5, 6, 7, 4, 5, 2, 4, 6};
#pragma GCC unroll 19
  for (std::size_t i = 0; i < kFirst.size(); ++i) in_order(v[kFirst[i]], v[kSecond[i]]);
}

/// The middle values (the upper of two) of the usable ones in each column of `channel`, by a network, so that
/// several medians share each instruction. `rows`: at most kMostNeighbours.
Columns middle_of_columns(std::span<const BlockLight* const> rows, std::size_t channel) {
  static_assert(kMostNeighbours == 16);
  const std::size_t n = rows.size();
  std::array<Columns, kMostNeighbours> v;
  for (std::size_t i = 0; i < n; ++i) v[i] = rows[i]->light[channel];
  // The missing ones go below and above, so that the middle of all stays the middle of the others.
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (std::size_t i = n; i < v.size(); ++i) v[i] = Columns::Constant(i % 2 == 0 ? kInfinity : -kInfinity);
  if (!std::ranges::all_of(rows, &BlockLight::whole)) {
    for (std::size_t column = 0; column < kColumns; ++column) {
      std::size_t below = kMostNeighbours / 2 - usable_in(rows, column) / 2 - (kMostNeighbours - n + 1) / 2;
      for (std::size_t i = 0; i < n; ++i) {
        if (rows[i]->usable[column] == 1) continue;
        v[i][static_cast<Eigen::Index>(column)] = below > 0 ? -kInfinity : kInfinity;
        if (below > 0) --below;
      }
    }
  }
  sort_eight(v.data());
  sort_eight(v.data() + 8);
  // Of two ascending halves the larger of each pair, first with last, are the upper half of all.
  Columns middle = v[0].max(v[15]);
  for (std::size_t i = 1; i < 8; ++i) middle = middle.min(v[i].max(v[15 - i]));
  return middle;
}

/// Some forty frames agree as well as all of them.
std::size_t frame_step(std::size_t frames) {
  return std::max<std::size_t>(1, frames / 32);
}

std::uint16_t bits_of(Half value) {
  return std::bit_cast<std::uint16_t>(value);
}

/// Natural log of the light plus `dark`, of every half float there is by its bits.
std::vector<float> log_light(float dark) {
  std::vector<float> table(1 << 16);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto light = static_cast<float>(std::bit_cast<Half>(static_cast<std::uint16_t>(i)));
    table[i] = std::log(std::max(0.0f, light) + dark);
  }
  return table;
}

/// How much each rectified sample differs from the median of the angles around it, natural log, 100 a unit,
/// clamped to +-1.2; kUnknown in the dark and where too few neighbours are seen. Index (frame * texels +
/// texel)
/// * 3 + channel.
using Deviations = std::vector<std::int8_t>;

/// Brings `result`, empty or of a part of `already`, up to date with what is `already` known to be a blemish.
void find_deviations(const RectifiedStack& stack, const SurfaceMask& already, Deviations& result) {
  const std::size_t frames = stack.frames.size();
  const std::size_t texels = stack.points.size();
  const AxisFrame axes(stack.axis);
  const float dark = dark_floor(stack);
  const bool again = !result.empty();
  result.resize(frames * texels * 3, kUnknown);
  const std::size_t step = frame_step(frames);
  // The neighbours of a frame along the turn are the same for all texels.
  std::vector<std::vector<std::size_t>> neighbours(frames);
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t g = 0; g < frames; ++g) {
      const double apart = std::abs(std::remainder(stack.angles[g] - stack.angles[f], 2 * kPi));
      if (apart > kNear && apart < kFar) neighbours[f].push_back(g);
    }
    const std::size_t every = (neighbours[f].size() + kMostNeighbours - 1) / kMostNeighbours;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < neighbours[f].size(); i += std::max<std::size_t>(1, every)) {
      neighbours[f][kept++] = neighbours[f][i];
    }
    neighbours[f].resize(kept);
  }
  const int blocks = (stack.size + kColumns - 1) / kColumns;
  const float darkest = std::log(3 * dark);
  const std::vector<float> logarithm = log_light(dark);
  std::vector<Vec2> turned;
  for (const double angle : stack.angles) turned.push_back(direction_of(angle));
  parallel_for(stack.size, [&](int row) {
    std::vector<BlockLight> light(frames);
    std::vector<const BlockLight*> around;
    for (int block = 0; block < blocks; ++block) {
      const int first = block * kColumns;
      bool any = false;  // seen at all
      bool excluded = false;
      for (std::size_t f = 0; f < frames; ++f) {
        const RectifiedFrame& frame = stack.frames[f];
        BlockLight& here = light[f];
        here.whole = true;
        for (int u = 0; u < kColumns; ++u) {
          const auto i = static_cast<std::size_t>(row) * static_cast<std::size_t>(stack.size) +
                         static_cast<std::size_t>(std::min(first + u, stack.size - 1));
          std::uint8_t& use = here.usable[static_cast<std::size_t>(u)];
          use = first + u < stack.size && stack.points[i].visible && frame.weight[i] > 127 ? 1 : 0;
          if (use != 0 && already.size > 0 &&
              already.excludes(body_point(axes, stack.points[i].normal, turned[f])))
            use = 2;
          any = any || use != 0;
          excluded = excluded || use == 2;
          here.whole = here.whole && use == 1;
          for (std::size_t c = 0; c < 3; ++c)
            here.light[c][u] = use == 0 ? 0 : logarithm[bits_of(frame.rgb[i * 3 + c])];
        }
      }
      if (!any || (again && !excluded)) continue;
      for (std::size_t f = 0; f < frames; f += step) {
        around.clear();
        for (const std::size_t g : neighbours[f]) around.push_back(&light[g]);
        std::array<bool, kColumns> known{};  // usable, and enough of the angles around as well
        for (std::size_t column = 0; column < kColumns; ++column)
          known[column] = light[f].usable[column] != 0 && usable_in(around, column) >= 3;
        for (std::size_t c = 0; c < 3; ++c) {
          const Columns expected = middle_of_columns(around, c);
          const Columns deviation = (light[f].light[c] - expected).max(-1.2f).min(1.2f);
          for (std::size_t column = 0; column < kColumns; ++column) {
            const auto u = static_cast<Eigen::Index>(column);
            const auto i = pixel_index(first, row, stack.size) + column;
            if (first + static_cast<int>(column) >= stack.size) continue;
            result[(f * texels + i) * 3 + c] = known[column] && expected[u] >= darkest
                                                   ? static_cast<std::int8_t>(std::lround(deviation[u] * 100))
                                                   : kUnknown;
          }
        }
      }
    }
  });
}

/// The deviation that nearly all frames agree on at each body pixel, in the channel where it is strongest; 0
/// where nothing is known. A highlight crosses a place of the body in some frames, a blemish is there in all.
std::vector<float> body_deviation(const RectifiedStack& stack, const Deviations& deviation, int size) {
  const std::size_t frames = stack.frames.size();
  const std::size_t texels = stack.points.size();
  // Where on the table a body direction is seen as it turns: through the map from normals across the axis to
  // texels.
  const AxisFrame axes(stack.axis);
  std::vector<std::int32_t> texel_of(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * 4, -1);
  const int fine = 2 * size;
  std::vector<float> nearest(texel_of.size(), std::numeric_limits<float>::infinity());
  const Vec2 at_start = direction_of(0);
  const std::size_t step = frame_step(frames);
  std::vector<Vec2> turned;
  for (const double angle : stack.angles) turned.push_back(direction_of(angle));
  for (std::size_t i = 0; i < texels; ++i) {
    if (!stack.points[i].visible || stack.points[i].normal.dot(stack.axis) <= 0) continue;
    const Vec2 p = pixel_of_disc(body_point(axes, stack.points[i].normal, at_start), fine);
    const auto right = static_cast<int>(std::lround(p.x()));
    const auto below = static_cast<int>(std::lround(p.y()));
    for (int y = std::max(0, below - 2); y < std::min(fine, below + 2); ++y) {
      for (int x = std::max(0, right - 2); x < std::min(fine, right + 2); ++x) {
        const auto slot = pixel_index(x, y, fine);
        const auto distance = static_cast<float>((p - Vec2(x + 0.5, y + 0.5)).squaredNorm());
        if (distance >= nearest[slot]) continue;
        nearest[slot] = distance;
        texel_of[slot] = static_cast<std::int32_t>(i);
      }
    }
  }
  std::vector<float> result(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), 0);
  parallel_for(size, [&](int y) {
    std::vector<float> seen[3];
    for (int x = 0; x < size; ++x) {
      const Vec2 disc = disc_of_pixel(x, y, size);
      if (disc.norm() >= 0.995) continue;
      for (auto& values : seen) values.clear();
      for (std::size_t f = 0; f < frames; f += step) {
        const Vec2& t = turned[f];
        const Vec2 p = pixel_of_disc(
            Vec2(t.x() * disc.x() - t.y() * disc.y(), t.y() * disc.x() + t.x() * disc.y()), fine);
        const auto at = static_cast<std::size_t>(std::min(fine - 1, static_cast<int>(p.y())) * fine +
                                                 std::min(fine - 1, static_cast<int>(p.x())));
        if (texel_of[at] < 0) continue;
        for (std::size_t channel = 0; channel < 3; ++channel) {
          const std::int8_t d =
              deviation[(f * texels + static_cast<std::size_t>(texel_of[at])) * 3 + channel];
          if (d != kUnknown) seen[channel].push_back(static_cast<float>(d) / 100);
        }
      }
      float strongest = 0;
      for (auto& values : seen) {
        if (values.size() * 4 * step < frames || values.size() < 6) continue;
        const auto quantile = [&](std::size_t quarters) {
          const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * quarters / 4);
          std::ranges::nth_element(values, at);
          return *at;
        };
        // The quantile on the side of 0 that a quarter of the frames may still fall short of.
        const float agreed = quantile(2) < 0 ? std::min(0.0f, quantile(3)) : std::max(0.0f, quantile(1));
        if (std::abs(agreed) > std::abs(strongest)) strongest = agreed;
      }
      result[pixel_index(x, y, size)] = strongest;
    }
  });
  return result;
}

std::size_t body_pixel(const Vec2& body, int size) {
  const Vec2 p = pixel_of_disc(body, size);
  const int x = std::clamp(static_cast<int>(p.x()), 0, size - 1);
  const int y = std::clamp(static_cast<int>(p.y()), 0, size - 1);
  return pixel_index(x, y, size);
}

/// Derives what follows from `masked`.
void finish(SurfaceMask& mask) {
  mask.excluded.resize(mask.masked.size());
  const cv::Mat core(mask.size, mask.size, CV_8U, mask.masked.data());
  const cv::Mat wider(mask.size, mask.size, CV_8U, mask.excluded.data());
  cv::dilate(core, wider, cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5}));
  double inside = 0;
  double masked = 0;
  for (int y = 0; y < mask.size; ++y) {
    for (int x = 0; x < mask.size; ++x) {
      if (disc_of_pixel(x, y, mask.size).norm() > 0.98) continue;
      ++inside;
      masked += mask.masked[pixel_index(x, y, mask.size)];
    }
  }
  mask.share = masked / inside;
}

}  // namespace

bool SurfaceMask::excludes(const Vec2& body) const {
  return size > 0 && excluded[body_pixel(body, size)] != 0;
}

bool SurfaceMask::masks(const Vec2& body) const {
  return size > 0 && masked[body_pixel(body, size)] != 0;
}

namespace {

SurfaceMask blemishes_of(const RectifiedStack& stack, const Deviations& deviations) {
  SurfaceMask mask;
  mask.size = stack.size;
  mask.deviation = body_deviation(stack, deviations, mask.size);

  mask.masked.assign(mask.deviation.size(), 0);
  const double high = 2 * kSmallest;
  const double low = kSmallest;

  // Hysteresis: a blemish has a strong core; its faint border belongs to it.
  cv::Mat weak(mask.size, mask.size, CV_8U);
  for (int y = 0; y < mask.size; ++y) {
    for (int x = 0; x < mask.size; ++x) {
      weak.at<std::uint8_t>(y, x) =
          static_cast<double>(std::abs(mask.deviation[pixel_index(x, y, mask.size)])) > low ? 1 : 0;
    }
  }
  cv::Mat labels;
  const int count = cv::connectedComponents(weak, labels);
  std::vector<int> core(static_cast<std::size_t>(count), 0);
  for (int y = 0; y < mask.size; ++y) {
    for (int x = 0; x < mask.size; ++x) {
      if (static_cast<double>(std::abs(mask.deviation[pixel_index(x, y, mask.size)])) > high) {
        ++core[static_cast<std::size_t>(labels.at<int>(y, x))];
      }
    }
  }
  cv::Mat chosen = cv::Mat::zeros(mask.size, mask.size, CV_8U);
  for (int y = 0; y < mask.size; ++y) {
    for (int x = 0; x < mask.size; ++x) {
      const int label = labels.at<int>(y, x);
      if (label > 0 && core[static_cast<std::size_t>(label)] >= 4) chosen.at<std::uint8_t>(y, x) = 1;
    }
  }
  for (std::size_t i = 0; i < mask.masked.size(); ++i) {
    mask.masked[i] =
        chosen.at<std::uint8_t>(static_cast<int>(i) / mask.size, static_cast<int>(i) % mask.size);
  }
  finish(mask);
  return mask;
}

}  // namespace

SurfaceMask find_blemishes(const RectifiedStack& stack, const SurfaceMask& already) {
  Deviations deviations;
  find_deviations(stack, already, deviations);
  SurfaceMask found = blemishes_of(stack, deviations);
  if (found.share == 0) return found;
  // Once more without what was found, so that it no longer pulls the medians.
  find_deviations(stack, united(already, found), deviations);
  return blemishes_of(stack, deviations);
}

SurfaceMask mask_from_painting(const Image& painting, const Camera& camera, const SphereView& sphere,
                               const Vec3& axis, double angle, int size) {
  SurfaceMask mask;
  mask.size = size;
  mask.masked.assign(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), 0);
  mask.deviation.assign(mask.masked.size(), 0);
  const AxisFrame axes(axis);
  const Mat3 turned = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vec2 disc = disc_of_pixel(x, y, size);
      if (disc.squaredNorm() >= 1) continue;
      const Vec3 body = disc.x() * axes.x + disc.y() * axes.y + std::sqrt(1 - disc.squaredNorm()) * axis;
      const Vec3 normal = turned * body;
      if (normal.dot(sphere.centre + normal) > 0) continue;
      const Vec2 p = camera.project(sphere.centre + normal);
      if (p.x() < 0 || p.y() < 0 || p.x() >= painting.width || p.y() >= painting.height) continue;
      const Vec3f paint = painting.rgb(static_cast<int>(p.x()), static_cast<int>(p.y()));
      mask.masked[pixel_index(x, y, size)] = paint.maxCoeff() > 0.2f ? 1 : 0;
    }
  }
  finish(mask);
  return mask;
}

SurfaceMask united(const SurfaceMask& a, const SurfaceMask& b) {
  if (a.size == 0) return b;
  if (b.size == 0) return a;
  SurfaceMask mask = a;
  for (int y = 0; y < a.size; ++y) {
    for (int x = 0; x < a.size; ++x) {
      if (b.masks(disc_of_pixel(x, y, a.size))) mask.masked[pixel_index(x, y, a.size)] = 1;
    }
  }
  finish(mask);
  return mask;
}

bool mask_direction(const SurfaceMask& mask, double& direction) {
  // The pole's direction is that of the masked area's axis: each pixel votes with its direction from the
  // middle.
  Vec2 sum(0, 0);
  double count = 0;
  for (int y = 0; y < mask.size; ++y) {
    for (int x = 0; x < mask.size; ++x) {
      const Vec2 disc = disc_of_pixel(x, y, mask.size);
      if (mask.masked[pixel_index(x, y, mask.size)] == 0 || disc.norm() < 0.05) continue;
      sum += disc.normalized();
      ++count;
    }
  }
  if (count < 4 || sum.norm() < 0.7 * count) return false;
  direction = std::atan2(sum.y(), sum.x());
  return true;
}

}  // namespace sateen::capture
