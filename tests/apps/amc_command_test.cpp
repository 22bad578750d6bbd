// SPDX-License-Identifier: MIT
#include <cmath>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "sateen/amc/amc_file.h"
#include "sateen/core/disc.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "support/analytic_material.h"
#include "support/files.h"

namespace sateen {
namespace {

using nlohmann::json;
using test::run_program;
using testing::HasSubstr;

const std::string kSilk = (test::examples() / "silk").string();

/// Copies of the first frames of the shipped capture, to be spoilt.
std::filesystem::path copied_frames(const test::TemporaryFolder& folder, int count) {
  const auto frames = folder / "frames";
  std::filesystem::create_directory(frames);
  for (int i = 0; i < count; ++i) {
    const std::string name = fmt::format("frame_{:03}.png", i * 128 / count);
    std::filesystem::copy_file(test::examples() / "silk" / name, frames / fmt::format("frame_{:03}.png", i));
  }
  return frames;
}

TEST(AmcCommand, TheShippedSilkIsInvariantUnderHalfATurnOnly) {
  const test::TemporaryFolder folder;
  const std::string amc = (folder / "silk.ktx2").string();
  const auto built = run_program(fmt::format("amc build {} -o {} --size 64 --slices 32 --json", kSilk, amc));
  ASSERT_EQ(built.exit_code, 0) << built.output;
  const json report = json::parse(built.output);
  EXPECT_EQ(report["symmetry"], 2);
  EXPECT_GT(report["similarities"][1]["psnr"], 40);
  EXPECT_LT(report["similarities"][3]["psnr"], 25);

  const json info = json::parse(run_program(fmt::format("amc info {} --json", amc)).output);
  EXPECT_EQ(info["size"], 64);
  EXPECT_EQ(info["slices"], 32);
  EXPECT_EQ(info["symmetry"], 2);
  EXPECT_EQ(info["isotropic"], false);
  EXPECT_EQ(info["encoding"], "srgb8");
  EXPECT_EQ(info["bytes"], std::filesystem::file_size(amc));
}

TEST(AmcCommand, FullResolutionSlicesEqualTheFramesTheyCameFrom) {
  // Slice 2f of the R = 2 table is the mean of frames f and f + 64, to 8-bit rounding.
  const test::TemporaryFolder folder;
  const std::string slices = (folder / "slices").string();
  ASSERT_EQ(run_program(fmt::format("amc build {} -o {} --slices 64", kSilk, slices)).exit_code, 0);
  for (const int f : {0, 17, 40}) {
    const Image slice = io::read_image(fmt::format("{}/slice_{:03}.png", slices, f));
    const Image a = io::read_image(fmt::format("{}/frame_{:03}.png", kSilk, f));
    const Image b = io::read_image(fmt::format("{}/frame_{:03}.png", kSilk, f + 64));
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 128; ++x) {
        if (!inside_disc(x, y, 128)) continue;
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(slice.at(x, y, c), (a.at(x, y, c) + b.at(x, y, c)) / 2, 0.005);
      }
    }
  }
}

TEST(AmcCommand, ConvertsToAFolderAndBackWithoutLoss) {
  const test::TemporaryFolder folder;
  const std::string root = folder.path().string();
  ASSERT_EQ(
      run_program(fmt::format("amc build {} -o {}/a.ktx2 --size 32 --slices 16", kSilk, root)).exit_code, 0);
  ASSERT_EQ(run_program(fmt::format("amc convert {0}/a.ktx2 -o {0}/slices", root)).exit_code, 0);
  ASSERT_EQ(run_program(fmt::format("amc convert {0}/slices -o {0}/b.ktx2", root)).exit_code, 0);
  EXPECT_EQ(io::read_bytes(folder / "a.ktx2"), io::read_bytes(folder / "b.ktx2"));
}

TEST(AmcCommand, TheThreadCountDoesNotChangeTheBytes) {
  const test::TemporaryFolder folder;
  for (const int threads : {1, 2}) {
    ASSERT_EQ(run_program(fmt::format("amc build {} -o {}/{}.ktx2 --size 32 --slices 24 --threads {}", kSilk,
                                      folder.path().string(), threads, threads))
                  .exit_code,
              0);
  }
  EXPECT_EQ(io::read_bytes(folder / "1.ktx2"), io::read_bytes(folder / "2.ktx2"));
}

