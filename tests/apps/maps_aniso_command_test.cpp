// SPDX-License-Identifier: MIT
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "sateen/io/image.h"
#include "sateen/io/ktx2.h"
#include "support/files.h"

namespace sateen {
namespace {

using test::run_program;
using testing::HasSubstr;

namespace fs = std::filesystem;

const std::string kWeave = (test::examples() / "textures/weave_normal.png").string();

TEST(MapsAniso, HelpExamplesRun) {
  const test::TemporaryFolder folder;
  const std::string here = folder.path().string();
  EXPECT_EQ(run_program("maps aniso author --roughness-u 0.6 --roughness-v 0.3 --rotation 30 -o " + here +
                        "/aniso.png")
                .output,
            "");
  EXPECT_EQ(
      run_program("maps aniso filter --normals " + kWeave + " --constant 0.5 0.25 -o " + here + "/weave.ktx2")
          .output,
      "");
  EXPECT_EQ(
      run_program("maps aniso decode " + here + "/aniso.png --style blender -o " + here + "/rar.png").output,
      "");
  const io::Ktx2 normal = io::read_ktx2(folder / "weave_normal.ktx2");
  const io::Ktx2 aniso = io::read_ktx2(folder / "weave_aniso.ktx2");
  EXPECT_EQ(normal.levels.size(), 9u);
  EXPECT_EQ(normal.format, io::VkFormat::bc5_unorm);
  EXPECT_EQ(aniso.format, io::VkFormat::bc7_unorm);
  EXPECT_EQ(aniso.metadata.at("SateenFilter"), "sggx-variance");
  const Image decoded = io::read_data(folder / "rar.png");
  EXPECT_NEAR(decoded.at(0, 0, 2), 30.0 / 360, 1e-3);
}

TEST(MapsAniso, ReportsTheFilesItWrote) {
  const test::TemporaryFolder folder;
  const auto result = run_program("maps aniso filter --normals " + kWeave +
                                  " --constant 0.4 --levels 3 --bits 8 --kernel kaiser --json -o " +
                                  (folder / "w.png").string());
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const auto report = nlohmann::json::parse(result.output);
  EXPECT_EQ(report["width"], 256);
  ASSERT_EQ(report["files"].size(), 6u);
  for (const auto& file : report["files"]) EXPECT_TRUE(fs::exists(file.get<std::string>()));
}

/// The first pixel of a map that `command` writes as a.exr, decoded in a style.
Vec3f decoded(const test::TemporaryFolder& folder, const std::string& command, const std::string& style,
              const std::string& written = "a.exr", const std::string& options = "") {
  const auto result = run_program("maps aniso " + command + " -o " + (folder / "a.exr").string());
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(run_program("maps aniso decode " + (folder / written).string() + " --style " + style + options +
                        " -o " + (folder / "d.exr").string())
                .exit_code,
            0);
  return io::read_data(folder / "d.exr").rgb(0, 0);
}

std::string plain(const test::TemporaryFolder& folder, const char* name, const Vec3f& value) {
  Image picture(4, 4, 3);
  for (int i = 0; i < 16; ++i) picture.set_rgb(i % 4, i / 4, value);
  io::write_data(folder / name, picture);
  return (folder / name).string();
}

TEST(MapsAniso, AuthorTakesItsInputsInTheUnitsItSays) {
  const test::TemporaryFolder folder;
  const auto near = [](const Vec3f& a, const Vec3f& b) { return (a - b).cwiseAbs().maxCoeff() < 1e-3f; };
  // Gloss is one less roughness, along and across.
  EXPECT_TRUE(near(decoded(folder, "author --gloss-u 0.4 --gloss-v 0.7 --rotation 30", "uv"),
                   {0.6f, 0.3f, 30.0f / 180}));
  // The channel after the colon, of a whole range of 90 degrees.
  const std::string map = plain(folder, "map.exr", {0, 0.5f, 1});
  EXPECT_TRUE(near(
      decoded(folder, "author --roughness-u 0.6 --roughness-v 0.3 --angle-range 90 --rotation " + map + ":g",
              "uv"),
      {0.6f, 0.3f, 45.0f / 180}));
  // A glTF texture: along V, at half its strength in blue.
  const Vec3f gltf = decoded(
      folder, "author --style gltf --roughness 0.5 --vectors " + plain(folder, "v.exr", {0.5f, 1, 0.5f}),
      "gltf");
  EXPECT_TRUE(near(gltf, {0.5f, 1, 0.5f})) << gltf.transpose();
  ASSERT_EQ(run_program("maps aniso decode " + (folder / "a.exr").string() + " --bits 8 -o " +
                        (folder / "d.png").string())
                .exit_code,
            0);
  EXPECT_EQ(io::read_image_info(folder / "d.png").bits, 8);
}

TEST(MapsAniso, FilterTakesItsOptions) {
  const test::TemporaryFolder folder;
  const auto alphas = [&](const std::string& options, const std::string& decoding = "") -> Vec3f {
    return decoded(
        folder,
        "filter --normals " + plain(folder, "n.exr", {0.5f, 0.5f, 1}) + " --constant 0.5 0.25" + options,
        "alphas", "a_aniso_0.exr", decoding);
  };
  const auto near = [](const Vec3f& a, float t, float b) {
    return std::abs(a.x() - t) < 2e-3f && std::abs(a.y() - b) < 2e-3f;
  };
  // alpha = roughness^2
  EXPECT_TRUE(near(alphas(""), 0.25f, 0.0625f));
  EXPECT_TRUE(near(alphas(" --output-encoding correlation", " --encoding correlation"), 0.25f, 0.0625f));
  // The encodings differ where a lobe lies askew.
  ASSERT_EQ(run_program("maps aniso author --roughness-u 0.6 --roughness-v 0.3 --rotation 30 -o " +
                        (folder / "askew.exr").string())
                .exit_code,
            0);
  const Vec3f askew =
      decoded(folder, "filter --aniso " + (folder / "askew.exr").string() + " --output-encoding correlation",
              "uv", "a_aniso_0.exr", " --encoding correlation");
  EXPECT_LT((askew - Vec3f(0.6f, 0.3f, 30.0f / 180)).norm(), 5e-3f) << askew.transpose();
  const Vec3f isotropic = alphas(" --isotropic");
  EXPECT_NEAR(isotropic.x(), isotropic.y(), 2e-3);

  // Green that runs down stays as it is, read and written the same way; values that are normals stay normals.
  const auto normal = [&](const Vec3f& stored, const std::string& options) -> Vec3f {
    EXPECT_EQ(run_program("maps aniso filter --normals " + plain(folder, "n.exr", stored) +
                          " --constant 0.5" + options)
                  .exit_code,
              0);
    return io::read_data(folder / "b_normal_0.png").rgb(0, 0);
  };
  const std::string png = " -o " + (folder / "b.png").string();
  const Vec3f tilted(0.65f, 0.6f, 0.5f + 0.5f * std::sqrt(1 - 0.09f - 0.04f));
  EXPECT_LT((normal(tilted, " --green-down" + png) - tilted).norm(), 1e-3);
  EXPECT_LT((normal(2 * tilted - Vec3f::Ones(), " --normal-values signed" + png) - tilted).norm(), 1e-3);
  EXPECT_EQ(io::read_image_info(folder / "b_normal_0.png").bits, 16);
  normal(tilted, " --bits 8" + png);
  EXPECT_EQ(io::read_image_info(folder / "b_normal_0.png").bits, 8);

  // Normals leaning 47 degrees to either side, hardly more to the right: their mean is upright, but after the
  // eight steps of the power iteration the lobe leans by a quarter of a right angle.
  Image sides(8, 8, 3);
  for (int i = 0; i < 64; ++i) {
    sides.set_rgb(i % 8, i / 8, 0.5f * Vec3f((i < 31 ? -0.731f : 0.731f), 0, 0.682f) + Vec3f::Constant(0.5f));
  }
  io::write_data(folder / "sides.exr", sides);
  const auto lean = [&](const std::string& options) {
    EXPECT_EQ(run_program("maps aniso filter --normals " + (folder / "sides.exr").string() +
                          " --constant 0.2 --method sggx" + options + png)
                  .exit_code,
              0);
    return std::abs(2 * io::read_data(folder / "b_normal_3.png").at(0, 0, 0) - 1);
  };
  EXPECT_LT(lean(""), 0.1f);
  EXPECT_GT(lean(" --power-iteration"), 0.3f);
}

// Only the left column leans: kaiser reaches over the right border to it where the map repeats, box nowhere.
TEST(MapsAniso, KernelAndWrapAreThoseAskedFor) {
  const test::TemporaryFolder folder;
  const auto leans = [&](bool along_v, const std::string& options) {
    Image normals(16, 16, 3);
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x)
        normals.set_rgb(x, y, (along_v ? y : x) == 0 ? Vec3f(0.8f, 0.5f, 0.9f) : Vec3f(0.5f, 0.5f, 1));
    }
    io::write_data(folder / "n.exr", normals);
    EXPECT_EQ(run_program("maps aniso filter --method naive --constant 0.5 --levels 2 --normals " +
                          (folder / "n.exr").string() + options + " -o " + (folder / "a.exr").string())
                  .exit_code,
              0);
    const Image level = io::read_data(folder / "a_normal_1.exr");
    return std::abs(level.at(along_v ? 3 : 7, along_v ? 7 : 3, 0)) > 1e-3;
  };
  EXPECT_FALSE(leans(false, ""));
  EXPECT_TRUE(leans(false, " --kernel kaiser"));
  EXPECT_FALSE(leans(false, " --kernel kaiser --wrap clamp"));
  EXPECT_FALSE(leans(false, " --kernel kaiser --wrap-u clamp"));
  EXPECT_TRUE(leans(false, " --kernel kaiser --wrap-v clamp"));
  EXPECT_TRUE(leans(true, " --kernel kaiser --wrap-u clamp"));
  EXPECT_FALSE(leans(true, " --kernel kaiser --wrap-v clamp"));
}

