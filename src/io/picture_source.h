// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "sateen/core/image.h"
#include "sateen/io/file_stream.h"
#include "sateen/io/stored_colour.h"

namespace sateen::io {

/// What the rows of a PictureSource hold. Integers stand for 0 to 1.
enum class SampleType { u8, u16, f32 };

inline std::size_t sample_bytes(SampleType type) {
  return type == SampleType::u8 ? 1 : type == SampleType::u16 ? 2 : 4;
}

/// What a picture file says before its pixels are decoded.
struct PictureHeader {
  int width = 0;     ///< pixels stored
  int height = 0;    ///< rows stored
  int channels = 0;  ///< stored; the first four at most are delivered
  SampleType samples = SampleType::u8;
  int bits = 8;             ///< per sample in the file
  bool floating = false;    ///< float samples in the file
  int alpha = -1;           ///< the channel that is alpha; -1: none
  bool associated = false;  ///< whether colours are multiplied by alpha already
  int orientation = 1;      ///< how it is to be turned, as EXIF counts: 1 is upright
  /// The picture in pixels of what is stored; an EXR may store a part of it, or more. Empty: what is stored.
  PixelRect window = {};
  StoredColour colour = {};
  /// The most that the format's compression can swell: deflate, the strongest of most, reaches 1032.
  double swelling = 4096;

  int delivered() const { return channels < 4 ? channels : 4; }
  std::size_t row_bytes() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(delivered()) * sample_bytes(samples);
  }
};

/// What of the stored pixels is shown.
inline PixelRect shown_window(const PictureHeader& header) {
  return header.window.width > 0 ? header.window : PixelRect{0, 0, header.width, header.height};
}

/// A picture file being read from its first row to its last. One is made per format, from the file's header
/// alone; memory for pixels is asked for by the first read(), after check_size().
class PictureSource {
 public:
  virtual ~PictureSource() = default;
  const PictureHeader& header() const { return header_; }

  /// The next rows, header().row_bytes() each: interleaved samples of header().samples. Throws Error when the
  /// file is truncated or corrupt.
  virtual void read(int rows, void* out) = 0;

 protected:
  PictureHeader header_;
};

/// Throws Error when a header claims more pixels than `stored` bytes can hold, or none.
void check_size(const std::string& name, const PictureHeader& header, std::uintmax_t stored);

}  // namespace sateen::io
