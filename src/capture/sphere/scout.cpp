// SPDX-License-Identifier: MIT
#include "sateen/capture/sphere/scout.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "sateen/core/error.h"
#include "sateen/core/median.h"
#include "sateen/core/parallel.h"

namespace sateen::capture {

namespace {

/// Every 7th pixel of every 7th row: enough for medians over a picture.
constexpr int kGrid = 7;

/// Gain of each frame's codes against the mean, as the median ratio over a grid, which the background
/// carries.
std::vector<float> gains(std::span<const GreyPicture> frames) {
  std::vector<std::size_t> grid;
  for (int y = 0; y < frames[0].height; y += kGrid) {
    for (int x = 0; x < frames[0].width; x += kGrid)
      grid.push_back(static_cast<std::size_t>(y * frames[0].width + x));
  }
  std::vector<float> mean(grid.size(), 0);
  for (const GreyPicture& frame : frames) {
    for (std::size_t i = 0; i < grid.size(); ++i)
      mean[i] += static_cast<float>(frame.codes[grid[i]]) / static_cast<float>(frames.size());
  }
  std::vector<float> result(frames.size(), 1);
  parallel_for(static_cast<int>(frames.size()), [&](int f) {
    const GreyPicture& frame = frames[static_cast<std::size_t>(f)];
    std::vector<float> ratios;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const int code = frame.codes[grid[i]];
      if (mean[i] > 20 && mean[i] < 245 && code < 250) ratios.push_back(static_cast<float>(code) / mean[i]);
    }
    if (ratios.size() < 50) return;
    result[static_cast<std::size_t>(f)] = middle_of(ratios);
  });
  return result;
}

void measure_activity(std::span<const GreyPicture> frames, Scouting& scouting) {
  const int width = frames[0].width;
  const int height = frames[0].height;
  const std::size_t pixels = frames[0].codes.size();
  scouting.width = width;
  scouting.height = height;
  scouting.mean.assign(pixels, 0);
  scouting.activity.assign(pixels, 0);
  scouting.gain = gains(frames);
  parallel_for(height, [&](int y) {
    const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    std::vector<float> sums(static_cast<std::size_t>(width), 0);
    std::vector<float> squares(sums.size(), 0);
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const std::uint8_t* codes = frames[f].codes.data() + row;
      const float scale = 1 / scouting.gain[f];
      for (std::size_t x = 0; x < sums.size(); ++x) {
        const float v = static_cast<float>(codes[x]) * scale;
        sums[x] += v;
        squares[x] += v * v;
      }
    }
    const auto n = static_cast<float>(frames.size());
    for (std::size_t x = 0; x < sums.size(); ++x) {
      const float mean = sums[x] / n;
      scouting.mean[row + x] = mean;
      scouting.activity[row + x] = std::sqrt(std::max(0.0f, squares[x] / n - mean * mean));
    }
  });
}

struct Circle {
  Vec2 centre{0, 0};
  double radius = 0;
  double support = 0;  ///< share of the directions in which the outline lies on the circle
};

Circle circle_through(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 ab = b - a;
  const Vec2 ac = c - a;
  const double cross = 2 * (ab.x() * ac.y() - ab.y() * ac.x());
  if (std::abs(cross) < 1e-9) return {};
  const Vec2 offset(ac.y() * ab.squaredNorm() - ab.y() * ac.squaredNorm(),
                    ab.x() * ac.squaredNorm() - ac.x() * ab.squaredNorm());
  return {a + offset / cross, (offset / cross).norm(), 0};
}

/// The circle on which most outline points lie: parts of an outline are hidden by a stand or joined to a
/// moving shadow, so every circle through three points 1/4 to 1/2 of the way round stands for election.
Circle vote_circle(const std::vector<Vec2>& outline) {
  Circle best;
  const std::size_t n = outline.size();
  const auto supporters = [&](const Circle& circle) {
    const double tolerance = std::max(1.5, 0.012 * circle.radius);
    return static_cast<double>(std::ranges::count_if(outline,
                                                     [&](const Vec2& p) {
                                                       return std::abs((p - circle.centre).norm() -
                                                                       circle.radius) < tolerance;
                                                     })) /
           static_cast<double>(n);
  };
  for (std::size_t start = 0; start < n; start += std::max<std::size_t>(1, n / 60)) {
    for (std::size_t step = n / 8; step <= n / 3; step += std::max<std::size_t>(1, n / 24)) {
      Circle circle =
          circle_through(outline[start], outline[(start + step) % n], outline[(start + 2 * step) % n]);
      if (circle.radius <= 0) continue;
      circle.support = supporters(circle);
      if (circle.support > best.support) best = circle;
    }
  }
  return best;
}

