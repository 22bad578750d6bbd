// SPDX-License-Identifier: MIT
// What our readers make of files in all layouts, against OpenImageIO; both read the same bytes.
#include <algorithm>
#include <cmath>
#include <functional>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <half.h>
#include <png.h>
#include <tiffio.h>

#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "sateen/io/image_memory.h"
#include "sateen/io/image_rows.h"
#include "support/files.h"

namespace sateen::io {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;
using ::testing::HasSubstr;

/// Samples that differ in every corner and channel; in [0, 1].
std::vector<float> samples(int width, int height, int channels) {
  std::vector<float> values;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < channels; ++c) {
        values.push_back(0.5f + 0.3f * std::sin(0.7f * static_cast<float>(x) + 1.3f * static_cast<float>(c)) +
                         0.2f * std::cos(0.4f * static_cast<float>(y) - static_cast<float>(c)));
      }
    }
  }
  return values;
}

/// Writes by OpenImageIO; false where its format cannot hold that.
bool write(const fs::path& path, OIIO::ImageSpec spec, bool tiled = false) {
  auto out = OIIO::ImageOutput::create(path.string());
  if (tiled) spec.tile_width = spec.tile_height = 16;
  if (!out || (tiled && out->supports("tiles") == 0) || !out->open(path.string(), spec)) {
    static_cast<void>(OIIO::geterror());
    return false;
  }
  const bool written =
      out->write_image(OIIO::TypeDesc::FLOAT, samples(spec.width, spec.height, spec.nchannels).data());
  return out->close() && written;
}

/// The file as it is stored, by OpenImageIO.
Image by_openimageio(const fs::path& path) {
  OIIO::ImageSpec wishes;
  wishes["oiio:UnassociatedAlpha"] = 1;
  const auto in = OIIO::ImageInput::open(path.string(), &wishes);
  if (!in) throw std::runtime_error(OIIO::geterror());
  const int channels = std::min(in->spec().nchannels, 4);
  Image image(in->spec().width, in->spec().height, channels);
  if (!in->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, image.data.data()))
    throw std::runtime_error(in->geterror());
  return image;
}

void expect_as_openimageio(const fs::path& path) {
  SCOPED_TRACE(path.filename());
  const Image expected = by_openimageio(path);
  const Image image = read_data(path);
  ASSERT_EQ(image.width, expected.width);
  ASSERT_EQ(image.height, expected.height);
  ASSERT_EQ(image.channels, expected.channels);
  std::size_t different = 0;
  for (std::size_t i = 0; i < image.data.size(); ++i) different += image.data[i] == expected.data[i] ? 0 : 1;
  EXPECT_EQ(different, 0u) << "of " << image.data.size();

  const auto in = OIIO::ImageInput::open(path.string());
  const OIIO::ImageSpec& spec = in->spec();
  const ImageInfo info = read_image_info(path);
  EXPECT_EQ(info.channels, spec.nchannels);
  EXPECT_EQ(info.bits,
            spec.get_int_attribute("oiio:BitsPerSample", static_cast<int>(spec.format.size()) * 8));
  EXPECT_EQ(info.floating, spec.format.is_floating_point());

  ImageRowReader rows(path);
  Image streamed(rows.width(), rows.height(), rows.channels());
  const std::size_t row = static_cast<std::size_t>(rows.width()) * static_cast<std::size_t>(rows.channels());
  for (int y = 0; y < rows.height();) {
    const int count = std::min(7, rows.height() - y);
    rows.read(std::span(streamed.data)
                  .subspan(static_cast<std::size_t>(y) * row, static_cast<std::size_t>(count) * row));
    y += count;
  }
  EXPECT_EQ(streamed.data, image.data);
}

