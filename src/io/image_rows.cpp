// SPDX-License-Identifier: MIT
#include "sateen/io/image_rows.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sateen/io/file.h"
#include "sateen/io/file_error.h"
#include "sateen/io/picture_formats.h"
#include "sateen/io/sample_values.h"

namespace sateen::io {

struct ImageRowReader::File {
  explicit File(const std::filesystem::path& path)
      : source(open_picture(path)), values(source->header(), false) {}

  /// Row `y` of the picture that is shown: stored rows before it are passed over; what is not stored is 0.
  void read_row(int y, std::span<float> out) {
    const PictureHeader& header = source->header();
    const PixelRect window = shown_window(header);
    const std::size_t channels = out.size() / static_cast<std::size_t>(window.width);
    std::ranges::fill(out, 0.0f);
    const int wanted = y + window.y;
    if (wanted < 0 || wanted >= header.height) return;
    row.resize(header.row_bytes());
    for (; stored <= wanted; ++stored) source->read(1, row.data());
    const int first = std::max(0, window.x);
    const int last = std::min(header.width, window.x + window.width);
    if (first >= last) return;
    const std::size_t pixel = header.row_bytes() / static_cast<std::size_t>(header.width);
    values.convert(row.data() + pixel * static_cast<std::size_t>(first),
                   static_cast<std::size_t>(last - first),
                   out.data() + channels * static_cast<std::size_t>(first - window.x));
  }

  std::unique_ptr<PictureSource> source;
  SampleValues values;
  std::vector<std::byte> row;  ///< just read, as the file has it
  int stored = 0;              ///< rows read so far
  Image whole;                 ///< of a JPEG that had to be turned
};

ImageRowReader::ImageRowReader(const std::filesystem::path& path)
    : path_(path), info_(read_image_info(path)), file_(std::make_unique<File>(path)) {
  const PictureHeader& header = file_->source->header();
  info_.channels = header.delivered();
  const std::string extension = extension_of(path);
  if (header.orientation > 1 && (extension == ".jpg" || extension == ".jpeg")) {
    file_->whole = read_data(path);
  } else if (header.orientation > 1) {
    fail(path, "is turned by its EXIF orientation; save it upright");
  }
}

ImageRowReader::~ImageRowReader() = default;

void ImageRowReader::read(std::span<float> out) {
  const std::size_t row = static_cast<std::size_t>(width()) * static_cast<std::size_t>(channels());
  const int count = static_cast<int>(out.size() / row);
  if (file_->whole.empty()) {
    for (int i = 0; i < count; ++i)
      file_->read_row(next_ + i, out.subspan(static_cast<std::size_t>(i) * row, row));
  } else {
    std::copy_n(file_->whole.data.begin() + static_cast<std::ptrdiff_t>(row) * next_, out.size(),
                out.begin());
  }
  if (info_.floating) {
    const auto bad = std::ranges::find_if_not(out, [](float v) { return std::isfinite(v); });
    if (bad != out.end()) {
      const auto at = static_cast<std::size_t>(bad - out.begin());
      fail(path_, fmt::format("has a value that is not finite at pixel ({}, {})",
                              at % row / static_cast<std::size_t>(channels()),
                              static_cast<std::size_t>(next_) + at / row));
    }
  }
  next_ += count;
}

struct ImageRowWriter::File {
  FileStream stream;  // outlives `sink`, which writes to it
  SinkPtr sink;
};

ImageRowWriter::ImageRowWriter(const std::filesystem::path& file, const std::filesystem::path& name,
                               int width, int height, int channels, RowSamples samples)
    : name_(name),
      row_(static_cast<std::size_t>(width) * static_cast<std::size_t>(channels)),
      file_(std::make_unique<File>()) {
  const PictureFormat* format = format_of_extension(extension_of(file));
  if (format == nullptr) fail(name, "unknown picture type");
  file_->stream = create_file(file, name.string());
  file_->sink = format->create(
      file_->stream.get(), name.string(),
      {.width = width, .height = height, .channels = channel_names(channels), .samples = samples});
}

ImageRowWriter::~ImageRowWriter() = default;

void ImageRowWriter::write(std::span<const float> rows) {
  file_->sink->write(static_cast<int>(rows.size() / row_), rows.data());
}

void ImageRowWriter::close() {
  file_->sink->finish();
  close_written(std::move(file_->stream), name_.string());
}

}  // namespace sateen::io