struct Blob {
  Circle circle;
  double area = 0;
  double filled = 0;  ///< share of the circle's area (inside the picture) that is active
};

/// The round active areas, largest first.
std::vector<Blob> active_blobs(const Scouting& s, double threshold) {
  const int width = s.width;
  const int height = s.height;
  cv::Mat mask(height, width, CV_8U);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      mask.at<std::uint8_t>(y, x) = s.activity[pixel_index(x, y, width)] > threshold ? 255 : 0;
    }
  }
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5});
  cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, disc);
  cv::morphologyEx(mask, mask, cv::MORPH_OPEN, disc);
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centroids;
  const int count = cv::connectedComponentsWithStats(mask, labels, stats, centroids);
  std::vector<Blob> blobs;
  for (int label = 1; label < count; ++label) {
    const int left = stats.at<int>(label, cv::CC_STAT_LEFT);
    const int top = stats.at<int>(label, cv::CC_STAT_TOP);
    const int w = stats.at<int>(label, cv::CC_STAT_WIDTH);
    const int h = stats.at<int>(label, cv::CC_STAT_HEIGHT);
    if (std::max(w, h) < std::max(16, std::min(width, height) / 30)) continue;
    const Vec2 middle(left + w / 2.0, top + h / 2.0);
    std::vector<Vec2> outline;
    for (int i = 0; i < 360; ++i) {
      const Vec2 out(std::cos(radians(i)), std::sin(radians(i)));
      for (int halves = static_cast<int>(std::hypot(w, h)) + 2; halves > 4; --halves) {
        const Vec2 p = middle + 0.5 * halves * out;
        const int x = static_cast<int>(std::floor(p.x()));
        const int y = static_cast<int>(std::floor(p.y()));
        if (x < 0 || y < 0 || x >= width || y >= height || labels.at<int>(y, x) != label) continue;
        // Points on the picture's own edge are where the sphere is cut, not where it ends.
        if (x > 0 && y > 0 && x < width - 1 && y < height - 1) outline.push_back(p);
        break;
      }
    }
    if (outline.size() < 60) continue;
    Blob blob;
    blob.circle = vote_circle(outline);
    blob.circle.support *= static_cast<double>(outline.size()) / 360;
    if (blob.circle.radius < 5 || blob.circle.radius > 0.6 * std::max(width, height)) continue;
    double inside = 0;
    double active = 0;
    const Vec2& c = blob.circle.centre;
    const double r = blob.circle.radius;
    for (int y = std::max(0, static_cast<int>(c.y() - r)); y < std::min<double>(height, c.y() + r); ++y) {
      for (int x = std::max(0, static_cast<int>(c.x() - r)); x < std::min<double>(width, c.x() + r); ++x) {
        if ((Vec2(x + 0.5, y + 0.5) - c).squaredNorm() > r * r) continue;
        ++inside;
        active += mask.at<std::uint8_t>(y, x) != 0 ? 1 : 0;
      }
    }
    blob.area = kPi * blob.circle.radius * blob.circle.radius;
    blob.filled = inside > 0 ? active / inside : 0;
    blobs.push_back(blob);
  }
  std::ranges::sort(blobs, std::greater{}, &Blob::area);
  return blobs;
}

/// What phase correlation needs of a frame: half its size, the background's detail alone.
cv::Mat background_detail(const GreyPicture& picture, const std::vector<Circle>& spheres) {
  cv::Mat full(picture.height, picture.width, CV_8U, const_cast<std::uint8_t*>(picture.codes.data()));
  cv::Mat image;
  cv::resize(full, image, {}, 0.5, 0.5, cv::INTER_AREA);
  image.convertTo(image, CV_32F);
  cv::Mat smooth;
  cv::blur(image, smooth, {31, 31});
  image -= smooth;
  // What turns must not vote: it is faded out softly, so that its edge does not vote for standing still.
  for (const Circle& sphere : spheres) {
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) {
        const double r = (Vec2(2 * x + 1, 2 * y + 1) - sphere.centre).norm() / sphere.radius;
        image.at<float>(y, x) *= static_cast<float>(std::clamp((r - 1.1) * 4, 0.0, 1.0));
      }
    }
  }
  return image;
}

