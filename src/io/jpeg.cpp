// SPDX-License-Identifier: MIT
#include "sateen/io/jpeg.h"

#include <algorithm>
#include <csetjmp>
#include <cstdio>  // jpeglib.h needs it

#include <jerror.h>
#include <jpeglib.h>

#include "sateen/io/image_error.h"

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
  if (code == JWRN_JFIF_MAJOR || code == JWRN_ADOBE_XFORM) return;
  constexpr int kEndOfImage = 0xd9;
  if (code == JWRN_EXTRANEOUS_DATA && info->err->msg_parm.i[1] == kEndOfImage && only_padding(info)) return;
  leave(info);
}

/// Ends the decoder whichever way its scope is left.
struct Decoder {
  jpeg_decompress_struct info{};
  ~Decoder() { jpeg_destroy_decompress(&info); }
};

constexpr int kExifMarker = JPEG_APP0 + 1;

/// A whole number of an EXIF block; 0 beyond its end.
unsigned exif_number(std::span<const JOCTET> exif, std::size_t at, std::size_t bytes, bool big_endian) {
  if (at + bytes > exif.size()) return 0;
  unsigned value = 0;
  for (std::size_t i = 0; i < bytes; ++i) value = value << 8 | exif[at + (big_endian ? i : bytes - 1 - i)];
  return value;
}

/// 1 for a picture as it should be seen, to 8; 1 as well where the file does not say.
unsigned exif_orientation(const jpeg_decompress_struct& info) {
  constexpr std::size_t kTiff = 6;  // behind "Exif" and two zeros
  for (auto* marker = info.marker_list; marker != nullptr; marker = marker->next) {
    const std::span<const JOCTET> exif(marker->data, marker->data_length);
    if (marker->marker != kExifMarker || exif.size() < kTiff + 8 || exif[0] != 'E') continue;
    const bool big_endian = exif[kTiff] == 'M';
    const std::size_t directory = kTiff + exif_number(exif, kTiff + 4, 4, big_endian);
    const unsigned entries = exif_number(exif, directory, 2, big_endian);
    for (std::size_t i = 0; i < entries; ++i) {
      const std::size_t entry = directory + 2 + 12 * i;
      constexpr unsigned kOrientation = 0x0112;
      if (exif_number(exif, entry, 2, big_endian) != kOrientation) continue;
      const unsigned orientation = exif_number(exif, entry + 8, 2, big_endian);
      return orientation >= 1 && orientation <= 8 ? orientation : 1;
    }
  }
  return 1;
}

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

/// Decodes row by row: `start(info)` looks at the header and may decline with false, which is returned then;
/// `place(y)` says where row y goes, `done(y)` hears that it is there. Of `only` (may be null) the rows, and
/// of them at least its columns. libjpeg's errors jump out of here: what owns memory belongs to the caller.
template <class Start, class Place, class Done>
bool decode_rows(const std::filesystem::path& path, std::span<const std::byte> bytes, const PixelRect* only,
                 const Start& start, const Place& place, const Done& done) {
  ErrorManager errors{};
  Decoder decoder;
  jpeg_decompress_struct& info = decoder.info;
  info.err = jpeg_std_error(&errors.base);
  errors.base.error_exit = leave;
  errors.base.emit_message = on_message;
  if (setjmp(errors.escape) != 0) {
    fail(path, "is truncated or corrupt: " + image_reason(errors.message));
  }
  jpeg_create_decompress(&info);
  jpeg_save_markers(&info, kExifMarker, 0xffff);
  jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()),
               static_cast<unsigned long>(bytes.size()));
  jpeg_read_header(&info, TRUE);
  if (!start(info)) return false;
  jpeg_start_decompress(&info);
  const Band band = only == nullptr ? Band{0, info.output_height} : crop(info, *only);
  while (info.output_scanline < band.end) {
    const auto y = static_cast<int>(info.output_scanline);
    JSAMPROW row = place(y) + band.first_column * static_cast<JDIMENSION>(info.output_components);
    jpeg_read_scanlines(&info, &row, 1);
    done(y);
  }
  if (band.end == info.output_height) jpeg_finish_decompress(&info);
  return true;
}

}  // namespace

Image decode_jpeg(const std::filesystem::path& path, std::span<const std::byte> bytes,
                  const PixelRect& region, std::span<const float, 256> values) {
  Image image;
  std::vector<JSAMPLE> row;
  std::size_t channels = 0;
  const auto start = [&](jpeg_decompress_struct& info) {
    jpeg_calc_output_dimensions(&info);
    channels = static_cast<std::size_t>(info.output_components);
    image = Image(region.width, region.height, info.output_components);
    row.resize(info.output_width * channels);
    return true;
  };
  const auto done = [&](int at) {
    const int y = at - region.y;
    if (y < 0 || y >= region.height) return;
    const JSAMPLE* in = row.data() + static_cast<std::size_t>(region.x) * channels;
    std::transform(in, in + static_cast<std::size_t>(region.width) * channels, image.pixel(0, y).data(),
                   [&](JSAMPLE v) { return values[v]; });
  };
  decode_rows(
      path, bytes, nullptr, start, [&](int) { return row.data(); }, done);
  return image;
}

bool decode_plain_jpeg(const std::filesystem::path& path, std::span<const std::byte> bytes, Picture8& picture,
                       const PixelRect* only) {
  if (bytes.size() < 2 || bytes[0] != std::byte{0xff} || bytes[1] != std::byte{0xd8}) return false;
  std::size_t stride = 0;
  const auto start = [&](jpeg_decompress_struct& info) {
    const bool colours = info.jpeg_color_space == JCS_YCbCr || info.jpeg_color_space == JCS_RGB ||
                         info.jpeg_color_space == JCS_GRAYSCALE;
    if (!colours || exif_orientation(info) != 1) return false;
    info.out_color_space = JCS_RGB;
    picture.width = static_cast<int>(info.image_width);
    picture.height = static_cast<int>(info.image_height);
    stride = static_cast<std::size_t>(picture.width) * 3;
    picture.rgb.resize(stride * info.image_height);
    return true;
  };
  const auto place = [&](int y) { return picture.rgb.data() + static_cast<std::size_t>(y) * stride; };
  return decode_rows(path, bytes, only, start, place, [](int) {});
}

}  // namespace sateen::io