TEST(MapsAniso, TheSameBytesWithAnyNumberOfThreads) {
  const test::TemporaryFolder folder;
  const std::string command =
      "maps aniso filter --normals " + kWeave + " --constant 0.5 0.25 --effort fast -o ";
  ASSERT_EQ(run_program(command + (folder / "one.ktx2").string() + " --threads 1").exit_code, 0);
  ASSERT_EQ(run_program(command + (folder / "all.ktx2").string()).exit_code, 0);
  for (const char* map : {"_normal.ktx2", "_aniso.ktx2"}) {
    EXPECT_EQ(io::read_ktx2(folder / (std::string("one") + map)).levels,
              io::read_ktx2(folder / (std::string("all") + map)).levels);
  }
}

TEST(MapsAniso, WrongCommandLinesExitWithTwo) {
  const test::TemporaryFolder folder;
  const std::string out = " -o " + (folder / "a.png").string();
  for (const std::string& arguments :
       {"author" + out, "author --roughness-u 0.5" + out, "author --style gltf" + out,
        "author --style blender --roughness-u 0.3 --roughness 0.5" + out, "author --style nonsense" + out,
        "author --roughness-u 0.5 --roughness-v 0.5 --gloss-u 1 --gloss-v 1" + out,
        "filter --normals " + kWeave + " --aniso " + kWeave + " --constant 0.5" + out,
        "filter --normals " + kWeave + " --method linear" + out,
        "filter --normals " + kWeave + " --constant 2" + out}) {
    EXPECT_EQ(run_program("maps aniso " + arguments).exit_code, 2) << arguments;
  }
}

