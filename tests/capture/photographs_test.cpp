// SPDX-License-Identifier: MIT
// What photographs bring along: exposure times, damaged notes.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/altered_frames.h"
#include "capture/judge.h"
#include "capture/simulated_exif.h"
#include "capture/simulator.h"
#include "sateen/capture/capture.h"
#include "sateen/core/direction.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "support/files.h"

namespace sateen {
namespace {

using test::Simulation;
using test::TemporaryFolder;

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
    write_image(file(both, 2 * i), longer);
    write_image(file(both, 2 * i + 1), light);
    test::put_exif(file(both, 2 * i), test::exposure_time_exif(3, 100));
    test::put_exif(file(both, 2 * i + 1), test::exposure_time_exif(1, 100));
    write_image(file(long_only, i), longer);
  }
  const CaptureOptions options = test::small_options(dark);
  const CaptureResult merged = build_capture({both.path()}, options);
  EXPECT_EQ(merged.frames.size(), 36);
  EXPECT_LT(merged.clipped_share, 0.001);
  const CaptureResult clipped = build_capture({long_only.path()}, options);
  EXPECT_GT(clipped.clipped_share, 0.02);
  const double merged_psnr = test::table_psnr(merged.table, bright, merged.seen);
  EXPECT_GT(merged_psnr, 28);
  EXPECT_GT(merged_psnr, test::table_psnr(clipped.table, bright, clipped.seen) + 8);
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
    write_image(folder / fmt::format("shot_{:03}.jpg", i), light);
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
    write_image(file, test::light_of(s.render(i)));
    test::put_exif(file, blocks[static_cast<std::size_t>(i) % blocks.size()]);
  }
  CaptureOptions options = test::small_options(s);
  options.fov = 0;  // so that the notes are asked for the lens
  const CaptureResult result = build_capture({folder.path()}, options);
  EXPECT_EQ(result.frames.size(), 36);
  EXPECT_EQ(result.camera.focal_source, "assumed");
  EXPECT_THAT(result.warnings, testing::Contains(testing::HasSubstr("the lens is unknown")));
}

}  // namespace
}  // namespace sateen