TEST(Formats, EverySampleTypeAndChannelCountIsReadAsOpenImageIoReadsIt) {
  const TemporaryFolder folder;
  int files = 0;
  for (const auto& [extension, types] : std::vector<std::pair<std::string, std::vector<OIIO::TypeDesc>>>{
           {".png", {OIIO::TypeDesc::UINT8, OIIO::TypeDesc::UINT16}},
           {".tif",
            {OIIO::TypeDesc::UINT8, OIIO::TypeDesc::UINT16, OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::HALF,
             OIIO::TypeDesc::UINT32, OIIO::TypeDesc::DOUBLE}},
           {".exr", {OIIO::TypeDesc::HALF, OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::UINT32}},
           {".hdr", {OIIO::TypeDesc::FLOAT}},
           {".webp", {OIIO::TypeDesc::UINT8}}}) {
    for (const OIIO::TypeDesc& type : types) {
      for (const int channels : {1, 2, 3, 4, 6}) {
        for (const bool tiled : {false, true}) {
          // One number of channels in tiles stands for all; OpenImageIO 2.4 writes tiles of doubles wrongly.
          if (tiled && (channels != 3 || type == OIIO::TypeDesc::DOUBLE)) continue;
          if (extension == ".webp" && channels == 4)
            continue;  // OpenImageIO 2.4 multiplies by alpha unasked: compared with its PNG below
          const fs::path path =
              folder / fmt::format("{}_{}{}{}", type.c_str(), channels, tiled ? "_tiled" : "", extension);
          OIIO::ImageSpec spec(37, 43, channels, type);
          if (!write(path, spec, tiled)) continue;
          expect_as_openimageio(path);
          ++files;
        }
      }
    }
  }
  EXPECT_GE(files, 50);
}

TEST(Formats, TiffsOfAllKinds) {
  const TemporaryFolder folder;
  for (const char* compression : {"none", "lzw", "zip", "packbits"}) {
    for (const char* planes : {"contig", "separate"}) {
      for (const bool tiled : {false, true}) {
        for (const int channels : {1, 3, 4}) {
          OIIO::ImageSpec spec(45, 70, channels, OIIO::TypeDesc::UINT16);
          spec["compression"] = compression;
          spec["planarconfig"] = planes;
          spec["oiio:UnassociatedAlpha"] = channels == 4 && tiled ? 1 : 0;
          const fs::path path = folder / fmt::format("{}_{}_{}_{}.tif", compression, planes, tiled, channels);
          ASSERT_TRUE(write(path, spec, tiled));
          expect_as_openimageio(path);
        }
      }
    }
  }
  for (const int bits : {1, 2, 4}) {
    OIIO::ImageSpec spec(37, 23, 1, OIIO::TypeDesc::UINT8);
    spec["oiio:BitsPerSample"] = bits;
    ASSERT_TRUE(write(folder / fmt::format("{}_bits.tif", bits), spec));
    expect_as_openimageio(folder / fmt::format("{}_bits.tif", bits));
  }
}

/// Writes by libtiff: grey where black is the most, palettes, both byte orders.
void write_tiff(const fs::path& path, const char* mode, int bits, std::uint16_t photometric,
                int samples_per_pixel, std::uint16_t format = SAMPLEFORMAT_UINT,
                std::uint16_t extra = EXTRASAMPLE_UNSPECIFIED) {
  constexpr int kWidth = 21;
  constexpr int kHeight = 9;
  TIFF* tiff = TIFFOpen(path.c_str(), mode);
  ASSERT_NE(tiff, nullptr);
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, kWidth);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, kHeight);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, bits);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, samples_per_pixel);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, format);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, photometric);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 4);
  if (samples_per_pixel == 4) TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &extra);
  std::array<std::vector<std::uint16_t>, 3> map;
  for (std::size_t i = 0; i < std::size_t{1} << std::min(bits, 8); ++i) {
    for (std::size_t c = 0; c < 3; ++c) map[c].push_back(static_cast<std::uint16_t>(i * 257 * (c + 1)));
  }
  if (photometric == PHOTOMETRIC_PALETTE)
    TIFFSetField(tiff, TIFFTAG_COLORMAP, map[0].data(), map[1].data(), map[2].data());
  std::vector<std::uint8_t> row(static_cast<std::size_t>(TIFFScanlineSize(tiff)));
  for (int y = 0; y < kHeight; ++y) {
    for (std::size_t i = 0; i < row.size(); ++i)
      row[i] = static_cast<std::uint8_t>(17 * i + 31 * static_cast<std::size_t>(y));
    ASSERT_EQ(TIFFWriteScanline(tiff, row.data(), static_cast<std::uint32_t>(y), 0), 1);
  }
  TIFFClose(tiff);
}

