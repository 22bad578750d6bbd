// SPDX-License-Identifier: MIT
#include "sateen/capture/surface_mask.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "sateen/core/direction.h"
#include "sateen/core/parallel.h"

namespace sateen {
namespace {

constexpr double kNear = 0.06;   // radians: neighbours closer than this may still show the blemish itself
constexpr double kFar = 0.40;    // radians: beyond, the shading has changed
constexpr double kSmallest = 0.12;  // log light: below this it is the material's own unevenness

double median(std::vector<float>& values) {
  const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, half);
  return static_cast<double>(*half);
}

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

struct Accumulator {
  std::vector<std::array<float, 3>> sum;
  std::vector<float> count;
};

/// Body pixels around a body point and their bilinear shares.
template <class Body>
void splat(int size, const Vec2& body, Body add) {
  const Vec2 at = pixel_of_disc(body, size) - Vec2(0.5, 0.5);
  const int x0 = static_cast<int>(std::floor(at.x()));
  const int y0 = static_cast<int>(std::floor(at.y()));
  const double fx = at.x() - x0;
  const double fy = at.y() - y0;
  for (int v = 0; v < 2; ++v) {
    for (int u = 0; u < 2; ++u) {
      const int x = x0 + u;
      const int y = y0 + v;
      if (x < 0 || y < 0 || x >= size || y >= size) continue;
      add(static_cast<std::size_t>(y * size + x), static_cast<float>((u != 0 ? fx : 1 - fx) * (v != 0 ? fy : 1 - fy)));
    }
  }
}

/// Mean deviation of each body pixel, in the channel where it is largest, signed; 0 where nothing is known.
std::vector<float> body_deviation(const RectifiedStack& stack, const SurfaceMask& already, int size) {
  const int texels = stack.size;
  const std::size_t frames = stack.frames.size();
  const auto body_pixels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  const AxisFrame axes(stack.axis);
  const float dark = dark_floor(stack);
  constexpr int kStrips = 8;  // partial sums, the same whatever the number of threads
  std::vector<Accumulator> strips(kStrips);
  parallel_for(kStrips, [&](int strip) {
    Accumulator& out = strips[static_cast<std::size_t>(strip)];
    out.sum.assign(body_pixels, {0, 0, 0});
    out.count.assign(body_pixels, 0);
    std::vector<std::array<float, 3>> light(frames);
    std::vector<std::uint8_t> usable(frames);
    std::vector<Vec2> bodies(frames);
    std::vector<float> around;
    for (int y = strip; y < texels; y += kStrips) {
      for (int x = 0; x < texels; ++x) {
        const auto i = static_cast<std::size_t>(y * texels + x);
        const SeenPoint& point = stack.points[i];
        if (!point.visible) continue;
        for (std::size_t f = 0; f < frames; ++f) {
          const RectifiedFrame& frame = stack.frames[f];
          bodies[f] = body_point(axes, point.normal, stack.angles[f]);
          usable[f] = frame.weight[i] > 127 ? 1 : 0;
          if (usable[f] != 0 && already.size > 0 && already.excludes(bodies[f])) usable[f] = 2;
          for (std::size_t c = 0; c < 3; ++c) {
            light[f][c] = std::log(std::max(0.0f, static_cast<float>(frame.rgb[i * 3 + c])) + dark);
          }
        }
        for (std::size_t f = 0; f < frames; ++f) {
          if (usable[f] == 0) continue;
          std::array<float, 3> deviation{};
          bool known = true;
          for (std::size_t c = 0; c < 3 && known; ++c) {
            around.clear();
            for (std::size_t step = 1; step < frames; ++step) {
              bool inside = false;
              for (const std::size_t g : {(f + step) % frames, (f + frames - step) % frames}) {
                const double apart = std::abs(std::remainder(stack.angles[g] - stack.angles[f], 2 * kPi));
                inside = inside || apart < kFar;
                if (apart > kNear && apart < kFar && usable[g] == 1) around.push_back(light[g][c]);
              }
              if (!inside) break;
            }
            known = around.size() >= 4;
            if (known) deviation[c] = std::clamp(light[f][c] - static_cast<float>(median(around)), -1.0f, 1.0f);
          }
          if (!known) continue;
          splat(size, bodies[f], [&](std::size_t at, float share) {
            for (std::size_t c = 0; c < 3; ++c) out.sum[at][c] += share * deviation[c];
            out.count[at] += share;
          });
        }
      }
    }
  });
  std::vector<float> result(body_pixels, 0);
  for (std::size_t i = 0; i < body_pixels; ++i) {
    std::array<float, 3> sum{0, 0, 0};
    float count = 0;
    for (const Accumulator& strip : strips) {
      for (std::size_t c = 0; c < 3; ++c) sum[c] += strip.sum[i][c];
      count += strip.count[i];
    }
    if (count < 2) continue;
    const float strongest = *std::ranges::max_element(sum, {}, [](float v) { return std::abs(v); });
    result[i] = strongest / count;
  }
  return result;
}

/// Each ring's own median is shading that the medians over angles did not follow: the same all the way round.
void remove_rings(std::vector<float>& deviation, int size) {
  const auto rings = static_cast<std::size_t>(size / 4);
  std::vector<std::vector<float>> ring(rings + 1);
  const auto ring_of = [&](int x, int y) {
    return std::min(rings, static_cast<std::size_t>(disc_of_pixel(x, y, size).norm() * static_cast<double>(rings)));
  };
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const float d = deviation[static_cast<std::size_t>(y * size + x)];
      if (d != 0) ring[ring_of(x, y)].push_back(d);
    }
  }
  std::vector<float> middle(rings + 1, 0);
  for (std::size_t r = 0; r <= rings; ++r) {
    if (ring[r].size() > 8) middle[r] = static_cast<float>(median(ring[r]));
  }
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      float& d = deviation[static_cast<std::size_t>(y * size + x)];
      if (d != 0) d -= middle[ring_of(x, y)];
    }
  }
}

