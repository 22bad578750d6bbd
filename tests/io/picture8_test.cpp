// SPDX-License-Identifier: MIT
// The 8-bit pictures of captures against OpenCV's reader.
#include "sateen/io/picture8.h"

#include <cmath>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "support/files.h"

namespace sateen::io {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

/// A file to write: how JPEG encodes it and how it says that it lies.
struct Variant {
  int width = 37;
  int height = 23;
  int channels = 3;
  std::string subsampling = "4:2:0";
  int orientation = 1;
};

/// Colours that change quickly and differ in every corner: a turned or shifted picture cannot pass.
std::vector<std::uint8_t> samples_of(const Variant& v) {
  std::vector<std::uint8_t> samples;
  for (int y = 0; y < v.height; ++y) {
    for (int x = 0; x < v.width; ++x) {
      for (int c = 0; c < v.channels; ++c) {
        const double wave = std::sin(0.7 * x + 1.3 * c) * std::cos(0.4 * y - c);
        const double ramp = static_cast<double>(x) / v.width - 0.6 * y / v.height;
        samples.push_back(static_cast<std::uint8_t>(128 + 55 * wave + 60 * ramp));
      }
    }
  }
  return samples;
}

fs::path written(const fs::path& folder, const Variant& v, const std::string& extension) {
  const fs::path path = folder / fmt::format("{}x{}x{}_{}_{}{}", v.width, v.height, v.channels,
                                             v.subsampling[2], v.orientation, extension);
  const auto out = OIIO::ImageOutput::create(path.string());
  OIIO::ImageSpec spec(v.width, v.height, v.channels, OIIO::TypeDesc::UINT8);
  spec.attribute("jpeg:subsampling", v.subsampling);
  spec.attribute("Orientation", v.orientation);
  spec.attribute("compression", extension == ".jpg" ? "jpeg:92" : "zip");
  EXPECT_TRUE(out->open(path.string(), spec)) << out->geterror();
  EXPECT_TRUE(out->write_image(OIIO::TypeDesc::UINT8, samples_of(v).data())) << out->geterror();
  EXPECT_TRUE(out->close());
  return path;
}

void expect_as_opencv_reads(const fs::path& path, const Picture8& picture) {
  cv::Mat expected = cv::imread(path.string(), cv::IMREAD_COLOR);
  cv::cvtColor(expected, expected, cv::COLOR_BGR2RGB);
  ASSERT_EQ(picture.width, expected.cols) << path;
  ASSERT_EQ(picture.height, expected.rows) << path;
  ASSERT_EQ(picture.rgb.size(), expected.total() * 3) << path;
  const cv::Mat read(picture.height, picture.width, CV_8UC3, const_cast<std::uint8_t*>(picture.rgb.data()));
  EXPECT_EQ(cv::norm(read, expected, cv::NORM_INF), 0) << path;
}

void expect_as_opencv_reads(const fs::path& path) {
  expect_as_opencv_reads(path, read_picture8(path));
}

TEST(Picture8, ColourAndGreyJpegsOfAllSubsamplingsAndOddSizes) {
  const TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{37, 23}, {64, 48}, {17, 16}, {16, 17}, {333, 5}, {1, 1}}) {
    for (const char* subsampling : {"4:4:4", "4:2:2", "4:2:0", "4:1:1"})
      expect_as_opencv_reads(written(folder.path(), {width, height, 3, subsampling}, ".jpg"));
    expect_as_opencv_reads(written(folder.path(), {width, height, 1}, ".jpg"));
  }
}

TEST(Picture8, AllEightOrientations) {
  const TemporaryFolder folder;
  for (int orientation = 1; orientation <= 8; ++orientation) {
    for (const int channels : {1, 3}) {
      const fs::path path = written(folder.path(), {37, 23, channels, "4:2:0", orientation}, ".jpg");
      const Picture8 picture = read_picture8(path);
      EXPECT_EQ(picture.width, orientation < 5 ? 37 : 23);
      expect_as_opencv_reads(path, picture);
    }
  }
}

TEST(Picture8, ProgressiveJpegs) {
  const TemporaryFolder folder;
  std::vector<std::uint8_t> samples = samples_of({133, 71});
  const fs::path path = folder.path() / "progressive.jpg";
  ASSERT_TRUE(cv::imwrite(path.string(), cv::Mat(71, 133, CV_8UC3, samples.data()),
                          {cv::IMWRITE_JPEG_PROGRESSIVE, 1}));
  expect_as_opencv_reads(path);
}

TEST(Picture8, PngsWithAndWithoutColourAndAlpha) {
  const TemporaryFolder folder;
  for (const int channels : {1, 3})
    expect_as_opencv_reads(written(folder.path(), {37, 23, channels}, ".png"));
}

TEST(Picture8, MemoryOfAnotherSizeIsUsedAgain) {
  const TemporaryFolder folder;
  Picture8 picture;
  for (const auto& [width, height] : {std::pair{64, 48}, {17, 16}, {37, 60}}) {
    const fs::path path = written(folder.path(), {width, height}, ".jpg");
    read_picture8(path, picture);
    expect_as_opencv_reads(path, picture);
  }
}

TEST(Picture8, ARegionIsThatOfTheWholePicture) {
  const TemporaryFolder folder;
  std::vector<fs::path> files;
  for (const char* subsampling : {"4:4:4", "4:2:2", "4:2:0"})
    files.push_back(written(folder.path(), {333, 257, 3, subsampling}, ".jpg"));
  files.push_back(written(folder.path(), {333, 257, 1}, ".jpg"));
  files.push_back(written(folder.path(), {257, 333, 3, "4:2:0", 6}, ".jpg"));
  files.push_back(written(folder.path(), {333, 257}, ".png"));
  std::vector<std::uint8_t> samples = samples_of({333, 257});
  files.push_back(folder.path() / "progressive.jpg");
  ASSERT_TRUE(cv::imwrite(files.back().string(), cv::Mat(257, 333, CV_8UC3, samples.data()),
                          {cv::IMWRITE_JPEG_PROGRESSIVE, 1}));
  for (const fs::path& path : files) {
    const Picture8 whole = read_picture8(path);
    ASSERT_EQ(whole.width, 333);
    for (const PixelRect& region : {PixelRect{100, 60, 90, 70},
                                    {0, 0, 333, 257},
                                    {0, 200, 40, 57},
                                    {290, 0, 43, 31},
                                    {17, 33, 1, 1},
                                    {332, 256, 1, 1}}) {
      Picture8 part;
      read_picture8(path, region, part);
      ASSERT_EQ(part.rgb.size(), whole.rgb.size());
      int different = 0;
      for (int y = region.y; y < region.y + region.height; ++y) {
        const auto row = static_cast<std::size_t>(y * whole.width + region.x) * 3;
        for (std::size_t i = row; i < row + static_cast<std::size_t>(region.width) * 3; ++i)
          different += part.rgb[i] == whole.rgb[i] ? 0 : 1;
      }
      EXPECT_EQ(different, 0) << path << " " << region.x << " " << region.y;
    }
  }
}

}  // namespace
}  // namespace sateen::io
