// SPDX-License-Identifier: MIT
#include "sateen/capture/sphere/stand.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "sateen/core/median.h"

namespace sateen::capture {
namespace {

constexpr double kStandContrast = 8;    // codes
constexpr double kLargestStand = 0.25;  // share of the sphere's picture

/// 1 where a pixel inside `radius` hardly changes: the mean square over it and its neighbours, as one pixel
/// alone may be quiet or loud by chance. How loud noise is depends on how bright a pixel is as well.
cv::Mat quiet_pixels(const FirstLook& look, double radius) {
  constexpr double kQuiet = 1.8;  // times the noise
  const int width = look.scouting.width;
  const int height = look.scouting.height;
  const cv::Mat activity(height, width, CV_32F, const_cast<float*>(look.scouting.activity.data()));
  cv::Mat squares;
  cv::sqrBoxFilter(activity, squares, CV_32F, {3, 3});
  cv::Mat quiet = cv::Mat::zeros(height, width, CV_8U);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if ((Vec2(x + 0.5, y + 0.5) - look.centre).norm() > radius) continue;
      const double loudness = std::sqrt(static_cast<double>(squares.at<float>(y, x)));
      if (loudness < kQuiet * look.scouting.noise) quiet.at<std::uint8_t>(y, x) = 1;
    }
  }
  return quiet;
}

/// How sharply the mean picture changes, in codes, across each component's border inside `radius`: the shade
/// of plain cloth goes over into what is around it, a stand ends. Median over the border.
std::vector<double> border_contrast(const FirstLook& look, const cv::Mat& labels, int count, double radius) {
  std::vector<std::vector<float>> steps(static_cast<std::size_t>(count));
  const auto mean = [&](int x, int y) { return look.scouting.mean[pixel_index(x, y, labels.cols)]; };
  for (int y = 4; y + 4 < labels.rows; ++y) {
    for (int x = 4; x + 4 < labels.cols; ++x) {
      const int label = labels.at<int>(y, x);
      if (label == 0 || (Vec2(x + 0.5, y + 0.5) - look.centre).norm() > radius) continue;
      for (const auto& [u, v] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        if (labels.at<int>(y + v, x + u) != 0) continue;
        steps[static_cast<std::size_t>(label)].push_back(
            std::abs(mean(x + 4 * u, y + 4 * v) - mean(x - u, y - v)));
      }
    }
  }
  std::vector<double> result;
  result.reserve(steps.size());
  for (const std::vector<float>& values : steps) result.push_back(values.empty() ? 0 : median(values));
  return result;
}

}  // namespace

StandInFront find_stand(const FirstLook& look) {
  // Further out the wobbling outline passes.
  const double inner = look.outline.radius - look.reach - 2.5;
  const cv::Mat quiet = quiet_pixels(look, inner);
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centroids;
  const int count = cv::connectedComponentsWithStats(quiet, labels, stats, centroids, 4);
  const std::vector<double> contrast = border_contrast(look, labels, count, inner - 4);
  std::vector<std::uint8_t> reaches_in(static_cast<std::size_t>(count), 0);
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      const int label = labels.at<int>(y, x);
      if (label > 0 && (Vec2(x + 0.5, y + 0.5) - look.centre).norm() > inner - 3)
        reaches_in[static_cast<std::size_t>(label)] = 1;
    }
  }
  cv::Mat chosen = cv::Mat::zeros(quiet.size(), CV_8U);
  double area = 0;
  const double whole = kPi * look.outline.radius * look.outline.radius;
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      const int label = labels.at<int>(y, x);
      if (label == 0 || reaches_in[static_cast<std::size_t>(label)] == 0) continue;
      if (stats.at<int>(label, cv::CC_STAT_AREA) < 0.0003 * whole) continue;
      if (contrast[static_cast<std::size_t>(label)] < kStandContrast) continue;
      chosen.at<std::uint8_t>(y, x) = 1;
      ++area;
    }
  }
  StandInFront stand;
  stand.share = area / whole;
  if (area == 0 || stand.share > kLargestStand) return stand;
  // Its edge is blurred; and it goes on beyond the outline, where the background stands still as well.
  cv::dilate(chosen, chosen, cv::getStructuringElement(cv::MORPH_ELLIPSE, {7, 7}));
  const cv::Mat inside = chosen.clone();
  for (int y = 0; y < chosen.rows; ++y) {
    for (int x = 0; x < chosen.cols; ++x) {
      const Vec2 from(x + 0.5 - look.centre.x(), y + 0.5 - look.centre.y());
      const double r = from.norm();
      if (r <= inner - 1 || r > look.outline.radius + look.reach + 3) continue;
      const Vec2 back = look.centre + from * ((inner - 1) / r);
      if (inside.at<std::uint8_t>(static_cast<int>(back.y()), static_cast<int>(back.x())) != 0)
        chosen.at<std::uint8_t>(y, x) = 1;
    }
  }
  stand.mask.width = chosen.cols;
  stand.mask.height = chosen.rows;
  stand.mask.factor = look.factor;
  stand.mask.still.assign(chosen.datastart, chosen.dataend);
  return stand;
}

std::vector<std::string> advice(const StandInFront& stand) {
  if (stand.share > kLargestStand) {
    return {fmt::format(
        "{:.0f} % of the sphere hardly changes as it turns: it is plain there, very dark, or covered",
        100 * stand.share)};
  }
  if (stand.share > 0.002) {
    return {
        fmt::format("{:.1f} % of the sphere stands still, as behind a stand, and was filled from its "
                    "neighbours: keep the front clear",
                    100 * stand.share)};
  }
  return {};
}

}  // namespace sateen::capture
