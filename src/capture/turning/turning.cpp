// SPDX-License-Identifier: MIT
#include "sateen/capture/turning/turning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <opencv2/imgproc.hpp>

#include "sateen/capture/turning/polar.h"
#include "sateen/capture/turning/sphere_registration.h"
#include "sateen/core/direction.h"
#include "sateen/core/median.h"
#include "sateen/core/parallel.h"

namespace sateen::capture {
namespace {

constexpr double kPairTurn = radians(12);  // apart enough to show the axis, near enough to look alike
constexpr int kPairs = 32;
constexpr double kFollowed = 2;  // correlation, in those that chance reaches, that can be trusted
constexpr double kNoisy = 4;     // correlation, in those that chance reaches, below which smoothing pays
constexpr std::array kRounds{true, true, false};  // of refinement: the quick ones first
constexpr double kOffMiddle = radians(0.8);       // an axis nearer to the middle is found from there as well

std::vector<cv::Mat> smoothed(const std::vector<cv::Mat>& images, const std::vector<std::size_t>& wanted,
                              double sigma) {
  std::vector<cv::Mat> result(images.size());
  parallel_for(static_cast<int>(wanted.size()), [&](int i) {
    const std::size_t f = wanted[static_cast<std::size_t>(i)];
    cv::GaussianBlur(images[f], result[f], {}, sigma);
  });
  return result;
}

/// The axis about which frames some degrees apart turn: the direction of the rotation between them, which
/// needs no axis to start with as long as the turn is small. The median over many pairs. `about_middle` may
/// be off by as much as the axis is.
Vec3 axis_of_neighbours(const std::vector<cv::Mat>& images, const PolarPictures& polar,
                        const std::vector<double>& about_middle) {
  const std::size_t n = images.size();
  std::vector<std::array<std::size_t, 2>> pairs;
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < n; i += std::max<std::size_t>(1, n / kPairs)) {
    std::size_t best = i;
    double best_off = radians(8);
    for (std::size_t j = 0; j < n; ++j) {
      const double apart = std::abs(std::remainder(about_middle[j] - about_middle[i], 2 * kPi));
      if (j != i && std::abs(apart - kPairTurn) < best_off) {
        best_off = std::abs(apart - kPairTurn);
        best = j;
      }
    }
    if (best == i) continue;
    pairs.push_back({i, best});
    wanted.insert(wanted.end(), {i, best});
  }
  if (pairs.size() < 6) return Vec3::UnitZ();
  std::ranges::sort(wanted);
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  const PatchNormals some(images[0].cols, 2);
  const PatchNormals few(images[0].cols, 4);
  const std::vector<cv::Mat> soft = smoothed(images, wanted, images[0].cols / 80.0);
  std::vector<Vec2> tilts(pairs.size(), Vec2(0, 0));
  std::vector<double> trust(pairs.size(), 0);
  parallel_for(static_cast<int>(pairs.size()), [&](int i) {
    const auto [still, turned] = pairs[static_cast<std::size_t>(i)];
    const double angle = std::remainder(polar.between(turned, still).angle, 2 * kPi);
    Mat3 rotation = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
    const SurfacePicture coarse(soft[still]);
    const SurfacePicture fine(images[still]);
    BodyRotation step;
    // A first guess for TurningRefinement: a part of the pixels will do.
    for (int round = 0; round < 8; ++round) {
      step = round < 5 ? register_frame(few, coarse, soft[turned], rotation)
                       : register_frame(some, fine, images[turned], rotation);
      const double size = step.rotation.norm();
      if (size > radians(4)) return;
      if (size > 0) {
        rotation = rotation * Eigen::AngleAxisd(size, step.rotation / size).toRotationMatrix();
      }
    }
    const Eigen::AngleAxisd found(rotation);
    const Vec3 axis = found.axis().z() < 0 ? Vec3(-found.axis()) : found.axis();
    if (found.angle() < radians(3) || axis.z() < 0.8) return;
    tilts[static_cast<std::size_t>(i)] = axis.head<2>();
    trust[static_cast<std::size_t>(i)] = step.correlation;
  });
  // The half of the pairs that agree best with each other's surface speaks.
  const double least = std::max(0.02, median(trust));
  std::vector<double> x;
  std::vector<double> y;
  for (std::size_t i = 0; i < tilts.size(); ++i) {
    if (trust[i] < least) continue;
    x.push_back(tilts[i].x());
    y.push_back(tilts[i].y());
  }
  if (x.size() < 4) return Vec3::UnitZ();
  const Vec2 tilt(median(x), median(y));
  return Vec3(tilt.x(), tilt.y(), std::sqrt(1 - std::min(0.5, tilt.squaredNorm()))).normalized();
}

/// Registered about `axis` (patch frame), then with the axis free.
Turning turning_about(const std::vector<cv::Mat>& images, const PolarTurning& start, const Vec3& axis) {
  Turning turning;
  turning.axis = axis;
  turning.angles = start.angles;
  const TurningRefinement refinement(images);
  for (const bool quick : kRounds) refinement.round(true, quick, turning);
  return turning;
}

/// PolarPictures::contradiction, which as a median needs no more than some of the frames.
double contradiction_of(const std::vector<cv::Mat>& images, const Turning& turning) {
  constexpr std::size_t kEnough = 32;
  const std::size_t step = std::max<std::size_t>(1, images.size() / kEnough);
  std::vector<cv::Mat> some;
  std::vector<double> angles;
  for (std::size_t i = 0; i < images.size(); i += step) {
    some.push_back(images[i]);
    angles.push_back(turning.angles[i]);
  }
  return PolarPictures(some, turning.axis).contradiction(angles);
}

/// Sets `known_off` and `reversed_off`.
void compare_known(const PolarTurning& seen, const std::vector<double>& known, Turning& turning) {
  if (median(seen.confidence) < kFollowed * seen.floor) return;
  std::vector<double> off;
  std::vector<double> reversed;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const double turned = known[i] - known[0];
    off.push_back(std::abs(std::remainder(seen.angles[i] - seen.angles[0] - turned, 2 * kPi)));
    reversed.push_back(std::abs(std::remainder(seen.angles[i] - seen.angles[0] + turned, 2 * kPi)));
  }
  turning.known_off = median(off);
  turning.reversed_off = median(reversed);
}

