// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "sateen/core/vector.h"

namespace sateen::capture {

/// Frames registered by turning about one axis.
struct PolarTurning {
  std::vector<double> angles;      ///< per frame, radians, the first is 0
  std::vector<double> confidence;  ///< per frame: correlation with the surface that the others show
  double floor = 0;                ///< correlation that chance alone reaches
};

/// The turn at which two polar pictures agree best.
struct PolarPeak {
  double angle = 0;   ///< by which the one is ahead of the other, radians
  double height = 0;  ///< their correlation there, 1 is perfect
};

/// Surface detail unrolled about one axis: a turn about it is then a shift, which the Fourier transform finds
/// at once over the whole circle. Made of patches as turning.h describes them, as floats.
class PolarPictures {
 public:
  /// `axis`: unit, in the patches' frame.
  PolarPictures(const std::vector<cv::Mat>& images, const Vec3& axis);

  /// How far frame `turned` is ahead of frame `still`.
  PolarPeak between(std::size_t turned, std::size_t still) const;

  /// Each frame against the surface that the frames before it have built, then twice more against all others.
  PolarTurning chain() const;

  /// Radians: how far the rings near the axis, or those far from it, stray from the frames' angles when each
  /// are registered alone; the median over the frames. An axis that is off, detail matched wrongly, or wrong
  /// angles show as degrees here. 0 where too little detail is seen to tell.
  double contradiction(const std::vector<double>& angles) const;

 private:
  std::vector<cv::Mat> spectra_;  // per frame: rings x frequencies, complex
};

}  // namespace sateen::capture
