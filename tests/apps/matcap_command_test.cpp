// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "sateen/io/file.h"
#include "sateen/matcap/bake.h"
#include "sateen/matcap/decomposition_file.h"
#include "sateen/matcap/edits.h"
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
  io::write_text(
      folder / "edits.json",
      R"([{"edit": "intensity", "part": "high", "factor": 0.5}, {"edit": "turn", "degrees": [0, 0, 70]}])");
  const auto path = [&](const char* name) { return (folder / name).string(); };
  const auto ok = [&](const std::string& options) {
    const auto result = run_program(fmt::format("matcap bake {} {}", matcap, options));
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_EQ(result.output, "");
  };
  const auto worst = [](const Image& a, const Image& b) {
    float most = a.data.size() == b.data.size() ? 0.0f : 1e9f;
    for (std::size_t i = 0; i < std::min(a.data.size(), b.data.size()); ++i)
      most = std::max(most, std::abs(a.data[i] - b.data[i]) / (0.1f + std::abs(b.data[i])));
    return most;
  };
  // The turn in degrees, after the edits; the sphere fills the picture of the size asked for.
  ok("--edits " + path("edits.json") + " --turn 0,30,0 --size 50 -o " + path("turned.exr"));
  const matcap::MatcapDecomposition whole = matcap::read_matcap(matcap);
  const std::vector<matcap::Edit> edits{matcap::Intensity{matcap::Part::high, 0.5},
                                        matcap::Turn{{0, 0, radians(70)}}, matcap::Turn{{0, radians(30), 0}}};
  matcap::EditedMatcap turned = matcap::apply_edits(whole, edits);
  turned.matcap.width = turned.matcap.height = 50;
  turned.matcap.disc = matcap::inscribed_disc(50, 50);
  EXPECT_LT(worst(io::read_image(folder / "turned.exr"), matcap::bake(turned)), 2e-3f);
  // Layers by name: what the low part alone shows, and the rest.
  ok("--layers -o " + path("layers.exr"));
  const Image layers = io::read_data(folder / "layers.exr");
  ASSERT_EQ(io::read_image_info(folder / "layers.exr").channels, 6);
  const auto expected = matcap::bake_layers(matcap::unedited(whole));
  EXPECT_LT((layers.rgb(40, 30) - expected[0].rgb(40, 30)).norm(), 2e-3f);
  ok("--environment high --environment-height 32 -o " + path("high.exr"));
  ok("--environment low --environment-height 32 -o " + path("low.exr"));
  EXPECT_LT(worst(io::read_image(folder / "high.exr"),
                  matcap::bake_environment(matcap::unedited(whole), matcap::Part::high, 32)),
            2e-3f);
  EXPECT_LT(worst(io::read_image(folder / "low.exr"),
                  matcap::bake_environment(matcap::unedited(whole), matcap::Part::low, 32)),
            2e-3f);
  EXPECT_EQ(run_program(fmt::format("matcap bake {} --layers -o {}", matcap, path("x.png"))).exit_code, 2);
  EXPECT_EQ(
      run_program(fmt::format("matcap bake {} --edits {} -o {}", matcap, path("none.json"), path("x.png")))
          .exit_code,
      1);
  EXPECT_FALSE(std::filesystem::exists(folder / "x.png"));
}

TEST(MatcapCommand, DecomposeTakesItsOptions) {
  const test::TemporaryFolder folder;
  const std::string input = written(folder, "lead");
  const auto out = folder / "out";
  const std::string command =
      fmt::format("matcap decompose {} -o {} --map-size 32 --linear --roi 60,20,6,6 --low-roi 30,40,4,4",
                  input, out.string());
  ASSERT_EQ(run_program(command).exit_code, 0);
  const json info =
      json::parse(run_program(fmt::format("matcap info {} --json", (out / "lead.ktx2").string())).output);
  EXPECT_EQ(info["map_size"], 32);
  EXPECT_EQ(info["space"], "linear");
  EXPECT_EQ(info["high"]["regions"], json::parse("[[60, 20, 6, 6]]"));
  EXPECT_EQ(info["low"]["regions"], json::parse("[[30, 40, 4, 4]]"));
  // What is there is kept, unless it is asked for anew.
  const auto long_ago = std::filesystem::last_write_time(out / "lead.ktx2") - std::chrono::hours(1);
  std::filesystem::last_write_time(out / "lead.ktx2", long_ago);
  ASSERT_EQ(run_program(command).exit_code, 0);
  EXPECT_EQ(std::filesystem::last_write_time(out / "lead.ktx2"), long_ago);
  ASSERT_EQ(run_program(command + " --anew").exit_code, 0);
  EXPECT_NE(std::filesystem::last_write_time(out / "lead.ktx2"), long_ago);
}

// A single black pixel is dirt, and does not darken what is around it, unless it is asked for.
TEST(MatcapCommand, SeparateHeedsBlackPixelsWhenAsked) {
  const test::TemporaryFolder folder;
  Image grey(48, 48, 3, 0.5f);
  grey.set_rgb(24, 20, Vec3f::Zero());
  io::write_image(folder / "grey.exr", grey);
  const auto low = [&](const std::string& options) {
    EXPECT_EQ(run_program(fmt::format("matcap separate {} --linear --disc 24,24,24 --low {} --high {}{}",
                                      (folder / "grey.exr").string(), (folder / "l.exr").string(),
                                      (folder / "h.exr").string(), options))
                  .exit_code,
              0);
    return io::read_data(folder / "l.exr").at(25, 21, 1);
  };
  EXPECT_GT(low(""), 0.4f);
  EXPECT_LT(low(" --keep-outliers"), 0.2f);
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
  EXPECT_EQ(report["high"]["regions"], json::parse("[[60, 20, 6, 6]]"));
  // In words, the deviation in degrees.
  const double variance = report["high"]["variance"];
  EXPECT_THAT(run_program(fmt::format("matcap estimate {} --roi 60,20,6,6", input)).output,
              HasSubstr(fmt::format("({:.2f} degrees)", degrees(std::sqrt(variance)))));
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
  const json info =
      json::parse(run_program(fmt::format("matcap info {} --json", (folder / "w.ktx2").string())).output);
  EXPECT_EQ(info["disc"], json::parse(R"({"x": 20, "y": 16, "radius": 12})"));
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