std::size_t body_pixel(const Vec2& body, int size) {
  const Vec2 p = pixel_of_disc(body, size);
  const int x = std::clamp(static_cast<int>(p.x()), 0, size - 1);
  const int y = std::clamp(static_cast<int>(p.y()), 0, size - 1);
  return static_cast<std::size_t>(y * size + x);
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
      masked += mask.masked[static_cast<std::size_t>(y * mask.size + x)];
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

SurfaceMask find_blemishes(const RectifiedStack& stack, const SurfaceMask& already) {
  SurfaceMask mask;
  mask.size = stack.size;
  mask.deviation = body_deviation(stack, already, mask.size);
  remove_rings(mask.deviation, mask.size);

  std::vector<float> strengths;
  for (const float d : mask.deviation) {
    if (d != 0) strengths.push_back(std::abs(d));
  }
  mask.masked.assign(mask.deviation.size(), 0);
  mask.excluded = mask.masked;
  if (strengths.size() < 50) return mask;
  const double sigma = 1.4826 * median(strengths);
  const double high = std::max(2 * kSmallest, 7 * sigma);
  const double low = std::max(kSmallest, 3.5 * sigma);

  // Hysteresis: a blemish has a strong core; its faint border belongs to it.
  cv::Mat weak(mask.size, mask.size, CV_8U);
  for (int y = 0; y < mask.size; ++y) {
    for (int x = 0; x < mask.size; ++x) {
      weak.at<std::uint8_t>(y, x) =
          static_cast<double>(std::abs(mask.deviation[static_cast<std::size_t>(y * mask.size + x)])) > low ? 1 : 0;
    }
  }
  cv::Mat labels;
  const int count = cv::connectedComponents(weak, labels);
  std::vector<int> core(static_cast<std::size_t>(count), 0);
  for (int y = 0; y < mask.size; ++y) {
    for (int x = 0; x < mask.size; ++x) {
      if (static_cast<double>(std::abs(mask.deviation[static_cast<std::size_t>(y * mask.size + x)])) > high) {
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
    mask.masked[i] = chosen.at<std::uint8_t>(static_cast<int>(i) / mask.size, static_cast<int>(i) % mask.size);
  }
  finish(mask);
  return mask;
}

SurfaceMask mask_from_painting(const Image& painting, const Camera& camera, const SphereView& sphere, const Vec3& axis,
                               double angle, int size) {
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
      mask.masked[static_cast<std::size_t>(y * size + x)] = paint.maxCoeff() > 0.2f ? 1 : 0;
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
      if (b.masks(disc_of_pixel(x, y, a.size))) mask.masked[static_cast<std::size_t>(y * a.size + x)] = 1;
    }
  }
  finish(mask);
  return mask;
}

bool mask_direction(const SurfaceMask& mask, double& direction) {
  // The pole's direction is that of the masked area's axis: each pixel votes with its direction from the middle.
  Vec2 sum(0, 0);
  double count = 0;
  for (int y = 0; y < mask.size; ++y) {
    for (int x = 0; x < mask.size; ++x) {
      const Vec2 disc = disc_of_pixel(x, y, mask.size);
      if (mask.masked[static_cast<std::size_t>(y * mask.size + x)] == 0 || disc.norm() < 0.05) continue;
      sum += disc.normalized();
      ++count;
    }
  }
  if (count < 4 || sum.norm() < 0.7 * count) return false;
  direction = std::atan2(sum.y(), sum.x());
  return true;
}

}  // namespace sateen
