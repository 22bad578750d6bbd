// SPDX-License-Identifier: MIT
#include "sateen/amc/symmetry.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sateen/amc/resample.h"
#include "sateen/core/disc.h"
#include "sateen/core/error.h"
#include "sateen/core/parallel.h"

namespace sateen::amc {
namespace {

std::vector<double> angles_of(std::span<const AmcFrame> frames) {
  std::vector<double> angles;
  for (const AmcFrame& frame : frames) angles.push_back(frame.angle);
  return angles;
}

std::vector<int> disc_pixels(int size) {
  std::vector<int> pixels;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      if (inside_disc(x, y, size)) pixels.push_back(y * size + x);
    }
  }
  if (pixels.empty()) pixels.push_back(0);
  return pixels;
}

double peak_of(std::span<const AmcFrame> frames, const std::vector<int>& pixels) {
  std::vector<float> brightest;
  brightest.reserve(frames.size() * pixels.size());
  for (const AmcFrame& frame : frames) {
    for (const int pixel : pixels) {
      const float* p = frame.image.data.data() + static_cast<std::size_t>(pixel) * 3;
      brightest.push_back(std::max({p[0], p[1], p[2]}));
    }
  }
  const auto nth =
      brightest.begin() + static_cast<std::ptrdiff_t>(static_cast<double>(brightest.size() - 1) * 0.999);
  std::ranges::nth_element(brightest, nth);
  return *nth;
}

/// Mean square of frame(i) minus a weighted sum of frames, over all i, disc pixels and channels.
template <class WeightsOf>
double mean_square_difference(std::span<const AmcFrame> frames, const std::vector<int>& pixels,
                              WeightsOf weights_of) {
  std::vector<double> sums(frames.size());
  parallel_for(static_cast<int>(frames.size()), [&](int i) {
    const FrameWeights weights = weights_of(i);
    double sum = 0;
    for (const int pixel : pixels) {
      const std::size_t at = static_cast<std::size_t>(pixel) * 3;
      for (std::size_t c = at; c < at + 3; ++c) {
        double difference = frames[static_cast<std::size_t>(i)].image.data[c];
        for (const auto& [frame, weight] : weights) {
          difference -= weight * frames[static_cast<std::size_t>(frame)].image.data[c];
        }
        sum += difference * difference;
      }
    }
    sums[static_cast<std::size_t>(i)] = sum;
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0) /
         (static_cast<double>(frames.size()) * static_cast<double>(pixels.size()) * 3);
}

/// Mean square of the frames' difference from their mean.
double mean_square_deviation(std::span<const AmcFrame> frames, const std::vector<int>& pixels) {
  const double n = static_cast<double>(frames.size());
  std::vector<double> variances(pixels.size());
  parallel_for(static_cast<int>(pixels.size()), [&](int i) {
    const std::size_t at = static_cast<std::size_t>(pixels[static_cast<std::size_t>(i)]) * 3;
    for (std::size_t c = at; c < at + 3; ++c) {
      double sum = 0;
      double squares = 0;
      for (const AmcFrame& frame : frames) {
        const double v = frame.image.data[c];
        sum += v;
        squares += v * v;
      }
      variances[static_cast<std::size_t>(i)] += std::max(0.0, squares / n - sum * sum / (n * n)) / 3;
    }
  });
  return std::accumulate(variances.begin(), variances.end(), 0.0) / static_cast<double>(pixels.size());
}

Similarity similarity(int turns, double mean_square, double peak) {
  const double rmse = std::sqrt(mean_square) / peak;
  // A perfect match has no finite PSNR; 200 dB is beyond any picture.
  return {turns, rmse, rmse > 1e-10 ? -20 * std::log10(rmse) : 200};
}

/// The mean over the frame's `symmetry` equivalents, resampled where no frame has exactly that angle.
FrameWeights symmetric_weights(std::span<const double> angles, double angle, int symmetry) {
  FrameWeights all;
  for (int m = 0; m < symmetry; ++m) {
    for (const auto& [frame, weight] : cyclic_weights(angles, angle + static_cast<double>(m) / symmetry, 0)) {
      all.emplace_back(frame, weight / symmetry);
    }
  }
  return all;
}

}  // namespace

double noise_removed_by(std::span<const AmcFrame> frames, int symmetry, double peak) {
  if (symmetry == 1) return 0;
  const auto angles = angles_of(frames);
  const auto pixels = disc_pixels(frames[0].image.width);
  return std::sqrt(mean_square_difference(frames, pixels,
                                          [&](int i) {
                                            return symmetric_weights(
                                                angles, frames[static_cast<std::size_t>(i)].angle, symmetry);
                                          })) /
         peak;
}

SymmetryReport analyse_symmetry(std::span<const AmcFrame> frames, double threshold) {
  const auto angles = angles_of(frames);
  const auto pixels = disc_pixels(frames[0].image.width);
  SymmetryReport report;
  report.threshold = threshold;
  report.peak = peak_of(frames, pixels);
  if (report.peak <= 0)
    throw Error("the frames are black: no symmetry can be found; check exposure and crop");

  report.isotropic = true;
  for (int turns = 1; turns <= 4; ++turns) {
    const double square = turns == 1 ? 0 : mean_square_difference(frames, pixels, [&](int i) {
      return cyclic_weights(angles, frames[static_cast<std::size_t>(i)].angle + 1.0 / turns, 0);
    });
    const Similarity s = similarity(turns, square, report.peak);
    report.similarities.push_back(s);
    if (s.psnr >= threshold) {
      report.symmetry = turns;
    } else {
      report.isotropic = false;
    }
  }
  report.isotropy = similarity(0, mean_square_deviation(frames, pixels), report.peak);
  report.isotropic = report.isotropic && report.isotropy.psnr >= threshold;
  report.noise_removed = noise_removed_by(frames, report.symmetry, report.peak);
  return report;
}

}  // namespace sateen::amc