TEST(Formats, TiffsOfOtherPrograms) {
  const TemporaryFolder folder;
  for (const char* mode : {"wl", "wb", "w8"}) {  // little and big endian, BigTIFF
    for (const int bits : {1, 2, 4, 8, 16}) {
      for (const int photometric : {PHOTOMETRIC_MINISBLACK, PHOTOMETRIC_MINISWHITE, PHOTOMETRIC_PALETTE}) {
        if (photometric == PHOTOMETRIC_PALETTE && bits == 16) continue;
        // OpenImageIO 2.4 forgets that 0 is white there.
        if (photometric == PHOTOMETRIC_MINISWHITE && bits == 16) continue;
        const fs::path path = folder / fmt::format("{}_{}_{}.tif", mode, bits, photometric);
        write_tiff(path, mode, bits, static_cast<std::uint16_t>(photometric), 1);
        expect_as_openimageio(path);
      }
    }
    for (const int samples_per_pixel : {3, 4}) {
      for (const int extra : {EXTRASAMPLE_UNSPECIFIED, EXTRASAMPLE_ASSOCALPHA, EXTRASAMPLE_UNASSALPHA}) {
        const fs::path path = folder / fmt::format("{}_rgb_{}_{}.tif", mode, samples_per_pixel, extra);
        write_tiff(path, mode, 16, PHOTOMETRIC_RGB, samples_per_pixel, SAMPLEFORMAT_UINT,
                   static_cast<std::uint16_t>(extra));
        expect_as_openimageio(path);
      }
    }
  }
}

TEST(Formats, SignedSamplesAreRefused) {
  const TemporaryFolder folder;
  for (const int bits : {8, 16}) {
    write_tiff(folder / "signed.tif", "w", bits, PHOTOMETRIC_MINISBLACK, 1, SAMPLEFORMAT_INT);
    try {
      read_image(folder / "signed.tif");
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("signed"));
    }
  }
}

/// Writes by libpng, of every colour type and depth, interlaced or not.
void write_png(const fs::path& path, int type, int depth, bool interlaced, bool transparent) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, 37, 23, depth, type, interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  std::vector<png_color> palette;
  std::vector<png_byte> alphas;
  for (int i = 0; i < 1 << std::min(depth, 8); ++i) {
    palette.push_back(
        {static_cast<png_byte>(i * 7), static_cast<png_byte>(255 - i), static_cast<png_byte>(i)});
    alphas.push_back(static_cast<png_byte>(i * 3));
  }
  if (type == PNG_COLOR_TYPE_PALETTE)
    png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
  png_color_16 colour{};
  colour.gray = 1;
  if (transparent && type == PNG_COLOR_TYPE_PALETTE) {
    png_set_tRNS(png, info, alphas.data(), static_cast<int>(alphas.size()), nullptr);
  } else if (transparent) {
    png_set_tRNS(png, info, nullptr, 0, &colour);
  }
  png_write_info(png, info);
  std::vector<std::vector<png_byte>> rows(23, std::vector<png_byte>(png_get_rowbytes(png, info)));
  std::vector<png_bytep> pointers;
  for (std::size_t y = 0; y < rows.size(); ++y) {
    for (std::size_t i = 0; i < rows[y].size(); ++i) rows[y][i] = static_cast<png_byte>(13 * i + 41 * y);
    pointers.push_back(rows[y].data());
  }
  png_write_image(png, pointers.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
}

TEST(Formats, PngsOfAllKinds) {
  const TemporaryFolder folder;
  for (const int type : {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                         PNG_COLOR_TYPE_RGB_ALPHA, PNG_COLOR_TYPE_PALETTE}) {
    for (const int depth : {1, 2, 4, 8, 16}) {
      const bool palette = type == PNG_COLOR_TYPE_PALETTE;
      if ((depth < 8 && type != PNG_COLOR_TYPE_GRAY && !palette) || (depth == 16 && palette)) continue;
      for (const bool interlaced : {false, true}) {
        for (const bool transparent : {false, true}) {
          if (transparent && (type & PNG_COLOR_MASK_ALPHA) != 0) continue;
          const fs::path path = folder / fmt::format("{}_{}_{}_{}.png", type, depth, interlaced, transparent);
          write_png(path, type, depth, interlaced, transparent);
          expect_as_openimageio(path);
        }
      }
    }
  }
}

