// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstring>

#include "sateen/io/image_error.h"
#include "sateen/io/picture_codecs.h"
#include "sateen/io/tiff_stream.h"

namespace sateen::io {
namespace {

constexpr std::uint32_t kLongest = 1 << 24;  // pixels along a side of a window

/// How a TIFF stores its pixels.
struct Storage {
  int bits = 1;
  int samples = 1;  ///< per pixel
  int photometric = PHOTOMETRIC_MINISBLACK;
  bool planar = false;  ///< a plane for each channel
  bool tiled = false;
  int band = 1;  ///< rows decoded together: of a tile, or of a strip of planes
};

class TiffSource final : public PictureSource {
 public:
  explicit TiffSource(PictureBytes bytes)
      : bytes_(std::move(bytes)),
        tiff_(bytes_.stream.get(), bytes_.name, "rm",
              static_cast<tmsize_t>(std::max(1e6, static_cast<double>(bytes_.count) * header_.swelling))) {
    if (tiff_.get() == nullptr)
      fail(bytes_.name, "cannot be read as a picture: " + image_reason(tiff_.fault()));
    if (!understood()) return;
    header_.width = static_cast<int>(std::min<std::uint32_t>(tiff_.tag(TIFFTAG_IMAGEWIDTH, 0u), INT32_MAX));
    header_.height = static_cast<int>(std::min<std::uint32_t>(tiff_.tag(TIFFTAG_IMAGELENGTH, 0u), INT32_MAX));
    if (tiff_.tag(TIFFTAG_IMAGEDEPTH, 1u) > 1) fail(bytes_.name, "is a volume, a flat picture is needed");
    header_.channels = storage_.photometric == PHOTOMETRIC_PALETTE ? 3 : storage_.samples;
    header_.bits = storage_.photometric == PHOTOMETRIC_PALETTE ? 8 : storage_.bits;
    header_.floating = storage_.bits == 32;
    header_.samples = storage_.bits == 32   ? SampleType::f32
                      : storage_.bits == 16 ? SampleType::u16
                                            : SampleType::u8;
    const int orientation = tiff_.tag<std::uint16_t>(TIFFTAG_ORIENTATION, 1);
    header_.orientation = orientation >= 1 && orientation <= 8 ? orientation : 1;
    read_window();
    read_alpha();
    read_palette();
    read_profile();
    known_ = true;
  }

  /// Whether this file is one of those that are read here.
  bool known() const { return known_; }

  void read(int rows, void* out) override {
    auto* to = static_cast<std::byte*>(out);
    for (int i = 0; i < rows; ++i, ++next_, to += header_.row_bytes()) {
      if (storage_.tiled || storage_.planar) {
        if (next_ % storage_.band == 0) decode_band();
        convert(band_.data() + stored_row_ * static_cast<std::size_t>(next_ % storage_.band), to);
      } else {
        band_.resize(static_cast<std::size_t>(TIFFScanlineSize(tiff_.get())));
        check(TIFFReadScanline(tiff_.get(), band_.data(), static_cast<std::uint32_t>(next_), 0) == 1);
        convert(band_.data(), to);
      }
    }
  }

