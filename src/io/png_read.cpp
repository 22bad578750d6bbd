// SPDX-License-Identifier: MIT
#include <cstring>

#include <fmt/format.h>

#include "sateen/io/exif.h"
#include "sateen/io/picture_codecs.h"
#include "sateen/io/png_escape.h"

namespace sateen::io {
namespace {

struct PngDecoder {
  png_structp png = nullptr;
  png_infop info = nullptr;
  ~PngDecoder() { png_destroy_read_struct(&png, &info, nullptr); }
};

/// The colours that the code points of ITU-T H.273 name.
StoredColour coded_colour(int primaries, int transfer) {
  constexpr int kBt709 = 1;
  constexpr int kUnspecified = 2;
  constexpr int kBt2020 = 9;
  constexpr int kP3 = 12;
  constexpr int kLinear = 8;
  constexpr int kSrgb = 13;
  StoredColour colour;
  if (primaries == kBt2020) {
    colour.chromaticities = Chromaticities{{0.708, 0.292, 0.170, 0.797, 0.131, 0.046, 0.3127, 0.3290}};
  } else if (primaries == kP3) {
    colour.chromaticities = Chromaticities{{0.680, 0.320, 0.265, 0.690, 0.150, 0.060, 0.3127, 0.3290}};
  } else if (primaries != kBt709 && primaries != kUnspecified) {
    colour.ignored.push_back(fmt::format("set of primaries (code point {})", primaries));
  }
  if (transfer == kLinear) {
    colour.gamma = 1;
  } else if (transfer != kSrgb && transfer != kUnspecified) {
    colour.ignored.push_back(fmt::format("transfer function (code point {})", transfer));
  }
  return colour;
}

class PngSource final : public PictureSource {
 public:
  explicit PngSource(PictureBytes bytes) : bytes_(std::move(bytes)) {
    decoder_.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &escape_, leave_png, ignore_png);
    decoder_.info = png_create_info_struct(decoder_.png);
    guarded("cannot be read as a picture: ", [this] { read_header(); });
    read_colour();
  }

  void read(int rows, void* out) override {
    if (interlaced_ && next_ == 0) {
      whole_.resize(header_.row_bytes() * static_cast<std::size_t>(header_.height));
    }
    guarded("is truncated or corrupt: ", [&] {
      if (interlaced_) {
        read_interlaced(rows, static_cast<png_bytep>(out));
      } else {
        for (int i = 0; i < rows; ++i) {
          png_read_row(decoder_.png,
                       static_cast<png_bytep>(out) + header_.row_bytes() * static_cast<std::size_t>(i),
                       nullptr);
        }
      }
      next_ += rows;
      if (next_ == header_.height) png_read_end(decoder_.png, nullptr);
    });
  }

 private:
  template <class Work>
  void guarded(const char* fault, const Work& work) {
    guarded_png(escape_, bytes_.name, fault, work);
  }

  void read_header() {
    png_structp png = decoder_.png;
    png_infop info = decoder_.info;
    png_byte cicp[] = "cICP";
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_ALWAYS, cicp, 1);
    png_init_io(png, bytes_.stream.get());
    png_read_info(png, info);
    // 1, 2 and 4 bits become 8, palettes colours, a transparent colour alpha.
    png_set_expand(png);
    if (png_get_bit_depth(png, info) == 16) png_set_swap(png);
    passes_ = png_set_interlace_handling(png);
    interlaced_ = passes_ > 1;
    png_read_update_info(png, info);
    header_.width = static_cast<int>(png_get_image_width(png, info));
    header_.height = static_cast<int>(png_get_image_height(png, info));
    header_.channels = png_get_channels(png, info);
    header_.bits = png_get_bit_depth(png, info);
    header_.samples = header_.bits == 16 ? SampleType::u16 : SampleType::u8;
    if (header_.channels % 2 == 0) header_.alpha = header_.channels - 1;
  }

  void read_colour() {
    png_structp png = decoder_.png;
    png_infop info = decoder_.info;
    png_uint_32 exif_size = 0;
    png_bytep exif = nullptr;
    if (png_get_eXIf_1(png, info, &exif_size, &exif) != 0) {
      header_.orientation = read_exif(std::as_bytes(std::span(exif, exif_size))).orientation;
    }
    StoredColour& colour = header_.colour;
    int intent = 0;
    colour.srgb = png_get_sRGB(png, info, &intent) != 0;
    png_charp name = nullptr;
    int compression = 0;
    png_bytep profile = nullptr;
    png_uint_32 size = 0;
    if (png_get_iCCP(png, info, &name, &compression, &profile, &size) != 0) {
      const auto profile_bytes = std::as_bytes(std::span(profile, size));
      colour.icc.assign(profile_bytes.begin(), profile_bytes.end());
    }
    double gamma = 0;
    if (png_get_gAMA(png, info, &gamma) != 0 && gamma > 0) colour.gamma = 1 / gamma;
    std::array<double, 8> xy{};
    if (png_get_cHRM(png, info, &xy[6], &xy[7], &xy[0], &xy[1], &xy[2], &xy[3], &xy[4], &xy[5]) != 0) {
      colour.chromaticities = Chromaticities{xy};
    }
    read_code_points();
  }

  /// cICP goes before every other chunk about colour, and libpng 1.6 does not know it.
  void read_code_points() {
    png_unknown_chunkp chunks = nullptr;
    const int count = png_get_unknown_chunks(decoder_.png, decoder_.info, &chunks);
    for (int i = 0; i < count; ++i) {
      if (std::memcmp(chunks[i].name, "cICP", 4) == 0 && chunks[i].size == 4)
        header_.colour = coded_colour(chunks[i].data[0], chunks[i].data[1]);
    }
  }

  void read_interlaced(int rows, png_bytep out) {
    const std::size_t row = header_.row_bytes();
    if (next_ == 0) {
      for (int pass = 0; pass < passes_; ++pass) {
        for (int y = 0; y < header_.height; ++y)
          png_read_row(decoder_.png, whole_.data() + row * static_cast<std::size_t>(y), nullptr);
      }
    }
    std::copy_n(whole_.data() + row * static_cast<std::size_t>(next_), row * static_cast<std::size_t>(rows),
                out);
  }

  PictureBytes bytes_;
  PngEscape escape_;
  PngDecoder decoder_;
  int passes_ = 1;
  bool interlaced_ = false;
  std::vector<png_byte> whole_;
  int next_ = 0;
};

}  // namespace

SourcePtr open_png(PictureBytes bytes) {
  return std::make_unique<PngSource>(std::move(bytes));
}

}  // namespace sateen::io
