// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "sateen/core/image.h"

namespace sateen::amc {

/// One picture of the turning sphere: size x size, RGB, linear, filled from the rim; `angle` is the tangent's
/// direction in the picture in turns, counter-clockwise from +x.
struct AmcFrame {
  Image image;
  double angle = 0;
};

/// How alike the frames are to themselves turned by 1/turns of a turn.
struct Similarity {
  int turns = 1;    ///< R
  double rmse = 0;  ///< root mean square difference over disc, angles and channels, as a share of the peak
  double psnr = 0;  ///< -20 log10(rmse), dB
};

/// What section 5.2 of Magri et al. looks for. Independent of exposure: errors are relative to the peak, the
/// value that 99.9 % of the samples on the disc stay below.
struct SymmetryReport {
  std::vector<Similarity> similarities;  ///< for R = 1 (always perfect), 2, 3, 4
  Similarity isotropy;                   ///< of every frame to the mean of all; turns = 0
  double peak = 0;
  double threshold = 0;      ///< dB
  int symmetry = 1;          ///< the largest R whose PSNR reaches the threshold
  bool isotropic = false;    ///< isotropy and every R reach the threshold
  double noise_removed = 0;  ///< rms change, as a share of the peak, that averaging equivalent slices makes
};

inline constexpr double kDefaultSymmetryThreshold = 30;  ///< dB

/// Frames sorted by angle over one full turn, at least two. Throws Error for a black capture.
SymmetryReport analyse_symmetry(std::span<const AmcFrame> frames,
                                double threshold = kDefaultSymmetryThreshold);

/// The rms change, as a share of `peak`, that averaging the frames with their `symmetry` equivalents makes.
double noise_removed_by(std::span<const AmcFrame> frames, int symmetry, double peak);

}  // namespace sateen::amc
