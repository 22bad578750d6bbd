// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sateen/io/file_stream.h"
#include "sateen/io/row_samples.h"

namespace sateen::io {

/// How a picture is to be stored.
struct PictureLayout {
  int width = 0;
  int height = 0;
  /// A name for each channel; of formats without names only their number counts, where a second or fourth is
  /// alpha that colours are not multiplied by.
  std::vector<std::string> channels;
  RowSamples samples = RowSamples::u8;
  bool srgb = false;   ///< whether the file says that it is sRGB, where its format can
  int quality = 95;    ///< of a JPEG
  bool quick = false;  ///< larger sooner, where the format has a choice

  int channel_count() const { return static_cast<int>(channels.size()); }
  std::size_t row_samples() const { return static_cast<std::size_t>(width) * channels.size(); }
};

/// Channel names of a picture: Y, Y A, R G B, R G B A.
std::vector<std::string> channel_names(int count);

/// A picture file being written from its first row to its last.
class PictureSink {
 public:
  virtual ~PictureSink() = default;
  /// The next rows, interleaved; clamped to [0, 1] where the file has integers. Throws Error when they cannot
  /// be written.
  virtual void write(int rows, const float* samples) = 0;
  /// To be called after the last row; the stream is the caller's to close. Throws Error likewise.
  virtual void finish() = 0;
};

/// A sample as an integer from 0 to `steps`; what is no number becomes 0.
inline unsigned quantised(float value, float steps) {
  return !(value > 0) ? 0
         : value >= 1 ? static_cast<unsigned>(steps)
                      : static_cast<unsigned>(value * steps + 0.5f);
}

}  // namespace sateen::io
