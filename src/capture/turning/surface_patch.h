// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "sateen/capture/sphere/scout.h"
#include "sateen/capture/sphere/sphere_view.h"
#include "sateen/capture/sphere/still_mask.h"

namespace sateen::capture {

/// The sphere's fine surface detail in one frame, on a disc of the normals in a frame fixed to the camera (z
/// from the mean sphere's centre to the eye): pixel (x, y), row 0 on top, shows the normal whose disc point
/// is kPatchReach * disc_of_pixel(x, y, size). Light relative to its neighbourhood, 127 per unit, 0 outside
/// the disc.
struct SurfacePatch {
  int size = 0;
  std::vector<std::int8_t> detail;
  double sharpness = 0;  ///< rms of the detail: blurred frames have less
};

inline constexpr double kPatchReach = 0.9;

/// Where a grey picture shows each pixel of a patch. Made once for the mean sphere, as RectifyMap is; a frame
/// whose sphere is a little beside it moves the places along.
class PatchMap {
 public:
  /// `axes` is the rotation from view space to the patch's frame. What lies under `still`, which hides pixels
  /// of the grey pictures, has no detail.
  PatchMap(const Camera& camera, const SphereView& mean, const Mat3& axes, int size, StillMask still);

  /// The patch of a frame whose sphere's centre is seen at `centre`, grey pixels.
  SurfacePatch patch(const GreyPicture& frame, const Vec2& centre) const;

 private:
  struct Place {
    int index;      // of the patch's pixel
    Vec2f at;       // grey pixel for the mean sphere
    Vec2f along_x;  // how it moves when the centre moves a pixel right,
    Vec2f along_y;  // and a pixel down
  };
  cv::Mat around(const cv::Mat& light) const;

  int size_ = 0;
  Vec2 centre_{0, 0};
  std::vector<Place> places_;
  cv::Mat inside_;  // 1: the pixel lies on the disc
  StillMask still_;
  cv::Mat share_;  // of each pixel's neighbourhood that lies on the disc
};

}  // namespace sateen::capture
