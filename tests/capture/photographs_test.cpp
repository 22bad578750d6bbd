// SPDX-License-Identifier: MIT
// What photographs bring along: exposure times, damaged notes.
#include <algorithm>
#include <cmath>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "capture/altered_frames.h"
#include "capture/judge.h"
#include "capture/simulated_exif.h"
#include "capture/simulator.h"
#include "sateen/capture/capture.h"
#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "support/files.h"

namespace sateen::capture {
namespace {

using test::Simulation;
using test::TemporaryFolder;
using testing::HasSubstr;

TEST(CapturePhotographs, BracketedExposuresKeepTheHighlights) {
  constexpr double kLonger = 3;
  Simulation dark = test::small_simulation();
  dark.exposure = 0.6;
  Simulation bright = dark;
  bright.exposure = kLonger * dark.exposure;
  const TemporaryFolder both;
  const TemporaryFolder long_only;
  for (int i = 0; i < dark.frames; ++i) {
    const Image light = test::light_of(dark.render(i));
    Image longer = light;
    for (float& v : longer.data) v = std::min(1.0f, v * static_cast<float>(kLonger));
    const auto file = [&](const TemporaryFolder& folder, int shot) {
      return folder / fmt::format("shot_{:03}.jpg", shot);
    };
    io::write_image(file(both, 2 * i), longer);
    io::write_image(file(both, 2 * i + 1), light);
    test::put_exif(file(both, 2 * i), test::exposure_time_exif(3, 100));
    test::put_exif(file(both, 2 * i + 1), test::exposure_time_exif(1, 100));
    io::write_image(file(long_only, i), longer);
  }
  const CaptureOptions options = test::small_options(dark);
  const CaptureResult merged = build_capture({both.path()}, options);
  EXPECT_EQ(merged.frames.size(), 36);
  EXPECT_LT(merged.clipping.share, 0.001);
  const CaptureResult clipped = build_capture({long_only.path()}, options);
  EXPECT_GT(clipped.clipping.share, 0.02);
  const double merged_psnr = test::table_psnr(merged.table.amc, bright, merged.table.seen);
  EXPECT_GT(merged_psnr, 28);
  EXPECT_GT(merged_psnr, test::table_psnr(clipped.table.amc, bright, clipped.table.seen) + 8);
}

TEST(CapturePhotographs, FlickerWithinAFrameIsTold) {
  const Simulation s = test::small_simulation();
  const TemporaryFolder folder;
  for (int i = 0; i < s.frames; ++i) {
    // A lamp at twice the mains frequency, read off row by row.
    Image light = test::light_of(s.render(i));
    for (int y = 0; y < light.height; ++y) {
      const auto lamp = static_cast<float>(1 + 0.08 * std::sin(2.4 * i + 2 * kPi * y / light.height));
      for (int x = 0; x < light.width; ++x) light.set_rgb(x, y, lamp * light.rgb(x, y));
    }
    io::write_image(folder / fmt::format("shot_{:03}.jpg", i), light);
  }
  const CaptureResult result = build_capture({folder.path()}, test::small_options(s));
  EXPECT_THAT(result.warnings, testing::Contains(testing::HasSubstr("flicker")));
}

TEST(CapturePhotographs, UnreadableExifIsAsGoodAsNone) {
  const Simulation s = test::small_simulation();
  const TemporaryFolder folder;
  const std::string good = test::exposure_time_exif(1, 100);
  std::string astray = good;  // the offset of its directory points behind the file
  astray[18] = '\x7f';
  astray[19] = '\x7f';
  std::string endless = good;  // the directory's next directory is itself
  endless[22] = 8;
  const std::vector<std::string> blocks{astray,
                                        endless,
                                        std::string(40, '\xff'),
                                        good.substr(0, 20),
                                        std::string(),
                                        test::exposure_time_exif(1, 0)};
  for (int i = 0; i < s.frames; ++i) {
    const auto file = folder / fmt::format("shot_{:03}.jpg", i);
    io::write_image(file, test::light_of(s.render(i)));
    test::put_exif(file, blocks[static_cast<std::size_t>(i) % blocks.size()]);
  }
  CaptureOptions options = test::small_options(s);
  options.lens.fov = 0;  // so that the notes are asked for the lens
  const CaptureResult result = build_capture({folder.path()}, options);
  EXPECT_EQ(result.frames.size(), 36);
  EXPECT_EQ(result.lens.source, FocalSource::assumed);
  EXPECT_THAT(result.warnings, testing::Contains(testing::HasSubstr("the lens is unknown")));
}

TEST(CapturePhotographs, LightBelowZeroIsDark) {
  // As from a raw converter that takes too much for black.
  const Simulation s = test::small_simulation(24);
  const TemporaryFolder folder;
  for (int i = 0; i < s.frames; ++i) {
    Image light = test::light_of(s.render(i));
    for (float& v : light.data) v -= 0.12f;
    io::write_image(folder / fmt::format("shot_{:03}.exr", i), light);
  }
  const CaptureResult result = build_capture({folder.path()}, test::small_options(s));
  const auto brightest =
      std::ranges::max(result.table.amc.texels, {}, [](Half h) { return static_cast<float>(h); });
  EXPECT_LT(static_cast<float>(brightest), 1.5f);
}

constexpr int kLarge = 4;

/// What is said of the simulation's pictures enlarged so that every pixel becomes kLarge x kLarge: in these
/// the sphere is looked for at half the size.
std::string complaint_of_enlarged(const Simulation& s) {
  const TemporaryFolder folder;
  for (int i = 0; i < s.frames; ++i) {
    io::Picture8 picture = s.render(i);
    const cv::Mat pixels(picture.height, picture.width, CV_8UC3, picture.rgb.data());
    cv::Mat large;
    cv::resize(pixels, large, {}, kLarge, kLarge, cv::INTER_NEAREST);
    cv::imwrite(folder / fmt::format("shot_{:03}.jpg", i), large);
  }
  try {
    build_capture({folder.path()}, test::small_options(s));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// The numbers in a text, in order.
std::vector<double> numbers_in(const std::string& text) {
  const std::regex number(R"(\d+(\.\d+)?)");
  std::vector<double> numbers;
  for (std::sregex_iterator i(text.begin(), text.end(), number); i != std::sregex_iterator(); ++i)
    numbers.push_back(std::stod(i->str()));
  return numbers;
}

TEST(CapturePhotographs, OneOfAnotherSizeIsNamedWithBothSizes) {
  const Simulation s = test::small_simulation(16);
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "shots");
  s.write(folder / "shots");
  io::write_image(folder / "shots" / "frame_007.png", Image(320, 192, 3, 0.5f));
  const auto output = folder / "cloth.ktx2";
  const auto result = test::run_program(fmt::format("capture build {} -o {} --fov 40 --first-angle 0",
                                                    (folder / "shots").string(), output.string()));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output, testing::AllOf(HasSubstr("frame_007.png"), HasSubstr("320 x 192"),
                                            HasSubstr("400 x 240"), HasSubstr("must be alike")));
  EXPECT_FALSE(std::filesystem::exists(output));
}

TEST(CapturePhotographs, PlacesAreToldInTheirOwnPixels) {
  Simulation s = test::small_simulation(14);
  s.centre = {350, 112};
  const std::vector<double> cut = numbers_in(complaint_of_enlarged(s));
  ASSERT_GE(cut.size(), 5);
  EXPECT_NEAR(cut[0], kLarge * s.centre.x(), kLarge * 4);
  EXPECT_NEAR(cut[1], kLarge * s.centre.y(), kLarge * 4);
  EXPECT_NEAR(cut[2], kLarge * s.radius, kLarge * 4);
  EXPECT_EQ(cut[3], kLarge * s.width);
  EXPECT_EQ(cut[4], kLarge * s.height);

  s.centre = {275, 112};
  s.second_sphere = true;
  const std::string spheres = complaint_of_enlarged(s);
  EXPECT_THAT(spheres, testing::HasSubstr("two turning spheres"));
  const std::vector<double> two = numbers_in(spheres);
  ASSERT_GE(two.size(), 4);
  const auto nearer = std::min(std::hypot(two[0] - kLarge * s.centre.x(), two[1] - kLarge * s.centre.y()),
                               std::hypot(two[2] - kLarge * s.centre.x(), two[3] - kLarge * s.centre.y()));
  EXPECT_LT(nearer, kLarge * 4);

  s = test::small_simulation(14);
  s.camera_move = {6, 3};
  const std::vector<double> moved = numbers_in(complaint_of_enlarged(s));
  ASSERT_GE(moved.size(), 1);
  EXPECT_NEAR(moved[0], kLarge * s.camera_move.norm(), kLarge);
}

}  // namespace
}  // namespace sateen::capture
