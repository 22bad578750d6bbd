// SPDX-License-Identifier: MIT
#include "sateen/io/image.h"

#include <cmath>

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sateen/core/colour.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image_encode.h"
#include "sateen/io/image_rows.h"
#include "support/files.h"

namespace sateen::io {
namespace {

using test::TemporaryFolder;

/// Smooth colours with odd width and height, so that JPEG has no excuse; alpha is a ramp from 0.25 to 1 and
/// the colours are multiplied by it.
Image sample_image(int channels, int width = 37, int height = 23) {
  Image image(width, height, channels);
  const bool alpha = channels == 2 || channels == 4;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(width);
      const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
      const float values[]{u, v, 0.5f + 0.4f * std::sin(5 * u) * v};
      const float a = alpha ? 0.25f + 0.75f * v : 1;
      for (int c = 0; c < channels; ++c) image.at(x, y, c) = alpha && c == channels - 1 ? a : a * values[c];
    }
  }
  return image;
}

float largest_difference(const Image& a, const Image& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.channels, b.channels);
  float largest = 0;
  for (std::size_t i = 0; i < std::min(a.data.size(), b.data.size()); ++i)
    largest = std::max(largest, std::abs(a.data[i] - b.data[i]));
  return largest;
}

Image round_trip(const Image& image, const std::string& name) {
  const TemporaryFolder folder;
  write_image(folder / name, image);
  return read_image(folder / name);
}

Image encoded(Image image) {
  return srgb_encoded(std::move(image));
}

TEST(ImageFile, EightBitPicturesKeepHalfAStepOfSrgb) {
  for (const char* name : {"a.png", "a.tif", "ein Bild 絹.TIFF"}) {
    for (const int channels : {1, 3}) {
      SCOPED_TRACE(fmt::format("{} {}", name, channels));
      const Image image = sample_image(channels);
      EXPECT_LE(largest_difference(encoded(round_trip(image, name)), encoded(image)), 0.501f / 255);
    }
  }
}

TEST(ImageFile, EightBitPicturesWithAlphaAreAssociatedAgainAfterReading) {
  for (const char* name : {"a.png", "a.tif"}) {
    for (const int channels : {2, 4}) {
      SCOPED_TRACE(fmt::format("{} {}", name, channels));
      const Image image = sample_image(channels);
      // A step of the stored colour is worth at most 1.055 * 2.4 / 255 of light, one of alpha another 1 /
      // 255.
      EXPECT_LE(largest_difference(round_trip(image, name), image), 0.5f * (1.055f * 2.4f + 1) / 255);
    }
  }
}

TEST(ImageFile, JpegIsCloseAndWithoutAlpha) {
  const Image image = sample_image(3);
  EXPECT_LE(largest_difference(encoded(round_trip(image, "a.jpg")), encoded(image)), 0.05f);
  EXPECT_EQ(round_trip(sample_image(4), "a.jpeg").channels, 3);
  EXPECT_EQ(round_trip(sample_image(2), "a.jpg").channels, 1);
}

TEST(ImageFile, ExrKeepsHalfPrecisionAndAnyRange) {
  for (const int channels : {1, 2, 3, 4}) {
    Image image = sample_image(channels);
    image.at(0, 0, 0) = -3;
    image.at(1, 0, 0) = 60000;
    const Image back = round_trip(image, "a.exr");
    for (std::size_t i = 0; i < image.data.size(); ++i)
      EXPECT_NEAR(back.data[i], image.data[i], std::abs(image.data[i]) / 2048);
  }
}

TEST(ImageFile, ExrDoesNotTurnLargeValuesIntoInfinities) {
  EXPECT_EQ(round_trip(Image(1, 1, 3, 1e9f), "a.exr").at(0, 0, 0), 65504);
}

TEST(ImageFile, HdrKeepsOnePartIn128OfTheLargestChannel) {
  Image image = sample_image(3);
  image.set_rgb(2, 2, {4000, 3000, 2000});
  const Image back = round_trip(image, "a.hdr");
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float largest = image.rgb(x, y).maxCoeff();
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(back.at(x, y, c), image.at(x, y, c), largest / 128);
    }
  }
  EXPECT_EQ(round_trip(sample_image(4), "a.hdr").channels, 3);
}

