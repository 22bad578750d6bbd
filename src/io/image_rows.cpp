// SPDX-License-Identifier: MIT
#include "sateen/io/image_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "sateen/io/file.h"
#include "sateen/io/image_error.h"

namespace sateen::io {

struct ImageRowReader::File {
  // A JPEG is decoded whole: only read_data notices what libjpeg quietly fills with grey.
  Image whole;
  std::unique_ptr<OIIO::ImageInput> input;
  // Of tiled files a whole row of tiles is decoded at once: rows [first, first + count).
  std::vector<float> tiles;
  int first = 0;
  int count = 0;
};

ImageRowReader::ImageRowReader(const std::filesystem::path& path)
    : path_(path), info_(read_image_info(path)), file_(std::make_unique<File>()) {
  info_.channels = std::min(info_.channels, 4);
  if (const std::string extension = extension_of(path); extension == ".jpg" || extension == ".jpeg") {
    file_->whole = read_data(path);
    info_.width = file_->whole.width;
    info_.height = file_->whole.height;
    info_.channels = file_->whole.channels;
    return;
  }
  OIIO::ImageSpec wishes;
  wishes["oiio:UnassociatedAlpha"] = 1;
  file_->input = OIIO::ImageInput::open(path.string(), &wishes);
  if (!file_->input) fail(path, "cannot be read as a picture");
  if (file_->input->spec().get_int_attribute("Orientation", 1) > 1) {
    fail(path, "is turned by its EXIF orientation; save it upright");
  }
}

ImageRowReader::~ImageRowReader() = default;

void ImageRowReader::read(std::span<float> out) {
  const std::size_t row = static_cast<std::size_t>(width()) * static_cast<std::size_t>(channels());
  const int count = static_cast<int>(out.size() / row);
  if (!file_->whole.empty()) {
    std::copy_n(file_->whole.data.begin() + static_cast<std::ptrdiff_t>(row) * next_, out.size(),
                out.begin());
    next_ += count;
    return;
  }
  OIIO::ImageInput& input = *file_->input;
  const OIIO::ImageSpec& spec = input.spec();
  const auto check = [&](bool fine) {
    if (!fine) fail(path_, "is truncated or corrupt: " + input.geterror());
  };
  if (spec.tile_width == 0) {
    check(input.read_scanlines(0, 0, next_, next_ + count, 0, 0, channels(), OIIO::TypeDesc::FLOAT,
                               out.data()));
  } else {
    for (int y = next_; y < next_ + count; ++y) {
      if (y >= file_->first + file_->count) {
        file_->first = y - y % spec.tile_height;
        file_->count = std::min(spec.tile_height, height() - file_->first);
        file_->tiles.resize(row * static_cast<std::size_t>(file_->count));
        check(input.read_tiles(0, 0, 0, width(), file_->first, file_->first + file_->count, 0, 1, 0,
                               channels(), OIIO::TypeDesc::FLOAT, file_->tiles.data()));
      }
      std::copy_n(file_->tiles.begin() + static_cast<std::ptrdiff_t>(row) * (y - file_->first), row,
                  out.begin() + static_cast<std::ptrdiff_t>(row) * (y - next_));
    }
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
  /// A file that remembers a write that failed: the PNG writer does not look.
  class Checked : public OIIO::Filesystem::IOFile {
   public:
    explicit Checked(const std::string& path) : IOFile(path, Write) {}
    std::size_t write(const void* bytes, std::size_t size) override {
      const std::size_t written = IOFile::write(bytes, size);
      whole_ = whole_ && written == size;
      return written;
    }
    /// Whether everything written so far has reached the file.
    bool whole() const { return whole_ && m_file != nullptr && std::fflush(m_file) == 0; }

   private:
    bool whole_ = true;
  };

  explicit File(const std::string& path) : file(path) {}
  Checked file;  // outlives `output`, which writes to it
  std::unique_ptr<OIIO::ImageOutput> output;
};

ImageRowWriter::ImageRowWriter(const std::filesystem::path& file, const std::filesystem::path& name,
                               int width, int height, int channels, RowSamples samples)
    : name_(name), width_(width), channels_(channels), file_(std::make_unique<File>(file.string())) {
  static const OIIO::TypeDesc kTypes[] = {OIIO::TypeDesc::UINT8, OIIO::TypeDesc::UINT16, OIIO::TypeDesc::HALF,
                                          OIIO::TypeDesc::FLOAT};
  OIIO::ImageSpec spec(width, height, channels, kTypes[static_cast<std::size_t>(samples)]);
  spec["oiio:ColorSpace"] = "Linear";
  spec["Software"] = "Sateen";
  file_->output = OIIO::ImageOutput::create(file.string());
  if (!file_->output) fail(name, "unknown picture type");
  if (!file_->file.opened() || !file_->output->set_ioproxy(&file_->file) ||
      !file_->output->open(file.string(), spec))
    fail(name, "cannot be written: " + file_->output->geterror());
}

ImageRowWriter::~ImageRowWriter() = default;

void ImageRowWriter::write(std::span<const float> rows) {
  const std::size_t row = static_cast<std::size_t>(width_) * static_cast<std::size_t>(channels_);
  const int count = static_cast<int>(rows.size() / row);
  if (!file_->output->write_scanlines(next_, next_ + count, 0, OIIO::TypeDesc::FLOAT, rows.data())) {
    fail(name_, "cannot be written: " + file_->output->geterror());
  }
  next_ += count;
}

void ImageRowWriter::close() {
  if (!file_->output->close()) fail(name_, "cannot be written: " + file_->output->geterror());
  if (!file_->file.whole()) fail(name_, "cannot be written: the disk is full");
}

}  // namespace sateen::io