/// Translation between two background_detail, pixels of the frames.
double background_motion(const cv::Mat& first, const cv::Mat& second) {
  double response = 0;
  const cv::Point2d shift = cv::phaseCorrelate(first, second, cv::noArray(), &response);
  return response > 0.05 ? 2 * std::hypot(shift.x, shift.y) : 0;
}

void check_camera(std::span<const GreyPicture> frames, int factor, const std::vector<Circle>& spheres) {
  const std::size_t n = frames.size();
  constexpr std::size_t kCompared = 4;
  std::array<cv::Mat, kCompared + 1> details;
  const auto frame_of = [&](std::size_t i) { return i * (n - 1) / kCompared; };
  parallel_for(static_cast<int>(details.size()), [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    details[at] = background_detail(frames[frame_of(at)], spheres);
  });
  std::size_t last_still = 0;
  for (std::size_t i = 1; i <= kCompared; ++i) {
    const std::size_t f = frame_of(i);
    const double moved = background_motion(details[0], details[i]);
    if (moved > 1.5) {
      throw Error(fmt::format(
          "the camera moved by about {:.1f} pixels between {:.0f} % and {:.0f} % of the sequence; fix camera "
          "and stand and shoot again",
          moved * factor, 100.0 * static_cast<double>(last_still) / static_cast<double>(n - 1),
          100.0 * static_cast<double>(f) / static_cast<double>(n - 1)));
    }
    last_still = f;
  }
}

}  // namespace

Scouting find_sphere(std::span<const GreyPicture> frames, int factor) {
  Scouting s;
  measure_activity(frames, s);

  std::vector<float> sorted;
  for (std::size_t i = 0; i < s.activity.size(); i += kGrid) sorted.push_back(s.activity[i]);
  const auto low = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 10);
  std::ranges::nth_element(sorted, low);
  s.noise = std::max(0.3, 1.25 * static_cast<double>(*low));

  // A weak turning surface first drowns under a high threshold, a strong one merges with its own moving
  // shadow under a low one: the threshold with the best circle wins.
  Blob best;
  std::vector<Blob> others;
  // Noise that hides the weak parts hides faint shadows as well: only then it pays to go closer to it.
  std::vector<double> thresholds{4, 7, 12};
  if (s.noise > 1.5) thresholds.insert(thresholds.begin(), 2);
  std::vector<std::vector<Blob>> blobs_at(thresholds.size());
  parallel_for(static_cast<int>(thresholds.size()), [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    blobs_at[at] = active_blobs(s, thresholds[at] * s.noise);
  });
  for (const std::vector<Blob>& blobs : blobs_at) {
    for (const Blob& blob : blobs) {
      const bool round = blob.circle.support > 0.4 && blob.filled > 0.35;
      const double score = blob.circle.support * std::sqrt(blob.area);
      if (round && score > best.circle.support * std::sqrt(best.area) * 1.02) {
        best = blob;
        others = blobs;
      }
    }
  }
  if (best.area <= 0) {
    check_camera(frames, factor, {});
    throw Error(
        "no sphere found: nothing round changes between the frames. The sphere has to turn while camera, "
        "lamps and "
        "background stand still, and fill at least a twentieth of the picture's height");
  }
  std::vector<Circle> spheres{best.circle};
  for (const Blob& other : others) {
    const bool apart =
        (other.circle.centre - best.circle.centre).norm() > other.circle.radius + 0.8 * best.circle.radius;
    if (apart && other.circle.support > 0.5 && other.filled > 0.5 && other.area > 0.1 * best.area) {
      spheres.push_back(other.circle);
    }
  }
  check_camera(frames, factor, spheres);
  if (spheres.size() > 1) {
    const Vec2 first = factor * spheres[0].centre;
    const Vec2 second = factor * spheres[1].centre;
    throw Error(
        fmt::format("two turning spheres found, at ({:.0f}, {:.0f}) and ({:.0f}, {:.0f}); cover or crop one",
                    first.x(), first.y(), second.x(), second.y()));
  }
  const Vec2& c = best.circle.centre;
  const double r = best.circle.radius;
  if (c.x() - r < -1 || c.y() - r < -1 || c.x() + r > s.width + 1 || c.y() + r > s.height + 1) {
    throw Error(
        fmt::format("the sphere (centre ({:.0f}, {:.0f}), radius {:.0f} of a picture of {} x {}) is cut by "
                    "the picture's edge; the "
                    "whole outline has to be visible",
                    factor * c.x(), factor * c.y(), factor * r, factor * s.width, factor * s.height));
  }
  s.centre = c;
  s.radius = r;
  return s;
}

}  // namespace sateen::capture
