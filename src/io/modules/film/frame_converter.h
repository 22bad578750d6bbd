// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>

#include "sateen/io/modules/film/libav.h"
#include "sateen/io/picture8.h"

namespace sateen::io {

/// How a stored frame stands upright, a quarter turn or a mirrored one: the pixel (x, y) of the upright frame
/// is the stored one at (xx * x + xy * y, yx * x + yy * y), counted from the far edge where that is negative.
struct Turn {
  int xx = 1;
  int xy = 0;
  int yx = 0;
  int yy = 1;
  /// Whether width and height change places.
  bool across() const { return xx == 0; }
};

/// Of a container's display matrix (null: none, the nine numbers of libavutil/display.h). Nothing for an
/// angle that is no quarter turn.
std::optional<Turn> turn_of(const std::int32_t* matrix);

struct FrameSize {
  int width = 0;
  int height = 0;
};

/// Makes of decoded frames what is shown: R'G'B' of 8 bits with Rec. 709 primaries, square pixels, upright.
/// What a frame does not say of its colours is taken as players do: the matrix of BT.709 for 720 and more
/// rows and BT.601 for fewer, limited range. The transfer functions of BT.601, BT.709, BT.2020, and display
/// gammas are all shown by sRGB's, as players show them: codes are left as they are.
class FrameConverter {
 public:
  /// `name` is what messages call the film; `threads` convert, 0: all processors.
  FrameConverter(std::string name, int threads) : name_(std::move(name)), threads_(threads) {}

  /// Of the converted frame, whose stored pixels are `pixel_aspect` times as wide as high (0: square). Throws
  /// Error for an aspect no camera has.
  FrameSize size(const AVFrame& frame, AVRational pixel_aspect, const Turn& turn) const;

  /// Throws Error for a frame whose colours 8-bit R'G'B' cannot hold or are not known.
  void require_known_colours(const AVFrame& frame) const;

  /// Throws Error where the two above do.
  void convert(const AVFrame& frame, AVRational pixel_aspect, const Turn& turn, Picture8& picture);

 private:
  /// What the scaler is made for.
  struct Layout {
    FrameSize stored;
    FrameSize square;  ///< of square pixels, not turned yet
    AVPixelFormat format = AV_PIX_FMT_NONE;
    bool full_range = false;
    int matrix = 0;               ///< SWS_CS_*
    std::array<int, 2> chroma{};  ///< where chroma samples lie, 1/256 of a pixel right and down
    bool operator==(const Layout& other) const;
  };

  Layout layout_of(const AVFrame& frame, AVRational pixel_aspect) const;
  void prepare(const Layout& layout);

  std::string name_;
  int threads_;
  Layout layout_;
  SwsPtr scaler_;
  FramePtr stored_{allocated(av_frame_alloc())};
  FramePtr planes_{allocated(av_frame_alloc())};  ///< the green, blue and red plane of Layout::square
};

}  // namespace sateen::io