TEST(Formats, ExrsWithAllCompressions) {
  const TemporaryFolder folder;
  for (const char* compression :
       {"none", "rle", "zip", "zips", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"}) {
    for (const bool tiled : {false, true}) {
      OIIO::ImageSpec spec(67, 45, 4, OIIO::TypeDesc::HALF);
      spec["compression"] = compression;
      ASSERT_TRUE(write(folder / "a.exr", spec, tiled)) << compression;
      expect_as_openimageio(folder / "a.exr");
    }
  }
}

TEST(Formats, ChannelsOfAnExrKeepTheOrderOfAPicture) {
  const TemporaryFolder folder;
  for (const std::vector<std::string>& names :
       std::vector<std::vector<std::string>>{{"diffuse.R", "diffuse.G", "diffuse.B", "specular.R"},
                                             {"X", "Y", "Z"},
                                             {"Z", "A", "B", "G", "R"},
                                             {"n.x", "n.y", "n.z", "n.a"},
                                             {"Y", "A"},
                                             {"v", "u"},
                                             {"red", "green", "blue", "alpha"},
                                             {"a.b.G", "a.b.R", "a.c.R", "R"},
                                             {"depth", "foo", "bar"}}) {
    OIIO::ImageSpec spec(9, 5, static_cast<int>(names.size()), OIIO::TypeDesc::FLOAT);
    spec.channelnames = names;
    ASSERT_TRUE(write(folder / "a.exr", spec)) << names[0];
    expect_as_openimageio(folder / "a.exr");
  }
}

TEST(Formats, ExrsWhoseChannelsDifferInType) {
  const TemporaryFolder folder;
  Imf::Header header(13, 7);
  header.channels().insert("R", Imf::Channel(Imf::HALF));
  header.channels().insert("G", Imf::Channel(Imf::FLOAT));
  header.channels().insert("B", Imf::Channel(Imf::UINT));
  std::vector<half> halves(13 * 7);
  std::vector<float> floats(13 * 7);
  std::vector<unsigned> wholes(13 * 7);
  for (std::size_t i = 0; i < floats.size(); ++i) {
    halves[i] = half(0.1f * static_cast<float>(i));
    floats[i] = -3.0f * static_cast<float>(i);
    wholes[i] = static_cast<unsigned>(40000000 * i);
  }
  {
    Imf::OutputFile file((folder / "a.exr").c_str(), header);
    Imf::FrameBuffer frame;
    frame.insert("R", Imf::Slice(Imf::HALF, reinterpret_cast<char*>(halves.data()), 2, 26));
    frame.insert("G", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(floats.data()), 4, 52));
    frame.insert("B", Imf::Slice(Imf::UINT, reinterpret_cast<char*>(wholes.data()), 4, 52));
    file.setFrameBuffer(frame);
    file.writePixels(7);
  }
  expect_as_openimageio(folder / "a.exr");
}

TEST(Formats, HdrsOfAllWidths) {
  const TemporaryFolder folder;
  for (const int width : {1, 7, 8, 37, 300}) {
    ASSERT_TRUE(write(folder / "a.hdr", OIIO::ImageSpec(width, 9, 3, OIIO::TypeDesc::FLOAT)));
    expect_as_openimageio(folder / "a.hdr");
    Image image(width, 9, 3);
    image.data = samples(width, 9, 3);
    write_image(folder / "ours.hdr", image);
    expect_as_openimageio(folder / "ours.hdr");
    write_image(folder / "even.hdr", Image(width, 2, 3, 0.25f));  // long runs
    expect_as_openimageio(folder / "even.hdr");
    EXPECT_EQ(read_data(folder / "even.hdr").at(width - 1, 1, 2), 0.25f);
  }
}

void append(std::vector<std::byte>& bytes, std::initializer_list<int> values) {
  for (const int v : values) bytes.push_back(static_cast<std::byte>(v));
}

std::vector<std::byte> hdr(const std::string& header) {
  const auto bytes = std::as_bytes(std::span(header.data(), header.size()));
  return {bytes.begin(), bytes.end()};
}

