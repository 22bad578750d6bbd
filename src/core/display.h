// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/image.h"
#include "sateen/core/view_transform.h"

namespace sateen {

/// From the light of a scene to the light of a display: exposure, then the view.
struct DisplaySettings {
  double exposure = 0;  ///< stops: light times 2^exposure; finite
  ViewTransform view = ViewTransform::srgb;
};

/// 2^exposure.
double display_gain(const DisplaySettings& settings);

/// A picture of scene light as a display shows it, every pixel one sample: what shaders/display.frag does to
/// samples, for pictures that did not come from the renderer. A second or fourth channel is alpha, with which
/// colour is associated before and after; it stays.
///
/// The result is what io::write_image and io::write_video take for pictures of 8 bits. They put on the sRGB
/// curve; the view `none` has taken it off beforehand, so that the file holds the linear values.
Image displayed(Image light, const DisplaySettings& settings);

/// The same picture over a background of display light; without alpha in it, opaque.
Image over_background(Image associated, const Vec3f& background);

}  // namespace sateen
