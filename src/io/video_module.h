// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sateen/io/picture8.h"

namespace sateen::io {

/// Frames one after the other, of a film or a camera.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  virtual int width() const = 0;
  virtual int height() const = 0;
  /// Frames and frames per second the container promises; 0 when it does not say.
  virtual double promised_frames() const = 0;
  virtual double frames_per_second() const = 0;
  /// The next frame; false when there is none.
  virtual bool next(Picture8& frame) = 0;
  /// Passes over the next frame without converting it.
  virtual bool skip() = 0;
  /// What of a camera could not be held fixed ("exposure").
  virtual std::vector<std::string> not_fixed() const = 0;
};

class FrameSink {
 public:
  virtual ~FrameSink() = default;
  /// A frame of the film's size, interleaved RGB of 8 bits, sRGB.
  virtual void write(const Picture8& frame) = 0;
};

/// What the module sateen-video does, by way of OpenCV.
struct VideoModule {
  static constexpr const char* kName = "sateen-video";
  const char* version;  ///< of Sateen

  /// Null when the file cannot be decoded.
  std::unique_ptr<FrameSource> (*open_film)(const std::string& path);
  /// A camera of the system (V4L2), its exposure, white balance and focus held where they settle; null when
  /// none answers.
  std::unique_ptr<FrameSource> (*open_camera)(int index);
  /// Null when there is no encoder or the file cannot be written.
  std::unique_ptr<FrameSink> (*create_film)(const std::string& path, int width, int height,
                                            double frames_per_second);
};

}  // namespace sateen::io
