// SPDX-License-Identifier: MIT
#include "sateen/io/jpeg.h"

#include <algorithm>
#include <csetjmp>
#include <cstdio>  // jpeglib.h needs it

#include <jerror.h>
#include <jpeglib.h>

#include "sateen/io/image_error.h"

namespace sateen {
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

}  // namespace

Image decode_jpeg(const std::filesystem::path& path, std::span<const std::byte> bytes,
                  const PixelRect& region, std::span<const float, 256> values) {
  ErrorManager errors{};
  Decoder decoder;
  Image image;
  std::vector<JSAMPLE> row;  // whatever owns memory stands before setjmp, so that a jump skips no destructor
  jpeg_decompress_struct& info = decoder.info;
  info.err = jpeg_std_error(&errors.base);
  errors.base.error_exit = leave;
  errors.base.emit_message = on_message;
  if (setjmp(errors.escape) != 0) {
    fail(path, "is truncated or corrupt: " + image_reason(errors.message));
  }
  jpeg_create_decompress(&info);
  jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()),
               static_cast<unsigned long>(bytes.size()));
  jpeg_read_header(&info, TRUE);
  jpeg_start_decompress(&info);
  image = Image(region.width, region.height, info.output_components);
  const auto channels = static_cast<std::size_t>(info.output_components);
  row.resize(info.output_width * channels);
  while (info.output_scanline < info.output_height) {
    const int y = static_cast<int>(info.output_scanline) - region.y;
    JSAMPROW rows = row.data();
    jpeg_read_scanlines(&info, &rows, 1);
    if (y < 0 || y >= region.height) continue;
    const JSAMPLE* in = row.data() + static_cast<std::size_t>(region.x) * channels;
    std::transform(in, in + static_cast<std::size_t>(region.width) * channels, image.pixel(0, y).data(),
                   [&](JSAMPLE v) { return values[v]; });
  }
  jpeg_finish_decompress(&info);
  return image;
}

}  // namespace sateen