 private:
  bool understood() {
    storage_.bits = tiff_.tag<std::uint16_t>(TIFFTAG_BITSPERSAMPLE, 1);
    storage_.samples = tiff_.tag<std::uint16_t>(TIFFTAG_SAMPLESPERPIXEL, 1);
    storage_.photometric = tiff_.tag<std::uint16_t>(TIFFTAG_PHOTOMETRIC, 0xffff);
    storage_.planar =
        tiff_.tag<std::uint16_t>(TIFFTAG_PLANARCONFIG, 1) == PLANARCONFIG_SEPARATE && storage_.samples > 1;
    storage_.tiled = TIFFIsTiled(tiff_.get()) != 0;
    const int format = tiff_.tag<std::uint16_t>(TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
    if (storage_.photometric == PHOTOMETRIC_SEPARATED) fail(bytes_.name, "is CMYK; convert it to RGB first");
    if (format == SAMPLEFORMAT_INT)
      fail(bytes_.name, "has signed samples; save it with unsigned or float samples");
    if (storage_.photometric == PHOTOMETRIC_YCBCR) {
      if (tiff_.tag<std::uint16_t>(TIFFTAG_COMPRESSION, 1) != COMPRESSION_JPEG || storage_.planar)
        return false;
      TIFFSetField(tiff_.get(), TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
      storage_.photometric = PHOTOMETRIC_RGB;
    }
    const int bits = storage_.bits;
    const bool whole = bits == 8 || bits == 16;
    const bool few = (bits == 1 || bits == 2 || bits == 4) && storage_.samples == 1 && !storage_.tiled;
    const bool integer = format == SAMPLEFORMAT_UINT || format == SAMPLEFORMAT_VOID;
    const bool floating = format == SAMPLEFORMAT_IEEEFP && bits == 32;
    switch (storage_.photometric) {
      case PHOTOMETRIC_MINISBLACK:
        return (integer && (whole || few)) || floating;
      case PHOTOMETRIC_MINISWHITE:
        return integer && (whole || few);
      case PHOTOMETRIC_RGB:
        return storage_.samples >= 3 && ((integer && whole) || floating);
      case PHOTOMETRIC_PALETTE:
        return integer && storage_.samples == 1 && (few || bits == 8);
      default:
        return false;
    }
  }

  /// The part of a larger picture that this one is, as renderers and compositors store it.
  void read_window() {
    const int width = static_cast<int>(std::min(tiff_.tag(TIFFTAG_PIXAR_IMAGEFULLWIDTH, 0u), kLongest));
    const int height = static_cast<int>(std::min(tiff_.tag(TIFFTAG_PIXAR_IMAGEFULLLENGTH, 0u), kLongest));
    if (width == 0 || height == 0) return;
    const auto position = [&](std::uint32_t tag) {
      const float value = tiff_.tag(tag, 0.0f);
      return value >= 0 && value <= static_cast<float>(kLongest) ? static_cast<int>(value) : 0;
    };
    header_.window = {-position(TIFFTAG_XPOSITION), -position(TIFFTAG_YPOSITION), width, height};
  }

  void read_alpha() {
    std::uint16_t count = 0;
    std::uint16_t* kinds = nullptr;
    if (TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_EXTRASAMPLES, &count, &kinds) == 0 || kinds == nullptr)
      return;
    for (int i = 0; i < count; ++i) {
      if (kinds[i] != EXTRASAMPLE_ASSOCALPHA && kinds[i] != EXTRASAMPLE_UNASSALPHA) continue;
      header_.alpha = header_.channels - count + i;
      header_.associated = kinds[i] == EXTRASAMPLE_ASSOCALPHA;
      return;
    }
  }

  void read_palette() {
    std::array<std::uint16_t*, 3> maps{};
    if (storage_.photometric != PHOTOMETRIC_PALETTE) return;
    if (TIFFGetField(tiff_.get(), TIFFTAG_COLORMAP, maps.data(), &maps[1], &maps[2]) == 0)
      fail(bytes_.name, "cannot be read as a picture: its palette is missing");
    for (std::size_t i = 0; i < std::size_t{1} << storage_.bits; ++i) {
      for (const std::uint16_t* map : maps) palette_.push_back(static_cast<std::uint8_t>(map[i] / 257));
    }
  }

  void read_profile() {
    std::uint32_t size = 0;
    const std::byte* profile = nullptr;
    if (TIFFGetField(tiff_.get(), TIFFTAG_ICCPROFILE, &size, &profile) != 0)
      header_.colour.icc.assign(profile, profile + size);
  }

  void check(bool fine) const {
    if (!fine) fail(bytes_.name, "is truncated or corrupt: " + image_reason(tiff_.fault()));
  }

  std::size_t sample_size() const { return sample_bytes(header_.samples); }

  /// Decodes the strips or tiles that hold row next_, and puts their samples side by side.
  void decode_band() {
    const auto samples = static_cast<std::size_t>(storage_.samples);
    stored_row_ = static_cast<std::size_t>(header_.width) * samples * sample_size();
    std::uint32_t across = static_cast<std::uint32_t>(header_.width);
    if (storage_.tiled) {
      storage_.band = static_cast<int>(tiff_.tag(TIFFTAG_TILELENGTH, 1u));
      across = tiff_.tag(TIFFTAG_TILEWIDTH, 1u);
    } else {
      storage_.band = static_cast<int>(
          std::min(tiff_.tag(TIFFTAG_ROWSPERSTRIP, 1u), static_cast<std::uint32_t>(header_.height)));
    }
    const auto piece =
        static_cast<std::size_t>(storage_.tiled ? TIFFTileSize(tiff_.get()) : TIFFStripSize(tiff_.get()));
    if (storage_.band < 1 || across < 1 ||
        static_cast<double>(piece) > static_cast<double>(bytes_.count) * header_.swelling) {
      fail(bytes_.name, "claims tiles or strips of more pixels than its bytes can hold");
    }
    band_.resize(stored_row_ * static_cast<std::size_t>(storage_.band));
    piece_.resize(piece);
    for (std::uint32_t x = 0; x < static_cast<std::uint32_t>(header_.width); x += across) {
      for (std::size_t plane = 0; plane < (storage_.planar ? samples : 1); ++plane) {
        check(decode_piece(x, static_cast<std::uint16_t>(plane)));
        place(x, across, plane);
      }
    }
  }

  bool decode_piece(std::uint32_t x, std::uint16_t plane) {
    const auto y = static_cast<std::uint32_t>(next_);
    if (storage_.tiled) {
      return TIFFReadEncodedTile(tiff_.get(), TIFFComputeTile(tiff_.get(), x, y, 0, plane), piece_.data(),
                                 static_cast<tmsize_t>(piece_.size())) >= 0;
    }
    return TIFFReadEncodedStrip(tiff_.get(), TIFFComputeStrip(tiff_.get(), y, plane), piece_.data(),
                                static_cast<tmsize_t>(piece_.size())) >= 0;
  }

  /// Copies the decoded piece, whose left edge lies at `x`, into the band.
  void place(std::uint32_t x, std::uint32_t across, std::size_t plane) {
    const std::size_t size = sample_size();
    const std::size_t together = storage_.planar ? 1 : static_cast<std::size_t>(storage_.samples);
    const std::size_t step = static_cast<std::size_t>(storage_.samples) * size;
    const std::size_t columns = std::min(across, static_cast<std::uint32_t>(header_.width) - x);
    const int rows = std::min(storage_.band, header_.height - next_);
    for (int y = 0; y < rows; ++y) {
      const std::byte* from = piece_.data() + static_cast<std::size_t>(y) * across * together * size;
      std::byte* to = band_.data() + static_cast<std::size_t>(y) * stored_row_ + x * step + plane * size;
      for (std::size_t i = 0; i < columns; ++i)
        std::memcpy(to + i * step, from + i * together * size, together * size);
    }
  }

  /// A stored row as the row of a PictureSource.
  void convert(const std::byte* stored, std::byte* out) const {
    const auto width = static_cast<std::size_t>(header_.width);
    if (storage_.bits < 8 || !palette_.empty()) {
      convert_small(reinterpret_cast<const std::uint8_t*>(stored), reinterpret_cast<std::uint8_t*>(out));
      return;
    }
    const std::size_t in_pixel = static_cast<std::size_t>(storage_.samples) * sample_size();
    const std::size_t out_pixel = static_cast<std::size_t>(header_.delivered()) * sample_size();
    if (in_pixel == out_pixel) {
      std::memcpy(out, stored, header_.row_bytes());
    } else {
      for (std::size_t x = 0; x < width; ++x)
        std::memcpy(out + x * out_pixel, stored + x * in_pixel, out_pixel);
    }
    if (storage_.photometric != PHOTOMETRIC_MINISWHITE) return;
    const std::size_t bytes = header_.row_bytes();  // 255 - v and 65535 - v are all bits turned
    for (std::size_t i = 0; i < bytes; ++i) out[i] = ~out[i];
  }

  void convert_small(const std::uint8_t* stored, std::uint8_t* out) const {
    const auto bits = static_cast<std::size_t>(storage_.bits);
    const unsigned most = (1u << bits) - 1;
    for (std::size_t x = 0; x < static_cast<std::size_t>(header_.width); ++x) {
      const std::size_t bit = x * bits;
      const unsigned value = stored[bit / 8] >> (8 - bits - bit % 8) & most;
      if (!palette_.empty()) {
        out = std::copy_n(palette_.data() + std::size_t{3} * value, 3, out);
      } else {
        const unsigned grey = value * 255 / most;
        *out++ =
            static_cast<std::uint8_t>(storage_.photometric == PHOTOMETRIC_MINISWHITE ? 255 - grey : grey);
      }
    }
  }

  PictureBytes bytes_;
  TiffStream tiff_;
  Storage storage_;
  bool known_ = false;
  std::vector<std::uint8_t> palette_;  ///< three a colour
  std::vector<std::byte> band_;
  std::vector<std::byte> piece_;
  std::size_t stored_row_ = 0;  ///< bytes of a row of the band
  int next_ = 0;
};

}  // namespace

SourcePtr open_tiff(PictureBytes bytes) {
  auto source = std::make_unique<TiffSource>(std::move(bytes));
  if (!source->known()) return nullptr;
  return source;
}

}  // namespace sateen::io
