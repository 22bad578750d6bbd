// SPDX-License-Identifier: MIT
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "sateen/io/file.h"
#include "sateen/matcap/bake.h"
#include "support/matcaps.h"

namespace sateen {
namespace {

using nlohmann::json;
using test::run_program;
using testing::HasSubstr;

/// A shipped MatCap, shrunk, as a file.
std::string written(const test::TemporaryFolder& folder, const std::string& name,
                    const std::string& extension = ".exr") {
  const auto path = folder / (name + extension);
  io::write_image(path, test::example_matcap(name, 96));
  return path.string();
}

TEST(MatcapCommand, DecomposeInfoAndBakeGiveTheInputBack) {
  const test::TemporaryFolder folder;
  const std::string input = written(folder, "lead", ".png");
  const std::string matcap = (folder / "lead.ktx2").string();
  ASSERT_EQ(run_program(fmt::format("matcap decompose {} -o {}", input, matcap)).exit_code, 0);
  const json info = json::parse(run_program(fmt::format("matcap info {} --json", matcap)).output);
  EXPECT_GT(info["low"]["variance"], info["high"]["variance"]);
  EXPECT_EQ(info["low"]["base_color"].size(), 3U);
  EXPECT_EQ(info["width"], 96);
  EXPECT_EQ(info["provenance"]["source"], "lead.png");
  const std::string baked = (folder / "baked.png").string();
  ASSERT_EQ(run_program(fmt::format("matcap bake {} -o {}", matcap, baked)).exit_code, 0);
  EXPECT_GT(
      matcap::psnr_on_disc(io::read_image(baked), io::read_image(input), matcap::inscribed_disc(96, 96)), 50);
}

TEST(MatcapCommand, BakesEditsLayersAndEnvironments) {
  const test::TemporaryFolder folder;
  const std::string matcap = (folder / "jade.ktx2").string();
  ASSERT_EQ(run_program(fmt::format("matcap decompose {} -o {}", written(folder, "jade"), matcap)).exit_code,
            0);
  io::write_text(folder / "edits.json", R"([{"edit": "intensity", "part": "high", "factor": 0}])");
  const auto path = [&](const char* name) { return (folder / name).string(); };
  const auto ok = [&](const std::string& options) {
    const auto result = run_program(fmt::format("matcap bake {} {}", matcap, options));
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_EQ(result.output, "");
  };
  ok("--edits " + path("edits.json") + " --turn 0,30,0 --size 50 -o " + path("turned.exr"));
  EXPECT_EQ(io::read_image(folder / "turned.exr").width, 50);
  ok("--layers -o " + path("layers.exr"));
  EXPECT_EQ(io::read_image_info(folder / "layers.exr").channels, 6);
  ok("--environment high --environment-height 32 -o " + path("env.hdr"));
  EXPECT_EQ(io::read_image(folder / "env.hdr").width, 64);
  EXPECT_EQ(run_program(fmt::format("matcap bake {} --layers -o {}", matcap, path("x.png"))).exit_code, 2);
  EXPECT_EQ(
      run_program(fmt::format("matcap bake {} --edits {} -o {}", matcap, path("none.json"), path("x.png")))
          .exit_code,
      1);
  EXPECT_FALSE(std::filesystem::exists(folder / "x.png"));
}

TEST(MatcapCommand, SeparateAddsUpAndEstimateReports) {
  const test::TemporaryFolder folder;
  const std::string input = written(folder, "lead");
  const auto path = [&](const char* name) { return (folder / name).string(); };
  ASSERT_EQ(run_program(fmt::format("matcap separate {} --linear --low {} --high {}", input, path("l.exr"),
                                    path("h.exr")))
                .exit_code,
            0);
  const Image low = io::read_data(path("l.exr"));
  const Image high = io::read_data(path("h.exr"));
  const Image whole = io::read_image(input);
  for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(low.at(40, 30, c) + high.at(40, 30, c), whole.at(40, 30, c));
  const auto estimate =
      run_program(fmt::format("matcap estimate {} --json --plot {} --roi 60,20,6,6", input, path("s.svg")));
  ASSERT_EQ(estimate.exit_code, 0) << estimate.output;
  const json report = json::parse(estimate.output);
  EXPECT_EQ(report["high"]["automatic"], false);
  EXPECT_GT(report["high"]["signature"].size(), 10U);
  EXPECT_THAT(io::read_text(path("s.svg")), HasSubstr("</svg>"));
  EXPECT_EQ(run_program(fmt::format("matcap estimate {} --roi 60,20,6", input)).exit_code, 2);
  EXPECT_EQ(run_program(fmt::format("matcap estimate {} --roi 0,0,1,1", input)).exit_code, 1);
  const auto all = run_program(fmt::format("matcap estimate {} --json --roi 0,0,96,96", input));
  for (const char* region : {"0,0,2147483647,2147483647", "-5,-5,2147483647,2147483647"}) {
    EXPECT_EQ(json::parse(run_program(fmt::format("matcap estimate {} --json --roi={}", input, region))
                              .output)["high"]["variance"],
              json::parse(all.output)["high"]["variance"]);
  }
  EXPECT_EQ(run_program(fmt::format("matcap estimate {} --roi=2147483647,5,2147483647,9", input)).exit_code,
            1);
}

TEST(MatcapCommand, BadPicturesAreNamedAndTheOthersOfAFolderDone) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "in");
  io::write_image(folder / "in" / "good.png", test::example_matcap("jade", 48));
  io::write_image(folder / "in" / "pixel.png", Image(1, 1, 3, 0.5F));
  io::write_image(folder / "in" / "wide.png", Image(64, 32, 3, 0.5F));
  io::write_text(folder / "in" / "torn.png", "\x89PNG\r\n");
  const auto result = run_program(
      fmt::format("matcap decompose {} -o {}", (folder / "in").string(), (folder / "out").string()));
  EXPECT_EQ(result.exit_code, 1);
  for (const char* name : {"3 of 4", "pixel.png", "wide.png", "torn.png"})
    EXPECT_THAT(result.output, HasSubstr(name));
  EXPECT_TRUE(std::filesystem::exists(folder / "out" / "good.ktx2"));
  EXPECT_TRUE(std::filesystem::exists(folder / "out" / "index.html"));
  const auto disc =
      run_program(fmt::format("matcap decompose {} --disc 20,16,12 -o {}",
                              (folder / "in" / "wide.png").string(), (folder / "w.ktx2").string()));
  EXPECT_EQ(disc.exit_code, 0) << disc.output;
  EXPECT_EQ(run_program(fmt::format("matcap decompose {} --disc 20,16,30 -o {}",
                                    (folder / "in" / "wide.png").string(), (folder / "v.ktx2").string()))
                .exit_code,
            1);
  EXPECT_FALSE(std::filesystem::exists(folder / "v.ktx2"));
}

