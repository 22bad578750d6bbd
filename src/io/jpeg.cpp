// SPDX-License-Identifier: MIT
#include "sateen/io/jpeg.h"

#include <algorithm>
#include <csetjmp>
#include <cstdio>  // jpeglib.h needs it
#include <cstdlib>

#include <jerror.h>
#include <jpeglib.h>

#include "sateen/io/exif.h"
#include "sateen/io/image_error.h"
#include "sateen/io/picture_codecs.h"

namespace sateen::io {
namespace {

/// libjpeg's way out of an error is a jump; the message waits here.
struct ErrorManager {
  jpeg_error_mgr base;
  std::jmp_buf escape;
  char message[JMSG_LENGTH_MAX];
};

[[noreturn]] void leave(j_common_ptr info) {
  auto* manager = reinterpret_cast<ErrorManager*>(info->err);
  manager->base.format_message(info, manager->message);
  std::longjmp(manager->escape, 1);
}

/// Whether the bytes skipped before the end marker are all alike: what some cameras append, while the rest of
/// a scan that lost its track is not.
bool only_padding(j_common_ptr info) {
  const auto* source = reinterpret_cast<j_decompress_ptr>(info)->src;
  const int count = info->err->msg_parm.i[0];
  const JOCTET* end = source->next_input_byte;
  const JOCTET* begin = end - count;
  return std::all_of(begin, end, [&](JOCTET byte) { return byte == *begin; });
}

void on_message(j_common_ptr info, int level) {
  if (level >= 0) return;  // a trace
  const int code = info->err->msg_code;
  if (code == JWRN_JFIF_MAJOR || code == JWRN_ADOBE_XFORM || code == JWRN_BOGUS_ICC) return;
  constexpr int kEndOfImage = 0xd9;
  if (code == JWRN_EXTRANEOUS_DATA && info->err->msg_parm.i[1] == kEndOfImage && only_padding(info)) return;
  leave(info);
}

constexpr int kExifMarker = JPEG_APP0 + 1;
constexpr int kProfileMarker = JPEG_APP0 + 2;

/// Gives the decoder's memory back, also when a constructor above it throws.
struct Decompressor {
  jpeg_decompress_struct info{};
  ~Decompressor() { jpeg_destroy_decompress(&info); }
};

/// libjpeg's decoder on bytes in memory. libjpeg fills what is missing or broken with grey and only warns;
/// here each warning that means lost pixels is an Error.
class JpegDecoder : public Decompressor {
 public:
  JpegDecoder(std::string name, std::span<const std::byte> bytes) : name_(std::move(name)) {
    info.err = jpeg_std_error(&errors_.base);
    errors_.base.error_exit = leave;
    errors_.base.emit_message = on_message;
    guarded([&] {
      jpeg_create_decompress(&info);
      jpeg_save_markers(&info, kExifMarker, 0xffff);
      jpeg_save_markers(&info, kProfileMarker, 0xffff);
      jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()),
                   static_cast<unsigned long>(bytes.size()));
      jpeg_read_header(&info, TRUE);
    });
  }
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;

  /// Runs `work`, out of which libjpeg's errors jump: it may own nothing.
  template <class Work>
  void guarded(const Work& work) {
    if (setjmp(errors_.escape) != 0) fail(name_, "is truncated or corrupt: " + image_reason(errors_.message));
    work();
  }

  int orientation() const {
    constexpr std::size_t kBlock = 6;  // behind "Exif" and two zeros
    for (auto* marker = info.marker_list; marker != nullptr; marker = marker->next) {
      const auto bytes = std::as_bytes(std::span(marker->data, marker->data_length));
      if (marker->marker == kExifMarker && bytes.size() > kBlock && bytes[0] == std::byte{'E'})
        return read_exif(bytes.subspan(kBlock)).orientation;
    }
    return 1;
  }

 private:
  std::string name_;
  ErrorManager errors_{};
};

/// The part of a picture that is decoded.
struct Band {
  JDIMENSION first_column = 0;
  JDIMENSION end = 0;  // row
};

/// Has libjpeg pass over what lies above and beside `region`. A block more is decoded on each side, as
/// colours are interpolated between blocks.
Band crop(jpeg_decompress_struct& info, const PixelRect& region) {
  constexpr int kBlock = 16;
  const int left = std::max(0, region.x - kBlock);
  const int top = std::max(0, region.y - kBlock);
  auto first = static_cast<JDIMENSION>(left);
  JDIMENSION columns =
      std::min(info.output_width, static_cast<JDIMENSION>(region.x + region.width + kBlock)) - first;
  jpeg_crop_scanline(&info, &first, &columns);
  if (top > 0) jpeg_skip_scanlines(&info, static_cast<JDIMENSION>(top));
  return {first, static_cast<JDIMENSION>(region.y + region.height)};
}

PictureHeader header_of(const jpeg_decompress_struct& info, int orientation) {
  PictureHeader header;
  header.width = static_cast<int>(info.image_width);
  header.height = static_cast<int>(info.image_height);
  header.channels = info.jpeg_color_space == JCS_GRAYSCALE ? 1 : 3;
  header.orientation = orientation;
  return header;
}

