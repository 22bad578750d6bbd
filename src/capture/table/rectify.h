// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "sateen/capture/photographs/photograph.h"
#include "sateen/capture/sphere/sphere_view.h"
#include "sateen/capture/sphere/still_mask.h"

namespace sateen::capture {

struct RectifiedFrame;

/// Where in the picture each texel of a size x size table slice is seen (row 0 on top). Made once for the
/// mean sphere; a frame whose sphere is a little beside it moves the samples along.
class RectifyMap {
 public:
  /// `rim_pixels`: how close to the outline, in pixels, background may shine in (blur, demosaicing).
  RectifyMap(const Camera& camera, const SphereView& mean, int size, TableFrame frame, double rim_pixels);

  int size() const { return size_; }
  TableFrame frame() const { return frame_; }
  /// Each texel's surface point for the mean sphere; `visible` is false where no frame shows it.
  const std::vector<SeenPoint>& points() const { return points_; }
  /// The rectangle, inside a picture of the size given, of all pixels that rectify() looks at in frames whose
  /// spheres are at `centres` (pixels, at least one).
  PixelRect region(std::span<const Vec2> centres, int width, int height) const;
  /// Samples that fall on it in a frame are not seen there.
  void hide(StillMask mask) { mask_ = std::move(mask); }

 private:
  struct Sample {
    float x, y;                  // pixel for the mean sphere
    float along_x_x, along_x_y;  // how it moves when the centre moves a pixel right,
    float along_y_x, along_y_y;  // and a pixel down
    bool seen;

    Vec2f moved(const Vec2f& shift) const {
      return {x + shift.x() * along_x_x + shift.y() * along_y_x,
              y + shift.x() * along_x_y + shift.y() * along_y_y};
    }
  };
  int size_ = 0;
  int samples_ = 1;  // a texel's footprint is averaged from samples_ x samples_ bilinear samples
  TableFrame frame_ = TableFrame::eye;
  Vec2 centre_{0, 0};
  std::vector<Sample> grid_;
  std::vector<SeenPoint> points_;
  StillMask mask_;

  friend RectifiedFrame rectify(const RectifyMap& map, const Photograph& frame, const Vec2& centre,
                                const Vec3& gain);
};

/// One slice as seen in one frame.
struct RectifiedFrame {
  int size = 0;
  std::vector<Half> rgb;              ///< light with the gain removed, not negative, 3 a texel, row 0 on top
  std::vector<std::uint8_t> weight;   ///< 255: the whole texel was seen; 0: nothing of it
  std::vector<std::uint8_t> clipped;  ///< 255: all of it was clipped
};

/// `centre` is where this frame's sphere centre is seen, pixels; the light is divided by `gain`.
RectifiedFrame rectify(const RectifyMap& map, const Photograph& frame, const Vec2& centre, const Vec3& gain);

}  // namespace sateen::capture
