// SPDX-License-Identifier: MIT
#include "sateen/amc/build.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sateen/amc/lookup.h"
#include "sateen/core/disc.h"
#include "sateen/core/error.h"
#include "sateen/io/image.h"
#include "support/analytic_material.h"
#include "support/files.h"

namespace sateen::amc {
namespace {

using test::analytic_colour;
using test::analytic_frames;
using testing::HasSubstr;

/// The largest difference between a table and the analytic material, at the texels the camera saw whole.
double worst_error(const AmcTable& table, int symmetry) {
  double worst = 0;
  for (int f = 0; f < table.slices; ++f) {
    for (int y = 0; y < table.size; ++y) {
      for (int x = 0; x < table.size; ++x) {
        if (!inside_disc(x, table.size - 1 - y, table.size, 1)) continue;
        const Vec3 n = normal_on_disc({2 * (x + 0.5) / table.size - 1, 2 * (y + 0.5) / table.size - 1});
        const Vec3 error =
            table.texel(x, y, f).cast<double>() - analytic_colour(n, table.slice_angle(f), symmetry);
        worst = std::max(worst, error.cwiseAbs().maxCoeff());
      }
    }
  }
  return worst;
}

/// Writes analytic frames as EXR files that start at `first_angle` and turn `step` turns each.
std::vector<std::filesystem::path> write_frames(const test::TemporaryFolder& folder, int count,
                                                double first_angle, double step) {
  std::vector<std::filesystem::path> files;
  for (int i = 0; i < count; ++i) {
    files.push_back(folder / fmt::format("frame_{}.exr", i));
    io::write_image(files.back(), test::photograph(24, [&](const Vec3& n) {
                      return analytic_colour(n, first_angle + i * step, 1);
                    }));
  }
  return files;
}

TEST(BuildAmc, ReproducesTheMaterialForAnyNumberOfFrames) {
  for (const int count : {32, 64, 90}) {
    const auto frames = analytic_frames(24, count, 2);
    BuildAmcOptions options;
    options.slices = 32;
    const AmcTable table = build_amc(frames, analyse_symmetry(frames), options);
    EXPECT_EQ(table.symmetry, 2);
    // As many as slices or fewer: interpolated; more: the tent's own blur of 4 harmonics over 64 slices.
    EXPECT_LT(worst_error(table, 2), count == 64 ? 1e-3 : 0.03) << count;
  }
}

TEST(BuildAmc, FirstAngleAndDirectionSayWhereTheTangentPoints) {
  for (const bool clockwise : {false, true}) {
    const test::TemporaryFolder folder;
    const auto files = write_frames(folder, 32, 0.3, (clockwise ? -1.0 : 1.0) / 32);
    LoadFramesOptions options;
    options.size = 24;
    options.first_angle = 0.3;
    options.clockwise = clockwise;
    const LoadedFrames loaded = load_frames(files, options);
    EXPECT_TRUE(loaded.floating);
    BuildAmcOptions build;
    build.slices = 32;
    build.symmetry = 1;
    EXPECT_LT(worst_error(build_amc(loaded.frames, analyse_symmetry(loaded.frames), build), 1), 0.01);
  }
}

TEST(BuildAmc, ACropFindsTheSphereInALargerPicture) {
  const test::TemporaryFolder folder;
  std::vector<std::filesystem::path> files;
  for (int i = 0; i < 8; ++i) {
    const Image sphere = test::photograph(24, [&](const Vec3& n) { return analytic_colour(n, i / 8.0, 1); });
    Image picture(40, 30, 3, 5);
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 24; ++x) picture.set_rgb(x + 9, y + 4, sphere.rgb(x, y));
    }
    files.push_back(folder / fmt::format("{}.exr", i));
    io::write_image(files.back(), picture);
  }
  LoadFramesOptions options;
  options.size = 24;
  EXPECT_THROW(load_frames(files, options), Error);
  options.crop = PixelRect{9, 4, 24, 24};
  const LoadedFrames loaded = load_frames(files, options);
  const Vec3 n = normal_on_disc(disc_of_pixel(12, 7, 24));
  EXPECT_LT((loaded.frames[2].image.rgb(12, 7).cast<double>() - analytic_colour(n, 0.25, 1)).norm(), 1e-3);
  EXPECT_LT(loaded.frames[2].image.rgb(0, 0).maxCoeff(), 1) << "background reached the table";
  options.crop = PixelRect{20, 4, 24, 24};
  EXPECT_THROW(load_frames(files, options), Error);
}

TEST(BuildAmc, LightIsNeverNegative) {
  const test::TemporaryFolder folder;
  std::vector<std::filesystem::path> files;
  for (int i = 0; i < 4; ++i) {
    files.push_back(folder / fmt::format("{}.exr", i));
    io::write_image(files.back(), Image(8, 8, 3, i == 2 ? 1.0f : -0.5f));
  }
  LoadFramesOptions options;
  options.size = 8;
  LoadedFrames loaded = load_frames(files, options);
  EXPECT_EQ(loaded.frames[1].image.at(4, 4, 1), 0);
  // Between black frames beside a bright one the cubic goes below black.
  BuildAmcOptions build;
  build.slices = 64;
  build.symmetry = 1;
  const AmcTable table = build_amc(loaded.frames, analyse_symmetry(loaded.frames), build);
  for (int f = 0; f < table.slices; ++f) EXPECT_GE(table.texel(4, 4, f).minCoeff(), 0) << f;
  AmcTable eight_bits(1, 1, 1);
  eight_bits.encoding = AmcEncoding::srgb8;
  eight_bits.set_texel(0, 0, 0, {2, 0.5f, -1});
  quantise(eight_bits);
  EXPECT_LT((eight_bits.texel(0, 0, 0) - Vec3f(1, 0.5f, 0)).norm(), 0.005f);
}

TEST(BuildAmc, ABadFrameIsNamedOrLeftOut) {
  const test::TemporaryFolder folder;
  const auto files = write_frames(folder, 16, 0, 1.0 / 16);
  std::filesystem::resize_file(files[5], std::filesystem::file_size(files[5]) / 2);
  LoadFramesOptions options;
  options.size = 24;
  try {
    load_frames(files, options);
    FAIL() << "a truncated frame was accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("frame_5.exr"));
  }
  options.skip_bad = true;
  std::vector<std::string> reasons;
  options.on_skipped = [&](const std::string& why) { reasons.push_back(why); };
  const LoadedFrames loaded = load_frames(files, options);
  EXPECT_EQ(loaded.frames.size(), 15u);
  EXPECT_EQ(loaded.skipped, 1);
  ASSERT_EQ(reasons.size(), 1u);
  EXPECT_THAT(reasons[0], HasSubstr("frame_5.exr"));
  EXPECT_DOUBLE_EQ(loaded.frames[5].angle, 6.0 / 16) << "the angles of the others must not shift";
}

TEST(BuildAmc, FramesOfOtherSizesAndTooFewFramesAreRefused) {
  const test::TemporaryFolder folder;
  auto files = write_frames(folder, 6, 0, 1.0 / 6);
  LoadFramesOptions options;
  EXPECT_THROW(load_frames({}, options), Error);
  EXPECT_THROW(load_frames(std::span(files).first(1), options), Error);
  io::write_image(files[3], Image(30, 30, 3, 0.5f));
  EXPECT_THAT([&] { load_frames(files, options); }, testing::ThrowsMessage<Error>(HasSubstr("frame_3.exr")));
}

}  // namespace
}  // namespace sateen::amc
