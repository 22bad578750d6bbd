// SPDX-License-Identifier: MIT
#include <cstring>
#include <functional>
#include <limits>
#include <random>

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "full_disk.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "support/files.h"

namespace sateen::io {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using Bytes = std::vector<std::byte>;

Image noise(int width, int height, int channels) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform;
  Image image(width, height, channels);
  for (float& v : image.data) v = uniform(random);
  return image;
}

class ImageBadInput : public ::testing::Test {
 protected:
  /// The message read_image refuses a file with; it must name the file. Empty when the file is read.
  static std::string refusal(const fs::path& path) {
    try {
      read_image(path);
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(path.string()));
      return error.what();
    }
    return "";
  }

  std::string refusal(const std::string& name, const Bytes& bytes) {
    test::put_bytes(folder_ / name, bytes);
    return refusal(folder_ / name);
  }

  Bytes written(const std::string& name, const Image& image) {
    write_image(folder_ / name, image);
    return read_bytes(folder_ / name);
  }

  test::TemporaryFolder folder_;
};

TEST_F(ImageBadInput, TruncatedPicturesOfEveryTypeAreRefused) {
  for (const char* name : {"a.png", "a.jpg", "a.exr", "a.hdr", "a.tif"}) {
    const Bytes whole = written(name, noise(40, 40, 3));
    EXPECT_EQ(refusal(name, whole), "");
    for (const double share : {0.0, 0.001, 0.02, 0.3, 0.6, 0.9, 0.97}) {
      const auto length = static_cast<std::ptrdiff_t>(share * static_cast<double>(whole.size()));
      EXPECT_NE(refusal(name, Bytes(whole.begin(), whole.begin() + length)), "") << name << " " << share;
    }
  }
}

// OpenImageIO's decoder ends its process with an exception nobody catches, or takes a gigabyte.
TEST_F(ImageBadInput, WhatBreaksADecoderOfAnotherKindIsAMessage) {
  const auto bytes_of = [](const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return Bytes(bytes.begin(), bytes.end());
  };
  EXPECT_NE(refusal("a.png", bytes_of(std::string("GIF\xff\xff\xff\xff\xff\xff\xff\0"
                                                  "89a\0\0\x0b;",
                                                  18))),
            "");
  EXPECT_NE(refusal("b.png", bytes_of(std::string("GIF89a\1\0\1\0\0\0\0;", 14))), "");
  EXPECT_NE(refusal("a.psd", bytes_of("8BPS" + std::string(60, '\xff'))), "");
  EXPECT_THAT(refusal("a.txt", bytes_of("neither picture nor secret")), HasSubstr("no known kind"));
}

TEST_F(ImageBadInput, AnExrAttributeLargerThanTheFileIsRefusedBeforeItsMemory) {
  Bytes bytes = written("a.exr", noise(4, 4, 3));
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t at = all.find("chlist") + 7;
  for (const std::uint32_t size : {0x7fffffffU, 0xffffffffU, 100000U}) {
    std::memcpy(bytes.data() + at, &size, sizeof size);
    EXPECT_THAT(refusal("a.exr", bytes), HasSubstr("attribute reaches past its end"));
  }
}

TEST_F(ImageBadInput, AJpegWithoutItsEndMarkerIsRefused) {
  Bytes bytes = written("a.jpg", noise(40, 40, 3));
  bytes.resize(bytes.size() - 2);
  EXPECT_THAT(refusal("a.jpg", bytes), HasSubstr("Premature end"));
}

TEST_F(ImageBadInput, AJpegWithBrokenScanDataIsRefused) {
  const Bytes whole = written("a.jpg", noise(160, 160, 3));
  const std::size_t middle = whole.size() / 2;
  Bytes zeros = whole;
  std::fill_n(zeros.begin() + static_cast<std::ptrdiff_t>(middle), 400, std::byte{0});
  EXPECT_THAT(refusal("a.jpg", zeros), HasSubstr("corrupt"));
  Bytes cut = whole;  // an end marker in the middle of the scan
  cut[middle] = std::byte{0xff};
  cut[middle + 1] = std::byte{0xd9};
  EXPECT_THAT(refusal("a.jpg", cut), HasSubstr("corrupt"));
  Bytes without = whole;
  without.erase(without.begin() + static_cast<std::ptrdiff_t>(middle),
                without.begin() + static_cast<std::ptrdiff_t>(middle) + 1000);
  EXPECT_THAT(refusal("a.jpg", without), HasSubstr("corrupt"));
}

TEST_F(ImageBadInput, PaddingBeforeTheEndMarkerOfAJpegIsHarmless) {
  Bytes bytes = written("a.jpg", noise(40, 40, 3));
  const Image whole = read_image(folder_ / "a.jpg");
  bytes.insert(bytes.end() - 2, 8, std::byte{0});
  EXPECT_EQ(refusal("a.jpg", bytes), "");
  EXPECT_EQ(read_image(folder_ / "a.jpg").data, whole.data);
}

