// SPDX-License-Identifier: MIT
#include <filesystem>

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
  const Ktx2 normal = read_ktx2(folder / "weave_normal.ktx2");
  const Ktx2 aniso = read_ktx2(folder / "weave_aniso.ktx2");
  EXPECT_EQ(normal.levels.size(), 9u);
  EXPECT_EQ(normal.format, VkFormat::bc5_unorm);
  EXPECT_EQ(aniso.format, VkFormat::bc7_unorm);
  EXPECT_EQ(aniso.metadata.at("SateenFilter"), "sggx-variance");
  const Image decoded = read_data(folder / "rar.png");
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

TEST(MapsAniso, TheSameBytesWithAnyNumberOfThreads) {
  const test::TemporaryFolder folder;
  const std::string command =
      "maps aniso filter --normals " + kWeave + " --constant 0.5 0.25 --effort fast -o ";
  ASSERT_EQ(run_program("--threads 1 " + command + (folder / "one.ktx2").string()).exit_code, 0);
  ASSERT_EQ(run_program(command + (folder / "all.ktx2").string()).exit_code, 0);
  for (const char* map : {"_normal.ktx2", "_aniso.ktx2"}) {
    EXPECT_EQ(read_ktx2(folder / (std::string("one") + map)).levels,
              read_ktx2(folder / (std::string("all") + map)).levels);
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
  write_data(folder / "small.png", Image(8, 8, 3, 0.5f));
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
  write_data(folder / "black.png", Image(8, 8, 3));
  const auto result = run_program("maps aniso filter --normals " + (folder / "black.png").string() +
                                  " --constant 0.5 -o " + (folder / "a.png").string());
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output, HasSubstr("64 normals"));
  const Image normal = read_data(folder / "a_normal_0.png");
  EXPECT_NEAR(normal.at(3, 3, 2), 1, 1e-4);
}

}  // namespace
}  // namespace sateen