TEST(ImageFile, EncodingCanBeForced) {
  const TemporaryFolder folder;
  write_image(folder / "a.png", Image(2, 2, 3, srgb_decode(128.0f / 255)));
  EXPECT_NEAR(read_image(folder / "a.png").at(0, 0, 0), 0.2158605f, 1e-6f);  // IEC 61966-2-1
  EXPECT_NEAR(read_image(folder / "a.png", {Encoding::linear}).at(0, 0, 0), 128.0f / 255, 1e-6f);
  write_image(folder / "a.exr", Image(2, 2, 3, 0.5f));
  EXPECT_EQ(read_image(folder / "a.exr").at(0, 0, 0), 0.5f);
  EXPECT_NEAR(read_image(folder / "a.exr", {Encoding::srgb}).at(0, 0, 0), 0.2140411f, 1e-6f);
}

TEST(ImageFile, DataAreStoredAsTheyAre) {
  const TemporaryFolder folder;
  for (const int channels : {1, 2, 3, 4}) {
    const Image image = sample_image(channels);
    write_data(folder / "a.exr", image);
    EXPECT_EQ(largest_difference(read_data(folder / "a.exr"), image), 0);
    write_data(folder / "a.png", image);
    EXPECT_LE(largest_difference(read_data(folder / "a.png"), image), 0.501f / 65535);
    const ImageInfo info = read_image_info(folder / "a.png");
    EXPECT_EQ(info.bits, 16);
    EXPECT_EQ(info.channels, channels);
    EXPECT_FALSE(info.floating);
  }
}

TEST(ImageFile, PngsSayWhetherTheyAreSrgb) {
  const TemporaryFolder folder;
  write_image(folder / "light.png", sample_image(3));
  write_data(folder / "data.png", sample_image(3));
  EXPECT_NE(read_text(folder / "light.png").find("sRGB"), std::string::npos);
  EXPECT_EQ(read_text(folder / "data.png").find("sRGB"), std::string::npos);
}

TEST(ImageFile, SixteenBitPngIsDecodedFromSrgb) {
  const TemporaryFolder folder;
  const Image image = sample_image(3);
  write_data(folder / "a.png", encoded(image));
  EXPECT_LE(largest_difference(read_image(folder / "a.png"), image), 3.0f / 65535);
}

TEST(ImageFile, InfoTellsWhatReadingReturns) {
  const TemporaryFolder folder;
  write_image(folder / "a.exr", sample_image(4));
  const ImageInfo info = read_image_info(folder / "a.exr");
  EXPECT_EQ(info.width, 37);
  EXPECT_EQ(info.height, 23);
  EXPECT_EQ(info.channels, 4);
  EXPECT_EQ(info.bits, 16);
  EXPECT_TRUE(info.floating);
}

TEST(ImageFile, WhatAFormatCannotHoldIsItsNearest) {
  Image light(3, 1, 3);
  light.set_rgb(0, 0, {2, 1e30f, 1});
  light.set_rgb(1, 0, {-1.9f, 0.5f, 0});
  light.set_rgb(2, 0, {-1e-3f, 3e38f, 1e38f});
  for (const char* name : {"a.png", "a.tif", "a.webp"}) {
    const Image back = round_trip(light, name);
    EXPECT_LT((back.rgb(0, 0) - Vec3f::Ones()).norm(), 1e-6f) << name;
    EXPECT_EQ(back.at(1, 0, 0), 0) << name;
    EXPECT_NEAR(back.at(1, 0, 1), 0.5, 0.005) << name;
  }
  const Image hdr = round_trip(light, "a.hdr");
  EXPECT_EQ(hdr.at(1, 0, 0), 0);
  EXPECT_EQ(hdr.at(2, 0, 0), 0);
  EXPECT_GT(hdr.at(2, 0, 1), 1e38f);
}