TEST(Formats, OldRunsOfHdrsAreRepeatedPixels) {
  const TemporaryFolder folder;
  auto bytes = hdr("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 300\n");
  append(bytes, {128, 64, 32, 129, 1, 1, 1, 2, 200, 0, 0, 128, 1, 1, 1, 40, 1, 1, 1, 1});  // 1+2, 1+40+256
  write_bytes(folder / "a.hdr", bytes);
  const Image image = read_data(folder / "a.hdr");
  for (int x = 0; x < 300; ++x) {
    EXPECT_EQ(image.at(x, 0, 0), x < 3 ? 1.0f : 200.0f / 256) << x;
    EXPECT_EQ(image.at(x, 0, 2), x < 3 ? 0.25f : 0.0f) << x;
  }
}

TEST(Formats, HdrsWithoutAFormatLineAreRgbe) {
  const TemporaryFolder folder;
  auto bytes = hdr("#?RGBE\r\n# made by hand\r\n\r\n-Y 1 +X 1\r\n");
  append(bytes, {128, 64, 32, 129});
  write_bytes(folder / "a.hdr", bytes);
  EXPECT_EQ(read_data(folder / "a.hdr").data, (std::vector<float>{1, 0.5f, 0.25f}));
}

TEST(Formats, HdrsMayRunInAnyDirection) {
  const TemporaryFolder folder;
  // Stored: two scanlines "1 2" and "3 4".
  for (const auto& [order, expected] : std::vector<std::pair<std::string, std::vector<float>>>{
           {"-Y 2 +X 2", {1, 2, 3, 4}},
           {"-Y 2 -X 2", {2, 1, 4, 3}},
           {"+Y 2 -X 2", {4, 3, 2, 1}},
           {"+Y 2 +X 2", {3, 4, 1, 2}},
           {"+X 2 -Y 2", {1, 3, 2, 4}},  // columns from left to right, each downwards
           {"+X 2 +Y 2", {2, 4, 1, 3}},  // each upwards
           {"-X 2 -Y 2", {3, 1, 4, 2}},  // columns from right to left
           {"-X 2 +Y 2", {4, 2, 3, 1}}}) {
    auto bytes = hdr("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + order + "\n");
    append(bytes, {128, 128, 128, 129, 128, 128, 128, 130, 192, 192, 192, 130, 128, 128, 128, 131});
    write_bytes(folder / "a.hdr", bytes);
    const Image image = with_channels(read_data(folder / "a.hdr"), 1);
    EXPECT_EQ(image.data, expected) << order;
  }
}

TEST(Formats, WebpIsWrittenWithoutLoss) {
  const TemporaryFolder folder;
  for (const int channels : {1, 3, 4}) {
    Image image(37, 23, channels);
    image.data = samples(37, 23, channels);
    write_image(folder / "a.webp", image);
    write_image(folder / "a.png", image);
    EXPECT_EQ(
        read_image(folder / "a.webp").data,
        (channels == 1 ? with_channels(read_image(folder / "a.png"), 3) : read_image(folder / "a.png")).data);
    if (channels < 4) expect_as_openimageio(folder / "a.webp");  // which multiplies by alpha unasked
  }
  const auto bytes = read_bytes(folder / "a.webp");
  EXPECT_EQ(read_data_from_memory(bytes, "a.webp").data, read_data(folder / "a.webp").data);
  write_bytes(folder / "cut.webp", std::span(bytes).first(bytes.size() * 9 / 10));
  EXPECT_THROW(read_data(folder / "cut.webp"), Error);
}

TEST(Formats, OtherKindsAreReadByTheModule) {
  const TemporaryFolder folder;
  for (const char* name : {"a.tga", "a.bmp", "a.dpx", "a.sgi"}) {
    ASSERT_TRUE(write(folder / name, OIIO::ImageSpec(37, 23, 3, OIIO::TypeDesc::UINT8))) << name;
    expect_as_openimageio(folder / name);
  }
}

TEST(Formats, WhatAFileIsItsBytesSay) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write(folder / "a.png", OIIO::ImageSpec(9, 5, 3, OIIO::TypeDesc::UINT8)));
  fs::rename(folder / "a.png", folder / "b.jpg");
  EXPECT_EQ(read_data(folder / "b.jpg").width, 9);
}

}  // namespace
}  // namespace sateen::io
