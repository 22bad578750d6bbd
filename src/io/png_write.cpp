// SPDX-License-Identifier: MIT
#include "sateen/io/picture_codecs.h"
#include "sateen/io/png_escape.h"

namespace sateen::io {
namespace {

struct PngEncoder {
  png_structp png = nullptr;
  png_infop info = nullptr;
  ~PngEncoder() { png_destroy_write_struct(&png, &info); }
};

class PngSink final : public PictureSink {
 public:
  PngSink(std::FILE* stream, const std::string& name, const PictureLayout& layout)
      : name_(name), layout_(layout), row_(layout.row_samples() * (sixteen() ? 2 : 1)) {
    if (layout.channel_count() > 4) fail(name, "a PNG has at most 4 channels");
    encoder_.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &escape_, leave_png, ignore_png);
    encoder_.info = png_create_info_struct(encoder_.png);
    guarded([&] { write_header(stream); });
  }

  void write(int rows, const float* samples) override {
    for (int y = 0; y < rows; ++y, samples += layout_.row_samples()) {
      for (std::size_t i = 0; i < layout_.row_samples(); ++i) {
        if (sixteen()) {
          const unsigned value = quantised(samples[i], 65535);
          row_[2 * i] = static_cast<png_byte>(value >> 8);
          row_[2 * i + 1] = static_cast<png_byte>(value & 0xff);
        } else {
          row_[i] = static_cast<png_byte>(quantised(samples[i], 255));
        }
      }
      guarded([&] { png_write_row(encoder_.png, row_.data()); });
    }
  }

  void finish() override {
    guarded([&] { png_write_end(encoder_.png, encoder_.info); });
  }

 private:
  bool sixteen() const { return layout_.samples == RowSamples::u16; }

  template <class Work>
  void guarded(const Work& work) {
    guarded_png(escape_, name_, "cannot be written: ", work);
  }

  void write_header(std::FILE* stream) {
    constexpr int kTypes[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                              PNG_COLOR_TYPE_RGB_ALPHA};
    png_init_io(encoder_.png, stream);
    if (layout_.quick) png_set_compression_level(encoder_.png, 3);
    png_set_IHDR(encoder_.png, encoder_.info, static_cast<png_uint_32>(layout_.width),
                 static_cast<png_uint_32>(layout_.height), sixteen() ? 16 : 8,
                 kTypes[layout_.channel_count() - 1], PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (layout_.srgb) png_set_sRGB(encoder_.png, encoder_.info, PNG_sRGB_INTENT_RELATIVE);
    png_text text{};
    char key[] = "Software";
    char value[] = "Sateen";
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = key;
    text.text = value;
    png_set_text(encoder_.png, encoder_.info, &text, 1);
    png_write_info(encoder_.png, encoder_.info);
  }

  std::string name_;
  PictureLayout layout_;
  PngEscape escape_;
  PngEncoder encoder_;
  std::vector<png_byte> row_;
};

}  // namespace

SinkPtr create_png(std::FILE* stream, const std::string& name, const PictureLayout& layout) {
  return std::make_unique<PngSink>(stream, name, layout);
}

}  // namespace sateen::io
