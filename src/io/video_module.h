// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "sateen/io/picture8.h"

namespace sateen::io {

/// The frames of a film one after the other, upright, of square pixels, converted to R'G'B' by the film's own
/// matrix and range.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// Of the first frame.
  virtual int width() const = 0;
  virtual int height() const = 0;
  /// Frames and frames per second the container promises; 0 when it does not say.
  virtual double promised_frames() const = 0;
  virtual double frames_per_second() const = 0;
  /// The next frame; false when there is none, or it is damaged: no frame comes after that. Throws Error for
  /// one whose colours cannot be converted.
  virtual bool next(Picture8& frame) = 0;
  /// Passes over the next frame without converting it.
  virtual bool skip() = 0;
  /// When the frame that came last is shown, in seconds after the first.
  virtual double seconds() const = 0;
};

class FrameSink {
 public:
  virtual ~FrameSink() = default;
  /// A frame of the film's size, sRGB. Throws Error when it cannot be encoded or written.
  virtual void write(const Picture8& frame) = 0;
  /// Writes what is held back and the index, and closes the file: before that it is no film. Throws Error
  /// when any of it cannot be written.
  virtual void finish() = 0;
};

struct FilmSettings {
  std::string path;       ///< the file that is written
  std::string name;       ///< what messages call it
  std::string container;  ///< "mp4", "mov" or "avi"
  int width = 0;          ///< even, as the height
  int height = 0;
  double frames_per_second = 0;
};

/// What the module sateen-video does, by way of FFmpeg's libraries.
struct VideoModule {
  static constexpr const char* kName = "sateen-video";
  const char* version;  ///< of Sateen

  /// `threads` decode; 0: all processors. Throws Error for a file that is no film, cannot be decoded here, or
  /// whose colours are none of 8-bit RGB (HDR).
  std::unique_ptr<FrameSource> (*open_film)(const std::string& path, int threads);
  /// The bytes that are written depend on the frames and settings alone. Throws Error.
  std::unique_ptr<FrameSink> (*create_film)(const FilmSettings& settings);
};

}  // namespace sateen::io