TEST(ImageFile, JpegsAreOfTheQualityAskedForAndOfFullColour) {
  const Image smooth = sample_image(3, 64, 64);
  EXPECT_LT(encode_jpeg(smooth, 30).size(), encode_jpeg(smooth, 98).size() / 2);
  Image stripes(32, 32, 3);
  for (int i = 0; i < 32 * 32; ++i) stripes.at(i % 32, i / 32, i % 2) = 1;  // red and green in turn
  const TemporaryFolder folder;
  write_bytes(folder / "a.jpg", encode_jpeg(stripes, 98));
  const Image back = read_image(folder / "a.jpg");
  EXPECT_GT(back.at(16, 16, 0), 0.8f);
  EXPECT_LT(back.at(17, 16, 0), 0.1f);
}

TEST(ImageFile, LayersHaveTheirNames) {
  const TemporaryFolder folder;
  ImageLayer layers[]{{"diffuse", sample_image(3)}, {"specular", Image(37, 23, 1, 0.5f)}};
  layers[0].image.at(1, 1, 0) = 1e9f;
  write_layers(folder / "a.exr", layers);
  const auto input = OIIO::ImageInput::open((folder / "a.exr").string());
  ASSERT_TRUE(input);
  std::vector<std::string> names = input->spec().channelnames;
  std::ranges::sort(names);
  EXPECT_EQ(names, (std::vector<std::string>{"diffuse.B", "diffuse.G", "diffuse.R", "specular.R"}));
  const Image back = read_data(folder / "a.exr");  // in the order of a picture
  EXPECT_LT((back.rgb(20, 7) - layers[0].image.rgb(20, 7)).norm(), 1e-3f);
  EXPECT_EQ(back.at(20, 7, 3), 0.5f);
  EXPECT_EQ(back.at(1, 1, 0), 65504);
}

/// Writes through OpenImageIO alone, for files Sateen itself does not make.
void write_with(const std::filesystem::path& path, const OIIO::ImageSpec& spec,
                const std::vector<float>& data) {
  auto output = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(output && output->open(path.string(), spec)) << OIIO::geterror();
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, data.data())) << output->geterror();
  ASSERT_TRUE(output->close());
}

TEST(ImageFile, OrientationOfTheCameraIsApplied) {
  const TemporaryFolder folder;
  OIIO::ImageSpec spec(3, 2, 1, OIIO::TypeDesc::UINT8);
  const std::vector<float> data{0, 0.2f, 0.4f, 0.6f, 0.8f, 1};
  for (const auto& [orientation, expected] :
       {std::pair{3, std::vector<float>{1, 0.8f, 0.6f, 0.4f, 0.2f, 0}},     // upside down
        std::pair{6, std::vector<float>{0.6f, 0, 0.8f, 0.2f, 1, 0.4f}},     // to be turned clockwise
        std::pair{8, std::vector<float>{0.4f, 1, 0.2f, 0.8f, 0, 0.6f}}}) {  // counter-clockwise
    spec["Orientation"] = orientation;
    for (const char* name : {"a.tif", "a.exr"}) {
      spec.format = name == std::string("a.tif") ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
      write_with(folder / name, spec, data);
      const Image image = read_data(folder / name);
      EXPECT_EQ(image.width, orientation == 3 ? 3 : 2);
      EXPECT_EQ(read_image_info(folder / name).width, image.width);
      ASSERT_EQ(image.data.size(), expected.size());
      for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(image.data[i], expected[i], 1e-6f) << orientation << name;
      // A region is one of the upright picture.
      const Image part =
          read_image(folder / name, {.encoding = Encoding::linear, .region = PixelRect{1, 1, 1, 1}});
      ASSERT_EQ(part.data.size(), 1u);
      EXPECT_NEAR(part.data[0], expected[static_cast<std::size_t>(image.width) + 1], 1e-6f)
          << orientation << name;
    }
  }
}