/// Runs each verb that reads a MatCap; says how it ended, and that nothing is left if it failed.
void expect_on_each_verb(const std::filesystem::path& picture, int exit_code, const std::string& message,
                         const std::string& options = "") {
  const test::TemporaryFolder folder;
  const auto path = [&](const char* name) { return (folder / name).string(); };
  for (const std::string& verb :
       {fmt::format("decompose {{}} -o {}", path("o.ktx2")), std::string("estimate {}"),
        fmt::format("separate {{}} --low {} --high {}", path("l.exr"), path("h.exr"))}) {
    const auto result =
        run_program("matcap " + fmt::format(fmt::runtime(verb), picture.string()) + " " + options);
    EXPECT_EQ(result.exit_code, exit_code) << verb << picture << result.output;
    EXPECT_THAT(result.output, HasSubstr(message)) << verb;
    if (exit_code != 0) {
      EXPECT_THAT(result.output, HasSubstr(picture.filename().string())) << verb;
      EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << verb << picture;
    }
  }
}

TEST(MatcapCommand, BadPicturesAreRefusedByEachVerbWithAReason) {
  const test::TemporaryFolder folder;
  const auto data = test::source_dir() / "tests" / "data";
  io::write_image(folder / "pixel.png", Image(1, 1, 3, 0.5F));
  io::write_image(folder / "wide.png", Image(48, 32, 3, 0.5F));
  Image nan(16, 16, 3, 0.5F);
  nan.at(3, 4, 1) = std::numeric_limits<float>::quiet_NaN();
  io::write_data(folder / "nan.exr", nan);
  io::write_image(folder / "whole.png", test::example_matcap("lead", 48));
  io::write_text(folder / "torn.png", io::read_text(folder / "whole.png").substr(0, 700));
  expect_on_each_verb(folder / "pixel.png", 1, "at least 2 are needed");
  expect_on_each_verb(folder / "wide.png", 1, "no sphere found");
  expect_on_each_verb(folder / "nan.exr", 1, "not finite");
  expect_on_each_verb(folder / "torn.png", 1, "is truncated or corrupt");
  expect_on_each_verb(data / "animated.gif", 1, "is animated");
  expect_on_each_verb(data / "cmyk.jpg", 1, "CMYK");
  expect_on_each_verb(folder / "whole.png", 1, "does not fit", "--disc 24,24,30");
}

TEST(MatcapCommand, OddPicturesAreDoneByEachVerb) {
  const test::TemporaryFolder folder;
  io::write_image(folder / "black.png", Image(32, 32, 3, 0));
  expect_on_each_verb(folder / "black.png", 0, "");
  // A sphere smaller than its picture, before a plain background and cut out by alpha.
  const Image lead = test::example_matcap("lead", 48);
  Image plain(80, 64, 3, 0.9F);
  Image alpha(80, 64, 4, 0);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 48; ++x) {
      if (disc_of_pixel(x, y, 48).squaredNorm() >= 1) continue;
      plain.set_rgb(20 + x, 10 + y, lead.rgb(x, y));
      alpha.set_rgb(20 + x, 10 + y, lead.rgb(x, y));
      alpha.at(20 + x, 10 + y, 3) = 1;
    }
  }
  io::write_image(folder / "plain.png", plain);
  io::write_image(folder / "alpha.png", alpha);
  for (const char* name : {"plain.png", "alpha.png"}) {
    expect_on_each_verb(folder / name, 0, "");
    const std::string matcap = (folder / "o.ktx2").string();
    ASSERT_EQ(
        run_program(fmt::format("matcap decompose {} -o {}", (folder / name).string(), matcap)).exit_code, 0);
    const json info = json::parse(run_program(fmt::format("matcap info {} --json", matcap)).output);
    EXPECT_NEAR(info["disc"]["x"].get<double>(), 44, 1) << name;
    EXPECT_NEAR(info["disc"]["y"].get<double>(), 34, 1) << name;
    EXPECT_NEAR(info["disc"]["radius"].get<double>(), 24, 1) << name;
  }
}

}  // namespace
}  // namespace sateen
