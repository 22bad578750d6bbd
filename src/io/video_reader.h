// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "sateen/io/picture8.h"

namespace sateen::io {

class FrameSource;

/// Extensions of the video files that can be read, lower case with the dot.
std::span<const std::string> video_extensions();

/// Reads a video from its first frame to its last, one frame in memory at a time. Frames are upright (a
/// portrait film of a phone stands), of square pixels (others are resampled), and only those shown: what an
/// edit cuts away is not read.
///
/// Colours follow the film: its matrix (BT.601, BT.709, BT.2020), its range and its primaries, which become
/// Rec. 709's. A film that says nothing is taken as players do: BT.709 for 720 and more rows, else BT.601,
/// limited range. Codes of BT.601's, BT.709's and BT.2020's transfer functions are taken for sRGB's, as
/// screens show them. Of more than 8 bits the upper 8 are kept, rounded.
class VideoReader {
 public:
  /// Throws Error naming the file when it is missing, no video this computer can decode, or a kind of colour
  /// that 8 bits cannot hold (HDR: HLG, PQ), or the module for films is not installed.
  explicit VideoReader(const std::filesystem::path& path);
  ~VideoReader();
  VideoReader(VideoReader&&) noexcept;
  VideoReader& operator=(VideoReader&&) noexcept;

  int width() const;
  int height() const;
  /// Frames as the container promises; not to be trusted, and 0 when it does not say.
  int promised_frames() const;
  double frames_per_second() const;  ///< 0 when unknown

  /// The next frame; false at the end, which is also where a damaged file stops.
  bool next(Picture8& frame);
  /// Passes over the next frame without converting it; false at the end.
  bool skip();
  /// When the frame that was last given or passed over is shown, in seconds after the first.
  double seconds() const;

 private:
  std::unique_ptr<FrameSource> frames_;
};

}  // namespace sateen::io