TEST(AmcCommand, DrawsTheSheetAndTheIsotropicMatCap) {
  const test::TemporaryFolder folder;
  const std::string root = folder.path().string();
  ASSERT_EQ(
      run_program(fmt::format("amc build {} -o {}/a.ktx2 --size 64 --slices 32", kSilk, root)).exit_code, 0);
  EXPECT_EQ(run_program(fmt::format("amc slices {0}/a.ktx2 -o {0}/sheet.png", root)).exit_code, 0);
  EXPECT_GT(io::read_image(folder / "sheet.png").width, 900);
  EXPECT_EQ(run_program(fmt::format("amc isotropic {0}/a.ktx2 -o {0}/matcap.exr", root)).exit_code, 0);
  EXPECT_EQ(io::read_image(folder / "matcap.exr").width, 64);
}

/// The files of sixteen frames of a material without symmetry, a sixteenth of a turn apart, each at (left,
/// top) of a larger picture.
std::filesystem::path written_frames(const std::filesystem::path& frames, const std::string& extension,
                                     int left = 0, int top = 0, int larger = 0) {
  std::filesystem::create_directory(frames);
  for (int i = 0; i < 16; ++i) {
    const Image sphere =
        test::photograph(24, [&](const Vec3& n) { return test::analytic_colour(n, i / 16.0, 1); });
    Image picture(24 + larger, 24 + larger, 3, 0.5f);
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 24; ++x) picture.set_rgb(left + x, top + y, sphere.rgb(x, y));
    }
    io::write_image(frames / fmt::format("{:02}{}", i, extension), picture);
  }
  return frames;
}

TEST(AmcCommand, TheFirstAngleAndTheDirectionSayWhereTheTangentPoints) {
  const test::TemporaryFolder folder;
  const auto frames = written_frames(folder / "frames", ".exr");
  const std::string output = (folder / "a.ktx2").string();
  ASSERT_EQ(
      run_program(
          fmt::format("amc build {} -o {} --size 24 --slices 16 --symmetry 1 --first-angle 90 --direction cw",
                      frames.string(), output))
          .exit_code,
      0);
  const amc::AmcTable table = amc::read_amc(output);
  EXPECT_EQ(table.encoding, amc::AmcEncoding::half) << "float frames keep their range";
  for (const int f : {0, 3, 4, 9}) {
    // Frame i shows a quarter less i sixteenths of a turn.
    const Image frame = io::read_image(frames / fmt::format("{:02}.exr", (20 - f) % 16));
    EXPECT_LT((table.texel(15, 13, f) - frame.rgb(15, 24 - 1 - 13)).norm(), 2e-3) << f;
  }
}

TEST(AmcCommand, ACropTakesTheSquareOutOfEachFrame) {
  const test::TemporaryFolder folder;
  const auto plain = written_frames(folder / "plain", ".png");
  const auto larger = written_frames(folder / "larger", ".png", 3, 8, 12);
  const auto built = [&](const std::filesystem::path& frames, const std::string& options) {
    const std::string output = (folder / "a.ktx2").string();
    EXPECT_EQ(run_program(
                  fmt::format("amc build {} -o {} --size 24 --slices 4{}", frames.string(), output, options))
                  .exit_code,
              0);
    return amc::read_amc(output);
  };
  const amc::AmcTable expected = built(plain, "");
  const amc::AmcTable cropped = built(larger, " --crop 3,8,24");
  for (int i = 4; i < 20; ++i) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(cropped.texel(i, 12, 1)[c], expected.texel(i, 12, 1)[c], 1e-3);
  }
}

TEST(AmcCommand, EncodingSymmetryAndThresholdAreThoseAskedFor) {
  const test::TemporaryFolder folder;
  const std::string root = folder.path().string();
  const auto info = [&](const char* name) {
    return json::parse(run_program(fmt::format("amc info {}/{} --json", root, name)).output);
  };
  ASSERT_EQ(
      run_program(fmt::format("amc build {} -o {}/a.ktx2 --size 16 --slices 8 --encoding half --symmetry 1",
                              kSilk, root))
          .exit_code,
      0);
  EXPECT_EQ(info("a.ktx2")["encoding"], "half");
  EXPECT_EQ(info("a.ktx2")["symmetry"], 1);
  ASSERT_EQ(run_program(fmt::format("amc convert {0}/a.ktx2 -o {0}/b.ktx2 --encoding srgb8", root)).exit_code,
            0);
  EXPECT_EQ(info("b.ktx2")["encoding"], "srgb8");
  // A quarter of a turn leaves silk alike for those who ask for very little.
  const json report =
      json::parse(run_program(fmt::format("amc symmetry {} --size 16 --threshold 5 --json", kSilk)).output);
  EXPECT_EQ(report["threshold"], 5);
  EXPECT_EQ(report["symmetry"], 4);
}

