// SPDX-License-Identifier: MIT
#include "sateen/capture/turning/polar.h"

#include <algorithm>
#include <cmath>

#include "sateen/capture/turning/surface_patch.h"
#include "sateen/core/direction.h"
#include "sateen/core/median.h"
#include "sateen/core/parallel.h"

namespace sateen::capture {
namespace {

constexpr int kRings = 40;
constexpr int kBins = 720;  // angles of a polar picture
constexpr double kInnerRing = 0.1;
constexpr double kOuterRing = 0.97;

/// Correlation of unrelated surfaces: the peak of kBins tries among about that many times kRings / 6 free
/// values.
const double kChance = 3.3 / std::sqrt(kBins / 3.0 * kRings / 2.0);

/// Where in a patch each ring and angle about the axis lies; x < 0: outside.
std::vector<Vec2f> unrolled(int size, const Vec3& axis) {
  Vec3 e1;
  Vec3 e2;
  frame_around(axis, e1, e2);
  std::vector<Vec2f> places;
  for (int r = 0; r < kRings; ++r) {
    const double sine = kPatchReach * (kInnerRing + (kOuterRing - kInnerRing) * (r + 0.5) / kRings);
    for (int a = 0; a < kBins; ++a) {
      const double angle = 2 * kPi * a / kBins;
      const Vec3 normal =
          std::sqrt(1 - sine * sine) * axis + sine * (std::cos(angle) * e1 + std::sin(angle) * e2);
      const bool outside = normal.z() <= 0 || normal.head<2>().norm() > kPatchReach * kOuterRing;
      const Vec2 at = pixel_of_disc(normal.head<2>() / kPatchReach, size) - Vec2(0.5, 0.5);
      places.push_back(outside ? Vec2f(-1, -1) : at.cast<float>());
    }
  }
  return places;
}

/// Rows: rings from the axis outwards, each scaled by the square root of its length, zero mean; columns:
/// angles counter-clockwise.
cv::Mat polar(const cv::Mat& image, const std::vector<Vec2f>& places) {
  cv::Mat result(kRings, kBins, CV_32F);
  for (int r = 0; r < kRings; ++r) {
    auto* row = result.ptr<float>(r);
    const Vec2f* at = places.data() + static_cast<std::ptrdiff_t>(r) * kBins;
    float sum = 0;
    int inside = 0;
    for (int a = 0; a < kBins; ++a) {
      row[a] = 0;
      if (at[a].x() < 0) continue;
      const int x = std::min(static_cast<int>(at[a].x()), image.cols - 2);
      const int y = std::min(static_cast<int>(at[a].y()), image.rows - 2);
      const float fx = at[a].x() - static_cast<float>(x);
      const float fy = at[a].y() - static_cast<float>(y);
      const float* p = image.ptr<float>(y) + x;
      const float* q = image.ptr<float>(y + 1) + x;
      const float top = p[0] + fx * (p[1] - p[0]);
      row[a] = top + fy * (q[0] + fx * (q[1] - q[0]) - top);
      sum += row[a];
      ++inside;
    }
    if (inside == 0) continue;
    const float mean = sum / static_cast<float>(inside);
    const float scale = std::sqrt(static_cast<float>(r) + 4.5f);
    for (int a = 0; a < kBins; ++a) {
      if (at[a].x() >= 0) row[a] = (row[a] - mean) * scale;
    }
  }
  return result;
}

// Of a real signal the upper half of the frequencies mirrors the lower: spectra have kHalf columns.
constexpr int kHalf = kBins / 2 + 1;

cv::Mat half_spectrum(const cv::Mat& rows) {
  cv::Mat whole;
  cv::dft(rows, whole, cv::DFT_ROWS | cv::DFT_COMPLEX_OUTPUT);
  return whole.colRange(0, kHalf).clone();
}

/// Sum of the squares of the whole spectrum.
double power(const cv::Mat& half) {
  return 2 * cv::norm(half, cv::NORM_L2SQR) - cv::norm(half.col(0), cv::NORM_L2SQR) -
         cv::norm(half.col(kHalf - 1), cv::NORM_L2SQR);
}

PolarPeak correlate(const cv::Mat& turned, const cv::Mat& still) {
  cv::Mat product = cv::Mat::zeros(1, kBins, CV_32FC2);
  auto* sum = product.ptr<float>(0);
  for (int r = 0; r < turned.rows; ++r) {
    const auto* a = turned.ptr<float>(r);
    const auto* b = still.ptr<float>(r);
    for (int f = 0; f < 2 * kHalf; f += 2) {
      sum[f] += a[f] * b[f] + a[f + 1] * b[f + 1];
      sum[f + 1] += a[f + 1] * b[f] - a[f] * b[f + 1];
    }
  }
  for (int f = kHalf; f < kBins; ++f) {
    sum[2 * f] = sum[2 * (kBins - f)];
    sum[2 * f + 1] = -sum[2 * (kBins - f) + 1];
  }
  cv::Mat score;
  cv::dft(product, score, cv::DFT_INVERSE | cv::DFT_ROWS | cv::DFT_REAL_OUTPUT);
  const float* s = score.ptr<float>(0);
  const auto best = static_cast<int>(std::max_element(s, s + kBins) - s);
  const double left = static_cast<double>(s[(best + kBins - 1) % kBins]);
  const double middle = static_cast<double>(s[best]);
  const double right = static_cast<double>(s[(best + 1) % kBins]);
  const double curve = left - 2 * middle + right;
  const double offset = curve < 0 ? 0.5 * (left - right) / curve : 0;
  PolarPeak peak;
  peak.angle = 2 * kPi * (best + offset) / kBins;
  const double norms = std::sqrt(power(turned) * power(still));
  // Parseval: the inverse transform here is unscaled, as the norms of the spectra are.
  peak.height = norms > 0 ? middle / norms : 0;
  return peak;
}

/// Adds a spectrum turned back by `angle`: a shift is a phase for each frequency.
void add_turned_back(cv::Mat& sum, const cv::Mat& spectrum, double angle, float sign) {
  std::vector<Vec2f> phase(kHalf);
  for (int f = 0; f < kHalf; ++f) {
    const double p = f * angle;
    phase[static_cast<std::size_t>(f)] = sign * Vec2(std::cos(p), std::sin(p)).cast<float>();
  }
  for (int r = 0; r < kRings; ++r) {
    const auto* in = spectrum.ptr<Vec2f>(r);
    auto* out = sum.ptr<Vec2f>(r);
    for (std::size_t f = 0; f < kHalf; ++f) {
      out[f].x() += in[f].x() * phase[f].x() - in[f].y() * phase[f].y();
      out[f].y() += in[f].x() * phase[f].y() + in[f].y() * phase[f].x();
    }
  }
}

}  // namespace

PolarPictures::PolarPictures(const std::vector<cv::Mat>& images, const Vec3& axis) : spectra_(images.size()) {
  const std::vector<Vec2f> places = unrolled(images[0].cols, axis);
  parallel_for(static_cast<int>(images.size()), [&](int i) {
    const auto f = static_cast<std::size_t>(i);
    spectra_[f] = half_spectrum(polar(images[f], places));
  });
}

PolarPeak PolarPictures::between(std::size_t turned, std::size_t still) const {
  return correlate(spectra_[turned], spectra_[still]);
}

PolarTurning PolarPictures::chain() const {
  const std::size_t n = spectra_.size();
  PolarTurning turning;
  turning.angles.assign(n, 0);
  turning.confidence.assign(n, 0);
  cv::Mat surface = spectra_[0].clone();
  for (std::size_t i = 1; i < n; ++i) {
    turning.angles[i] = correlate(spectra_[i], surface).angle;
    add_turned_back(surface, spectra_[i], turning.angles[i], 1);
  }
  for (int round = 0; round < 2; ++round) {
    std::vector<PolarPeak> peaks(n);
    parallel_for(static_cast<int>(n), [&](int f) {
      const auto i = static_cast<std::size_t>(f);
      cv::Mat others = surface.clone();
      add_turned_back(others, spectra_[i], turning.angles[i], -1);
      peaks[i] = correlate(spectra_[i], others);
    });
    surface.setTo(0);
    for (std::size_t i = 0; i < n; ++i) {
      turning.angles[i] = peaks[i].angle;
      turning.confidence[i] = peaks[i].height;
      add_turned_back(surface, spectra_[i], peaks[i].angle, 1);
    }
  }
  turning.floor = kChance;
  return turning;
}

double PolarPictures::contradiction(const std::vector<double>& angles) const {
  const std::size_t n = spectra_.size();
  cv::Mat surface = cv::Mat::zeros(spectra_[0].size(), spectra_[0].type());
  for (std::size_t i = 0; i < n; ++i) add_turned_back(surface, spectra_[i], angles[i], 1);
  std::vector<double> apart(n);
  std::vector<double> heights(n);
  constexpr int kMiddle = kRings * 6 / 10;  // about as many pixels within as without
  parallel_for(static_cast<int>(n), [&](int f) {
    const auto i = static_cast<std::size_t>(f);
    cv::Mat others = surface.clone();
    add_turned_back(others, spectra_[i], angles[i], -1);
    for (const cv::Range& rings : {cv::Range(0, kMiddle), cv::Range(kMiddle, kRings)}) {
      const PolarPeak peak = correlate(spectra_[i].rowRange(rings), others.rowRange(rings));
      apart[i] = std::max(apart[i], std::abs(std::remainder(peak.angle - angles[i], 2 * kPi)));
      heights[i] += peak.height / 2;
    }
  });
  return median(heights) < 2 * kChance ? 0 : median(apart);
}

}  // namespace sateen::capture