class JpegSource final : public PictureSource {
 public:
  JpegSource(const std::string& name, std::vector<std::byte> bytes)
      : bytes_(std::move(bytes)), decoder_(name, bytes_) {
    jpeg_decompress_struct& info = decoder_.info;
    if (info.jpeg_color_space == JCS_CMYK || info.jpeg_color_space == JCS_YCCK)
      fail(name, "is CMYK; convert it to RGB first");
    header_ = header_of(info, decoder_.orientation());
    if (info.jpeg_color_space == JCS_UNKNOWN) header_.channels = info.num_components;
    read_profile();
  }

  void read(int rows, void* out) override {
    jpeg_decompress_struct& info = decoder_.info;
    decoder_.guarded([&] {
      if (info.output_scanline == 0) jpeg_start_decompress(&info);
      auto* row = static_cast<JSAMPROW>(out);
      for (int i = 0; i < rows; ++i, row += header_.row_bytes()) jpeg_read_scanlines(&info, &row, 1);
      if (info.output_scanline == info.output_height) jpeg_finish_decompress(&info);
    });
  }

 private:
  void read_profile() {
    JOCTET* profile = nullptr;
    unsigned size = 0;
    decoder_.guarded([&] { jpeg_read_icc_profile(&decoder_.info, &profile, &size); });
    const auto bytes = std::as_bytes(std::span(profile, size));
    header_.colour.icc.assign(bytes.begin(), bytes.end());
    std::free(profile);
  }

  std::vector<std::byte> bytes_;
  JpegDecoder decoder_;
};

struct JpegEncoder {
  jpeg_compress_struct info{};
  ~JpegEncoder() { jpeg_destroy_compress(&info); }
};

class JpegSink final : public PictureSink {
 public:
  JpegSink(std::FILE* stream, const std::string& name, const PictureLayout& layout)
      : name_(name), layout_(layout), row_(layout.row_samples()) {
    if (layout.channel_count() != 1 && layout.channel_count() != 3) fail(name, "a JPEG is grey or RGB");
    encoder_.info.err = jpeg_std_error(&errors_.base);
    errors_.base.error_exit = leave;
    guarded([&] { start(stream); });
  }

  void write(int rows, const float* samples) override {
    for (int y = 0; y < rows; ++y, samples += row_.size()) {
      std::transform(samples, samples + row_.size(), row_.begin(),
                     [](float v) { return static_cast<JSAMPLE>(quantised(v, 255)); });
      guarded([&] {
        JSAMPROW row = row_.data();
        jpeg_write_scanlines(&encoder_.info, &row, 1);
      });
    }
  }

  void finish() override {
    guarded([&] { jpeg_finish_compress(&encoder_.info); });
  }

 private:
  template <class Work>
  void guarded(const Work& work) {
    if (setjmp(errors_.escape) != 0) fail(name_, "cannot be written: " + image_reason(errors_.message));
    work();
  }

  void start(std::FILE* stream) {
    jpeg_compress_struct& info = encoder_.info;
    jpeg_create_compress(&info);
    jpeg_stdio_dest(&info, stream);
    info.image_width = static_cast<JDIMENSION>(layout_.width);
    info.image_height = static_cast<JDIMENSION>(layout_.height);
    info.input_components = layout_.channel_count();
    info.in_color_space = layout_.channel_count() == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_set_defaults(&info);
    jpeg_set_quality(&info, layout_.quality, TRUE);
    for (int c = 0; c < info.num_components; ++c) {  // full resolution for colour too
      info.comp_info[c].h_samp_factor = 1;
      info.comp_info[c].v_samp_factor = 1;
    }
    jpeg_start_compress(&info, TRUE);
  }

  std::string name_;
  PictureLayout layout_;
  ErrorManager errors_{};
  JpegEncoder encoder_;
  std::vector<JSAMPLE> row_;
};

}  // namespace

SourcePtr open_jpeg(PictureBytes bytes) {
  std::vector<std::byte> all = remaining_bytes(bytes);
  return std::make_unique<JpegSource>(bytes.name, std::move(all));
}

SinkPtr create_jpeg(std::FILE* stream, const std::string& name, const PictureLayout& layout) {
  return std::make_unique<JpegSink>(stream, name, layout);
}

bool decode_plain_jpeg(const std::filesystem::path& path, std::span<const std::byte> bytes, Picture8& picture,
                       const PixelRect* only) {
  if (bytes.size() < 2 || bytes[0] != std::byte{0xff} || bytes[1] != std::byte{0xd8}) return false;
  JpegDecoder decoder(path.string(), bytes);
  jpeg_decompress_struct& info = decoder.info;
  const bool colours = info.jpeg_color_space == JCS_YCbCr || info.jpeg_color_space == JCS_RGB ||
                       info.jpeg_color_space == JCS_GRAYSCALE;
  if (!colours || decoder.orientation() != 1) return false;
  check_size(path.string(), header_of(info, 1), bytes.size());
  info.out_color_space = JCS_RGB;
  picture.width = static_cast<int>(info.image_width);
  picture.height = static_cast<int>(info.image_height);
  const std::size_t stride = static_cast<std::size_t>(picture.width) * 3;
  picture.rgb.resize(stride * info.image_height);
  decoder.guarded([&] {
    jpeg_start_decompress(&info);
    const Band band = only == nullptr ? Band{0, info.output_height} : crop(info, *only);
    while (info.output_scanline < band.end) {
      JSAMPROW row = picture.rgb.data() + info.output_scanline * stride + band.first_column * 3;
      jpeg_read_scanlines(&info, &row, 1);
    }
    if (band.end == info.output_height) jpeg_finish_decompress(&info);
  });
  return true;
}

}  // namespace sateen::io