TEST(MapsAniso, WrongInputsExitWithOneAndNameTheFile) {
  const test::TemporaryFolder folder;
  io::write_data(folder / "small.png", Image(8, 8, 3, 0.5f));
  const std::string out = " -o " + (folder / "a.png").string();
  const auto fails = [&](const std::string& arguments, const std::string& text) {
    const auto result = run_program("maps aniso " + arguments);
    EXPECT_EQ(result.exit_code, 1) << arguments;
    EXPECT_THAT(result.output, HasSubstr(text));
  };
  fails("filter --normals nowhere.png" + out, "nowhere.png");
  fails("filter --normals " + kWeave + " --aniso " + (folder / "small.png").string() + out,
        "small.png: is 8 x 8");
  fails("filter" + out, "nothing to filter");
  fails("filter --normals " + kWeave + " -o " + (folder / "a.gif").string(), "a.gif");
  fails("decode nowhere.png" + out, "nowhere.png");
  fails("author --roughness-u nowhere.png --roughness-v 0.5" + out, "nowhere.png");
  EXPECT_FALSE(fs::exists(folder / "a.png"));
}

TEST(MapsAniso, MendsBlackNormalsWithAWarning) {
  const test::TemporaryFolder folder;
  io::write_data(folder / "black.png", Image(8, 8, 3));
  const auto result = run_program("maps aniso filter --normals " + (folder / "black.png").string() +
                                  " --constant 0.5 -o " + (folder / "a.png").string());
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output, HasSubstr("64 normals"));
  const Image normal = io::read_data(folder / "a_normal_0.png");
  EXPECT_NEAR(normal.at(3, 3, 2), 1, 1e-4);
  // The warning does not get into a report that is piped on.
  const auto piped =
      run_program("maps aniso filter --normals " + (folder / "black.png").string() +
                  " --constant 0.5 --json -o " + (folder / "a.png").string() + " 2>/dev/null; true");
  EXPECT_EQ(nlohmann::json::parse(piped.output)["width"], 8);
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// Filters `normals` with constant lobes; the picture of level 1.
Image level_1_of(const fs::path& normals, const test::TemporaryFolder& folder) {
  const auto result = run_program("maps aniso filter --normals " + normals.string() + " --constant 0.5 -o " +
                                  (folder / "out.png").string());
  EXPECT_EQ(result.exit_code, 0) << result.output;
  return io::read_data(folder / "out_normal_1.png");
}

