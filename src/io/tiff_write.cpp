// SPDX-License-Identifier: MIT
#include <algorithm>

#include "sateen/io/image_error.h"
#include "sateen/io/picture_codecs.h"
#include "sateen/io/tiff_stream.h"

namespace sateen::io {
namespace {

class TiffSink final : public PictureSink {
 public:
  TiffSink(std::FILE* stream, const std::string& name, const PictureLayout& layout)
      : name_(name), layout_(layout), tiff_(stream, name, "w", 0), row_(layout.row_samples()) {
    if (layout.channel_count() > 4 || layout.samples != RowSamples::u8)
      fail(name, "a TIFF is written with 8 bits and at most 4 channels");
    if (tiff_.get() == nullptr) fail_write();
    const int channels = layout.channel_count();
    set(TIFFTAG_IMAGEWIDTH, layout.width);
    set(TIFFTAG_IMAGELENGTH, layout.height);
    set(TIFFTAG_BITSPERSAMPLE, 8);
    set(TIFFTAG_SAMPLESPERPIXEL, channels);
    set(TIFFTAG_PHOTOMETRIC, channels < 3 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB);
    set(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    set(TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
    set(TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
    set(TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL);
    set(TIFFTAG_ROWSPERSTRIP, std::min(layout.height, 64));
    if (channels % 2 == 0) {
      const std::uint16_t alpha = EXTRASAMPLE_UNASSALPHA;
      TIFFSetField(tiff_.get(), TIFFTAG_EXTRASAMPLES, 1, &alpha);
    }
    TIFFSetField(tiff_.get(), TIFFTAG_SOFTWARE, "Sateen");
  }

  void write(int rows, const float* samples) override {
    for (int y = 0; y < rows; ++y, samples += row_.size()) {
      std::transform(samples, samples + row_.size(), row_.begin(),
                     [](float v) { return static_cast<std::uint8_t>(quantised(v, 255)); });
      if (TIFFWriteScanline(tiff_.get(), row_.data(), static_cast<std::uint32_t>(next_++), 0) != 1)
        fail_write();
    }
  }

  void finish() override {
    if (TIFFFlush(tiff_.get()) != 1) fail_write();
    tiff_.close();
    if (!tiff_.fault().empty()) fail_write();
  }

 private:
  [[noreturn]] void fail_write() const { fail(name_, "cannot be written: " + image_reason(tiff_.fault())); }

  void set(std::uint32_t tag, int value) {
    if (TIFFSetField(tiff_.get(), tag, value) != 1) fail_write();
  }

  std::string name_;
  PictureLayout layout_;
  TiffStream tiff_;
  std::vector<std::uint8_t> row_;
  int next_ = 0;
};

}  // namespace

SinkPtr create_tiff(std::FILE* stream, const std::string& name, const PictureLayout& layout) {
  return std::make_unique<TiffSink>(stream, name, layout);
}

}  // namespace sateen::io
