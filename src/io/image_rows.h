// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "sateen/io/image.h"
#include "sateen/io/row_samples.h"

namespace sateen::io {

/// Reads a data picture from top to bottom, a few rows at a time, so that pictures larger than memory can be
/// worked on; of an interlaced PNG, a WebP and a turned JPEG the whole is held, of another JPEG the file.
/// Values as read_data gives them: integers scaled to [0, 1], no colour conversion.
class ImageRowReader {
 public:
  /// As large as read_image shows it. Throws Error as read_image_info does, and for a picture its EXIF data
  /// turn (rows then are no rows of the file), JPEGs apart.
  explicit ImageRowReader(const std::filesystem::path& path);
  ~ImageRowReader();
  ImageRowReader(const ImageRowReader&) = delete;
  ImageRowReader& operator=(const ImageRowReader&) = delete;

  const std::filesystem::path& path() const { return path_; }
  int width() const { return info_.width; }
  int height() const { return info_.height; }
  int channels() const { return info_.channels; }  ///< 1 to 4: of more, the first four are read
  const ImageInfo& info() const { return info_; }

  /// The next out.size() / (width * channels) rows. Throws Error when the file is truncated or a value is not
  /// finite.
  void read(std::span<float> out);

 private:
  struct File;
  std::filesystem::path path_;
  ImageInfo info_;
  std::unique_ptr<File> file_;
  int next_ = 0;
};

/// Writes a data picture from top to bottom. Not atomic by itself: give it the temporary name of
/// write_atomically.
class ImageRowWriter {
 public:
  /// Throws Error when the file cannot be created; `name` is what messages call it.
  ImageRowWriter(const std::filesystem::path& file, const std::filesystem::path& name, int width, int height,
                 int channels, RowSamples samples);
  ~ImageRowWriter();
  ImageRowWriter(const ImageRowWriter&) = delete;
  ImageRowWriter& operator=(const ImageRowWriter&) = delete;

  /// The next rows, clamped to [0, 1] for integers. Throws Error when the disk is full.
  void write(std::span<const float> rows);
  /// To be called after the last row. Throws Error when the file could not be finished.
  void close();

 private:
  struct File;
  std::filesystem::path name_;
  std::size_t row_;  ///< samples of a row
  std::unique_ptr<File> file_;
};

}  // namespace sateen::io