/// From the patches' frame to the view, angles from the first frame.
void to_view(const Mat3& axes, Turning& turning) {
  turning.axis = axes.transpose() * turning.axis;
  const double first = turning.angles[0];
  for (double& angle : turning.angles) angle = wrap(angle - first, 2 * kPi);
}

}  // namespace

Turning find_turning(std::span<const SurfacePatch> patches, const Mat3& axes) {
  std::vector<cv::Mat> images = moving_detail(patches);
  PolarPictures middle(images, Vec3::UnitZ());
  PolarTurning start = middle.chain();
  if (median(start.confidence) < kNoisy * start.floor) {
    // Sensor noise is finer than what the lens shows of the surface.
    std::vector<std::size_t> all(images.size());
    std::iota(all.begin(), all.end(), 0);
    images = smoothed(images, all, images[0].cols / 150.0);
    middle = PolarPictures(images, Vec3::UnitZ());
    start = middle.chain();
  }
  Turning turning = turning_about(images, start, Vec3::UnitZ());
  const Vec3 other = axis_of_neighbours(images, middle, start.angles);
  if (std::acos(std::min(1.0, other.dot(turning.axis))) > kOffMiddle) {
    // The detail that all frames share decides which of the two it is.
    const PolarTurning about = PolarPictures(images, other).chain();
    const Turning tilted = turning_about(images, about, other);
    if (median(tilted.confidence) > median(turning.confidence)) {
      turning = tilted;
      start = about;
    }
  }
  turning.contradiction = contradiction_of(images, turning);
  turning.confidence = start.confidence;
  turning.confidence_floor = start.floor;
  to_view(axes, turning);
  return turning;
}

Turning find_axis(std::span<const SurfacePatch> patches, const Mat3& axes, std::span<const double> angles) {
  const std::vector<cv::Mat> images = moving_detail(patches);
  const TurningRefinement refinement(images);
  const std::vector<double> known(angles.begin(), angles.end());
  const auto from = [&](const Vec3& axis) {
    Turning turning;
    turning.axis = axis;
    turning.angles = known;
    for (const bool quick : kRounds) refinement.round(false, quick, turning);
    return turning;
  };
  Turning turning = from(Vec3::UnitZ());
  const PolarPictures middle(images, Vec3::UnitZ());
  const Vec3 other = axis_of_neighbours(images, middle, known);
  if (std::acos(std::min(1.0, other.dot(turning.axis))) > kOffMiddle) {
    const Turning tilted = from(other);
    if (median(tilted.confidence) > median(turning.confidence)) turning = tilted;
  }
  compare_known(middle.chain(), known, turning);
  turning.contradiction = contradiction_of(images, turning);
  to_view(axes, turning);
  return turning;
}

}  // namespace sateen::capture