TEST(MapsAniso, SizesThatAreNotSquareNorPowersOfTwo) {
  for (const auto& [w, h] : {std::pair{37, 11}, std::pair{300, 7}, std::pair{1, 9}, std::pair{64, 1}}) {
    const test::TemporaryFolder folder;
    io::write_data(folder / "n.png", Image(w, h, 3, 0.5f));
    for (const char* name : {"a.png", "a.ktx2"}) {
      const auto result = run_program("maps aniso filter --normals " + (folder / "n.png").string() +
                                      " --constant 0.5 0.2 --kernel kaiser -o " + (folder / name).string());
      ASSERT_EQ(result.exit_code, 0) << result.output;
    }
    int levels = 1;
    for (int size = std::max(w, h); size > 1; size /= 2) ++levels;
    EXPECT_EQ(io::read_ktx2(folder / "a_aniso.ktx2").levels.size(), static_cast<std::size_t>(levels));
    EXPECT_TRUE(fs::exists(folder / ("a_normal_" + std::to_string(levels - 1) + ".png")));
  }
}

TEST(MapsAniso, SixteenBitsAndAMissingBlueChannelAreRead) {
  // A slope that 8 bits cannot say, as 16-bit RGB, as x and y alone, and with blue left at 0.
  const float x = 0.5f + 100.3f / 65535;
  const Vec3f n(2 * x - 1, 0.2f, std::sqrt(1 - 0.04f - (2 * x - 1) * (2 * x - 1)));
  for (int kind = 0; kind < 3; ++kind) {
    const test::TemporaryFolder folder;
    Image image(8, 8, kind == 1 ? 2 : 3);
    for (int i = 0; i < 64; ++i) {
      for (int c = 0; c < image.channels; ++c) image.at(i % 8, i / 8, c) = n[c] / 2 + 0.5f;
      if (kind == 2) image.at(i % 8, i / 8, 2) = 0;
    }
    // PNG has no two-channel colour that every tool reads alike; EXR does.
    const fs::path file = folder / (kind == 1 ? "n.exr" : "n.png");
    io::write_data(file, image);
    const Image level = level_1_of(file, folder);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(level.at(1, 2, c), n[c] / 2 + 0.5f, 3e-5f) << kind;
  }
}