TEST(AmcCommand, NoFramesAndOneFrameAreRefused) {
  const test::TemporaryFolder folder;
  const std::string output = (folder / "x.ktx2").string();
  const auto none = run_program(fmt::format("amc build {} -o {}", folder.path().string(), output));
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.output, HasSubstr(".png"));
  const auto one = run_program(fmt::format("amc build {}/frame_000.png -o {}", kSilk, output));
  EXPECT_EQ(one.exit_code, 1);
  EXPECT_THAT(one.output, HasSubstr("1 frame"));
  EXPECT_FALSE(std::filesystem::exists(output));
}

TEST(AmcCommand, ACorruptFrameIsNamedAndTheRestNotLostWithSkipBad) {
  const test::TemporaryFolder folder;
  const auto frames = copied_frames(folder, 16);
  std::filesystem::resize_file(frames / "frame_007.png", 5000);
  const std::string output = (folder / "x.ktx2").string();
  const std::string command = fmt::format("amc build {} -o {} --size 32 --slices 8", frames.string(), output);
  const auto refused = run_program(command);
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.output, HasSubstr("frame_007.png"));
  EXPECT_FALSE(std::filesystem::exists(output));
  const auto skipped = run_program(command + " --skip-bad");
  EXPECT_EQ(skipped.exit_code, 0) << skipped.output;
  EXPECT_THAT(skipped.output, HasSubstr("frame_007.png"));
}

TEST(AmcCommand, ANaNInAFrameIsNamed) {
  const test::TemporaryFolder folder;
  const auto frames = folder / "frames";
  std::filesystem::create_directory(frames);
  for (int i = 0; i < 6; ++i) {
    Image image(16, 16, 3, 0.5f);
    if (i == 4) image.at(7, 9, 1) = std::numeric_limits<float>::quiet_NaN();
    io::write_image(frames / fmt::format("{}.exr", i), image);
  }
  const auto result =
      run_program(fmt::format("amc build {} -o {}/x.ktx2", frames.string(), folder.path().string()));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output, HasSubstr("4.exr"));
  EXPECT_THAT(result.output, HasSubstr("(7, 9)"));
}

TEST(AmcCommand, TruncatedAndLyingFilesAreRefused) {
  const test::TemporaryFolder folder;
  const auto path = folder / "x.ktx2";
  ASSERT_EQ(
      run_program(fmt::format("amc build {} -o {} --size 16 --slices 8", kSilk, path.string())).exit_code, 0);
  auto bytes = io::read_bytes(path);
  io::write_bytes(folder / "short.ktx2", std::span(bytes).first(bytes.size() * 2 / 3));
  const auto truncated = run_program(fmt::format("amc info {}/short.ktx2", folder.path().string()));
  EXPECT_EQ(truncated.exit_code, 1);
  EXPECT_THAT(truncated.output, HasSubstr("short.ktx2"));
  // pixelWidth, pixelHeight and pixelDepth stand at byte 20: 2^14 x 2^13 x 2^13 texels.
  for (const std::size_t at : {20u, 24u, 28u}) {
    bytes[at] = std::byte{0};
    bytes[at + 1] = std::byte{static_cast<unsigned char>(at == 20 ? 0x40 : 0x20)};
  }
  io::write_bytes(folder / "huge.ktx2", bytes);
  EXPECT_EQ(run_program(fmt::format("amc info {}/huge.ktx2", folder.path().string())).exit_code, 1);
}

TEST(AmcCommand, AnOutputThatCannotBeWrittenIsNamed) {
  const auto result =
      run_program(fmt::format("amc build {} -o /no/such/folder/x.ktx2 --size 16 --slices 4", kSilk));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output, HasSubstr("/no/such/folder"));
}

}  // namespace
}  // namespace sateen
