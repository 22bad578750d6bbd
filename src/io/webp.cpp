// SPDX-License-Identifier: MIT
#include <array>
#include <cstring>

#include <webp/decode.h>
#include <webp/encode.h>

#include "sateen/io/exif.h"
#include "sateen/io/file_error.h"
#include "sateen/io/picture_codecs.h"

namespace sateen::io {
namespace {

std::size_t little_endian(std::span<const std::byte> bytes) {
  std::size_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<std::size_t>(bytes[i]);
  return value;
}

/// What the chunk `name` of a WebP file holds; empty when there is none.
std::span<const std::byte> chunk(std::span<const std::byte> file, std::string_view name) {
  constexpr std::size_t kHead = 8;
  for (std::size_t at = 12; at + kHead <= file.size();) {
    const std::size_t length = little_endian(file.subspan(at + 4));
    if (length > file.size() - at - kHead) return {};
    if (std::memcmp(file.data() + at, name.data(), 4) == 0) return file.subspan(at + kHead, length);
    at += kHead + length + length % 2;
  }
  return {};
}

class WebpSource final : public PictureSource {
 public:
  WebpSource(std::string name, std::vector<std::byte> bytes)
      : name_(std::move(name)), bytes_(std::move(bytes)) {
    WebPBitstreamFeatures features{};
    if (WebPGetFeatures(data(), bytes_.size(), &features) != VP8_STATUS_OK)
      fail(name_, "cannot be read as a picture: its WebP header is truncated or corrupt");
    if (features.has_animation != 0) fail(name_, "is animated; a still picture is needed");
    header_.width = features.width;
    header_.height = features.height;
    header_.channels = features.has_alpha != 0 ? 4 : 3;
    if (features.has_alpha != 0) header_.alpha = 3;
    header_.swelling = 1e12;  // a constant picture takes no bits at all; a side has at most 16,383 pixels
    const auto icc = chunk(bytes_, "ICCP");
    header_.colour.icc.assign(icc.begin(), icc.end());
    auto exif = chunk(bytes_, "EXIF");
    if (exif.size() > 6 && std::memcmp(exif.data(), "Exif", 4) == 0) exif = exif.subspan(6);
    header_.orientation = read_exif(exif).orientation;
  }

  void read(int rows, void* out) override {
    const std::size_t row = header_.row_bytes();
    if (pixels_.empty()) {
      pixels_.resize(row * static_cast<std::size_t>(header_.height));
      const auto decode = header_.channels == 4 ? WebPDecodeRGBAInto : WebPDecodeRGBInto;
      if (decode(data(), bytes_.size(), pixels_.data(), pixels_.size(), static_cast<int>(row)) == nullptr)
        fail(name_, "is truncated or corrupt");
    }
    const std::size_t count = row * static_cast<std::size_t>(rows);
    std::memcpy(out, pixels_.data() + done_, count);
    done_ += count;
  }

 private:
  const std::uint8_t* data() const { return reinterpret_cast<const std::uint8_t*>(bytes_.data()); }

  std::string name_;
  std::vector<std::byte> bytes_;
  std::vector<std::uint8_t> pixels_;
  std::size_t done_ = 0;
};

/// Without loss; a WebP is encoded whole.
class WebpSink final : public PictureSink {
 public:
  WebpSink(std::FILE* stream, const std::string& name, const PictureLayout& layout)
      : stream_(stream), name_(name), layout_(layout) {
    if (layout.width > WEBP_MAX_DIMENSION || layout.height > WEBP_MAX_DIMENSION)
      fail(name, fmt::format("a WebP has at most {} pixels a side", WEBP_MAX_DIMENSION));
    if (layout.samples != RowSamples::u8) fail(name, "a WebP has 8 bits a sample");
  }

  void write(int rows, const float* samples) override {
    const std::size_t channels = layout_.channels.size();
    const std::size_t pixels = static_cast<std::size_t>(rows) * static_cast<std::size_t>(layout_.width);
    for (std::size_t i = 0; i < pixels; ++i, samples += channels) {
      for (std::size_t c = 0; c < 3; ++c)
        pixels_.push_back(static_cast<std::uint8_t>(quantised(samples[channels < 3 ? 0 : c], 255)));
      if (alpha()) pixels_.push_back(static_cast<std::uint8_t>(quantised(samples[channels - 1], 255)));
    }
  }

  void finish() override {
    const auto encode = alpha() ? WebPEncodeLosslessRGBA : WebPEncodeLosslessRGB;
    std::uint8_t* encoded = nullptr;
    const std::size_t size =
        encode(pixels_.data(), layout_.width, layout_.height, layout_.width * (alpha() ? 4 : 3), &encoded);
    const std::size_t written = size == 0 ? 0 : std::fwrite(encoded, 1, size, stream_);
    WebPFree(encoded);
    if (size == 0) fail(name_, "cannot be written: it cannot be encoded as WebP");
    if (written != size) fail(name_, fmt::format("cannot be written: {}", std::strerror(errno)));
  }

 private:
  bool alpha() const { return layout_.channels.size() % 2 == 0; }

  std::FILE* stream_;
  std::string name_;
  PictureLayout layout_;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace

SourcePtr open_webp(PictureBytes bytes) {
  std::vector<std::byte> all = remaining_bytes(bytes);
  return std::make_unique<WebpSource>(bytes.name, std::move(all));
}

SinkPtr create_webp(std::FILE* stream, const std::string& name, const PictureLayout& layout) {
  return std::make_unique<WebpSink>(stream, name, layout);
}

}  // namespace sateen::io