TEST(MapsAniso, RoughnessZeroAndOneAreLobes) {
  const test::TemporaryFolder folder;
  Image rough(8, 8, 1);
  for (int i = 0; i < 64; ++i) rough.at(i % 8, i / 8, 0) = i % 8 < 4 ? 0.0f : 1.0f;
  io::write_data(folder / "r.png", rough);
  ASSERT_EQ(run_program("maps aniso filter --roughness " + (folder / "r.png").string() + " -o " +
                        (folder / "a.exr").string())
                .exit_code,
            0);
  ASSERT_EQ(run_program("maps aniso decode " + (folder / "a_aniso_0.exr").string() + " -o " +
                        (folder / "d.exr").string())
                .exit_code,
            0);
  const Image alphas = io::read_data(folder / "d.exr");
  EXPECT_NEAR(alphas.at(1, 1, 0), 1e-3, 1e-5);
  EXPECT_NEAR(alphas.at(6, 6, 0), 1, 1e-3);
  for (const float v : alphas.data) EXPECT_TRUE(std::isfinite(v));
}

TEST(MapsAniso, DamagedFilesAreNamedAndNothingIsLeft) {
  const test::TemporaryFolder folder;
  Image bad(64, 64, 3, 0.5f);
  bad.at(5, 40, 1) = std::numeric_limits<float>::quiet_NaN();
  io::write_data(folder / "nan.exr", bad);
  Image noise(64, 64, 3);
  for (std::size_t i = 0; i < noise.data.size(); ++i)
    noise.data[i] = static_cast<float>(i * 7919 % 251) / 251;
  io::write_data(folder / "cut.png", noise);
  fs::resize_file(folder / "cut.png", fs::file_size(folder / "cut.png") / 2);
  std::ofstream(folder / "empty.png");
  const std::size_t before = files_in(folder.path());
  for (const char* name : {"nan.exr", "cut.png", "empty.png"}) {
    for (const char* out : {"o.png", "o.exr", "o.ktx2"}) {
      const auto result = run_program("maps aniso filter --normals " + (folder / name).string() +
                                      " --constant 0.5 -o " + (folder / out).string());
      EXPECT_EQ(result.exit_code, 1) << name << result.output;
      EXPECT_THAT(result.output, HasSubstr(name));
    }
    const auto result = run_program("maps aniso author --roughness-u " + (folder / name).string() +
                                    ":g --roughness-v 0.5 -o " + (folder / "o.png").string());
    EXPECT_EQ(result.exit_code, 1) << name << result.output;
    EXPECT_THAT(result.output, HasSubstr(name));
  }
  EXPECT_EQ(files_in(folder.path()), before);
}

TEST(MapsAniso, AFullDiskLeavesNothing) {
  // A limit on the size of files stands for the disk: writing fails in the middle.
  const test::TemporaryFolder folder;
  const fs::path out = folder / "out";
  fs::create_directory(out);
  for (const char* const name : {"o.png", "o.exr", "o.ktx2"}) {
    const auto result = run_program(
        "maps aniso filter --normals " + kWeave + " --constant 0.5 0.25 --zstd 0 -o " + (out / name).string(),
        "trap '' XFSZ; ulimit -f 24;");
    EXPECT_EQ(result.exit_code, 1) << name << result.output;
    EXPECT_THAT(result.output, HasSubstr((out / "o").string()));
    EXPECT_EQ(files_in(out), 0u) << name;
  }
}

}  // namespace
}  // namespace sateen