TEST(ImageFile, AnExrIsAsLargeAsItsDisplayWindow) {
  const TemporaryFolder folder;
  OIIO::ImageSpec spec(2, 2, 1, OIIO::TypeDesc::FLOAT);
  spec.x = 1;
  spec.y = -1;  // its upper row lies outside
  spec.full_width = 4;
  spec.full_height = 3;
  write_with(folder / "a.exr", spec, {1, 2, 3, 4});
  const Image image = read_data(folder / "a.exr");
  EXPECT_EQ(image.data, (std::vector<float>{0, 3, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
}

/// Each pixel the mean of a square of the picture, those at the edge of less.
Image box_means(const Image& image, int box) {
  Image means((image.width + box - 1) / box, (image.height + box - 1) / box, image.channels);
  for (int y = 0; y < means.height; ++y) {
    for (int x = 0; x < means.width; ++x) {
      const Image part = cropped(image, overlap({x * box, y * box, box, box}, image.width, image.height));
      for (int c = 0; c < image.channels; ++c) {
        double sum = 0;
        for (int v = 0; v < part.height; ++v) {
          for (int u = 0; u < part.width; ++u) sum += part.at(u, v, c);
        }
        means.at(x, y, c) = static_cast<float>(sum / (part.width * part.height));
      }
    }
  }
  return means;
}

TEST(ImageFile, LargePicturesAreAveragedInLinearLightWhileTheyAreRead) {
  const TemporaryFolder folder;
  for (const char* name : {"a.png", "a.jpg", "a.exr", "a.hdr", "a.tif", "a.webp"}) {
    for (const int channels : {1, 3, 4}) {
      SCOPED_TRACE(fmt::format("{} {}", name, channels));
      write_image(folder / name, sample_image(channels));
      const Image whole = read_image(folder / name);
      EXPECT_LT(largest_difference(read_image(folder / name, {.most_across = 10}), box_means(whole, 4)),
                1e-5f);
      EXPECT_EQ(read_image(folder / name, {.most_across = 37}).data, whole.data);
      const ReadImageOptions srgb{.encoding = Encoding::srgb, .most_across = 10};
      EXPECT_LT(largest_difference(read_image(folder / name, srgb),
                                   box_means(read_image(folder / name, {.encoding = Encoding::srgb}), 4)),
                1e-5f);
    }
  }
}

/// While it lives, larger pictures are refused.
struct PixelLimit {
  std::int64_t before = max_pixels();
  explicit PixelLimit(std::int64_t pixels) { set_max_pixels(pixels); }
  ~PixelLimit() { set_max_pixels(before); }
};

TEST(ImageFile, MorePixelsThanTheLimitAreRefusedUnlessTheyNeverTakeTheirMemory) {
  const TemporaryFolder folder;
  write_image(folder / "a.png", sample_image(3));
  const PixelLimit limit(37 * 23 - 1);
  const std::string message = failure_of("", [&] { read_image(folder / "a.png"); });
  EXPECT_THAT(message, testing::HasSubstr("a.png: has 37 x 23 pixels; 850 are the most"));
  EXPECT_THAT(message, testing::HasSubstr("--max-pixels"));
  EXPECT_THROW(read_data(folder / "a.png"), Error);
  EXPECT_EQ(read_image(folder / "a.png", {.most_across = 20}).width, 19);
  EXPECT_EQ(read_image_info(folder / "a.png").width, 37);
  ImageRowReader rows(folder / "a.png");
  std::vector<float> row(37 * 3);
  rows.read(row);
}

TEST(ImageFile, AnEmptyPictureIsNotWritten) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_image(folder / "a.png", Image()), Error);
  EXPECT_THROW(write_data(folder / "a.exr", Image()), Error);
}

TEST(ImageFile, ExtensionsThatCannotBeWrittenAreRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_image(folder / "a.bmp", Image(1, 1, 3)), Error);
  EXPECT_THROW(write_image(folder / "a", Image(1, 1, 3)), Error);
  EXPECT_THROW(write_data(folder / "a.jpg", Image(1, 1, 3)), Error);
  EXPECT_THROW(write_layers(folder / "a.png", std::vector<ImageLayer>{{"a", Image(1, 1, 3)}}), Error);
  EXPECT_THROW(
      write_layers(folder / "a.exr", std::vector<ImageLayer>{{"a", Image(1, 1, 3)}, {"b", Image(2, 1, 3)}}),
      Error);
  EXPECT_THROW(write_layers(folder / "a.exr", {}), Error);
}

}  // namespace
}  // namespace sateen::io
