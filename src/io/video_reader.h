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

/// Reads a video from its first frame to its last, one frame in memory at a time.
class VideoReader {
 public:
  /// Throws Error naming the file when it is missing or no video this computer can decode, or the
  /// module for films is not installed.
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

 private:
  std::unique_ptr<FrameSource> frames_;
};

}  // namespace sateen::io