TEST_F(ImageBadInput, FlippedBytesAreReadOrRefusedButNeverCrash) {
  std::mt19937 random(11);
  for (const char* name : {"a.png", "a.jpg", "a.exr", "a.hdr", "a.tif"}) {
    const Bytes whole = written(name, noise(16, 16, 3));
    for (int i = 0; i < 150; ++i) {
      Bytes broken = whole;
      broken[random() % broken.size()] ^= static_cast<std::byte>(1 + random() % 255);
      refusal(name, broken);
    }
  }
}

TEST_F(ImageBadInput, ValuesThatAreNotFiniteAreRefusedWithTheirPixel) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Image image(7, 5, 3, 0.5f);
    image.at(4, 2, 1) = bad;
    write_data(folder_ / "a.exr", image);
    EXPECT_THAT(refusal(folder_ / "a.exr"), HasSubstr("(4, 2)"));
    EXPECT_THROW(read_data(folder_ / "a.exr"), Error);
    EXPECT_FALSE(std::isfinite(read_data(folder_ / "a.exr", true).at(4, 2, 1)));
    EXPECT_FALSE(std::isfinite(read_image(folder_ / "a.exr", {Encoding::automatic, true}).at(4, 2, 1)));
  }
}

TEST_F(ImageBadInput, CmykIsRefused) {
  const fs::path data = test::source_dir() / "tests" / "data";
  EXPECT_THAT(refusal(data / "cmyk.jpg"), HasSubstr("CMYK"));
  EXPECT_THAT(refusal(data / "ycck.jpg"), HasSubstr("CMYK"));
  OIIO::ImageSpec spec(4, 4, 3, OIIO::TypeDesc::UINT8);
  spec["tiff:ColorSpace"] = "CMYK";
  const fs::path path = folder_ / "cmyk.tif";
  auto output = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(output && output->open(path.string(), spec));
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, noise(4, 4, 3).data.data()) && output->close());
  EXPECT_THAT(refusal(path), HasSubstr("CMYK"));
}

TEST_F(ImageBadInput, AnimationsAreRefusedAndStillGifsRead) {
  const fs::path data = test::source_dir() / "tests" / "data";
  EXPECT_THAT(refusal(data / "animated.gif"), HasSubstr("animated"));
  EXPECT_EQ(refusal(data / "still.gif"), "");
}

TEST_F(ImageBadInput, WhatIsNoPictureIsRefused) {
  EXPECT_THAT(refusal(folder_ / "none.png"), HasSubstr("no such file"));
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("is a folder"));
  fs::create_directory(folder_ / "folder.png");
  EXPECT_THAT(refusal(folder_ / "folder.png"), HasSubstr("is a folder"));
  ASSERT_EQ(mkfifo((folder_ / "pipe.png").c_str(), 0600), 0);
  EXPECT_THAT(refusal(folder_ / "pipe.png"), HasSubstr("no regular file"));
  for (const char* name : {"text.png", "text.exr", "text.jpg", "text.tif", "text.hdr", "text"}) {
    write_text(folder_ / name, "this is no picture");
    EXPECT_THAT(refusal(folder_ / name), HasSubstr("cannot be read as a picture")) << name;
  }
}

/// Replaces a big-endian 32-bit number.
void put_big_endian(Bytes& bytes, std::size_t offset, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i)
    bytes[offset + i] = static_cast<std::byte>(value >> (24 - 8 * i) & 0xff);
}

std::uint32_t png_crc(const Bytes& bytes, std::size_t begin, std::size_t end) {
  std::uint32_t crc = 0xffffffff;
  for (std::size_t i = begin; i < end; ++i) {
    crc ^= static_cast<std::uint32_t>(bytes[i]);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

TEST_F(ImageBadInput, AHeaderThatClaimsTooManyPixelsIsRefused) {
  Bytes png = written("a.png", noise(4, 4, 3));
  put_big_endian(png, 16, 900000);
  put_big_endian(png, 20, 900000);
  put_big_endian(png, 29, png_crc(png, 12, 29));
  EXPECT_NE(refusal("a.png", png), "");
  put_big_endian(png, 16, 30000);
  put_big_endian(png, 20, 30000);
  put_big_endian(png, 29, png_crc(png, 12, 29));
  EXPECT_THAT(refusal("a.png", png), HasSubstr("claims 30000 x 30000 pixels"));

  const std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n";
  write_text(folder_ / "a.hdr", hdr);
  EXPECT_THAT(refusal(folder_ / "a.hdr"), HasSubstr("claims 60000 x 60000 pixels"));
}

TEST_F(ImageBadInput, PicturesThatCannotBeWrittenLeaveNothing) {
  const Image image = noise(64, 64, 3);
  for (const char* name : {"a.png", "a.jpg", "a.exr", "a.hdr", "a.tif"}) {
    SCOPED_TRACE(name);
    EXPECT_THROW(write_image(folder_ / "no" / name, image), Error);
    std::string message;
    try {
      const test::FullDisk disk(1000);
      write_image(folder_ / name, image);
    } catch (const Error& error) {
      message = error.what();
    }
    EXPECT_THAT(message, HasSubstr(std::string(name) + ": cannot"));
    EXPECT_TRUE(fs::is_empty(folder_.path()));
  }
  fs::create_directory(folder_ / "folder.png");
  EXPECT_THROW(write_image(folder_ / "folder.png", image), Error);
}

}  // namespace
}  // namespace sateen::io
