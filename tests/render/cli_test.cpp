// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sateen/amc/amc_file.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "support/analytic_material.h"
#include "support/files.h"

// `sateen render` and `sateen shade` as users meet them.
namespace sateen::render {
namespace {

using test::ProgramResult;
using testing::HasSubstr;

/// A folder with a cloth of two triangles, with and without UVs, an AMC and a MatCap.
class RenderCli : public testing::Test {
 protected:
  RenderCli() {
    const std::string corners = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n";
    io::write_text(folder / "bare.obj", corners + "f 1 2 3 4\n");
    io::write_text(
        folder / "cloth.obj",
        corners +
            "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl front\nf 1/1 2/2 3/3\nusemtl sleeve\nf 1/1 3/3 4/4\n");
    amc::write_amc(folder / "silk.ktx2", test::analytic_table(16, 16, 2));
    io::write_image(folder / "clay.exr", Image(16, 16, 3, 0.25f));
  }

  std::string at(const std::string& name) const { return fmt::format("'{}'", (folder / name).string()); }
  ProgramResult render(const std::string& mesh, const std::string& rest) const {
    return test::run_program("render " + at(mesh) + " --size 16 --samples 1 " + rest);
  }
  /// Exit code 1, a message with `words`, and no file of the output's name.
  void expect_wrong_input(const ProgramResult& result, const std::string& words) const {
    EXPECT_EQ(result.exit_code, 1) << result.output;
    EXPECT_THAT(result.output, HasSubstr(words));
    EXPECT_FALSE(std::filesystem::exists(folder / "out.png"));
  }

  test::TemporaryFolder folder;
};

TEST_F(RenderCli, DrawsAPictureAndSaysNothing) {
  const ProgramResult result =
      render("cloth.obj", "--material " + at("silk.ktx2") + " -o " + at("out.exr") + " --camera view-space");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.output, "");
  const Image picture = io::read_image(folder / "out.exr");
  EXPECT_EQ(picture.width, 16);
  EXPECT_EQ(picture.channels, 4);
  // A flat cloth facing the viewer, threads along x: the table's middle at k = 0.
  const Vec3 expected = test::analytic_colour(Vec3::UnitZ(), 0, 2);
  EXPECT_LT((picture.rgb(8, 8).cast<double>() - expected).norm(), 0.01);
}

TEST_F(RenderCli, AnotherMaterialIsDrawnToTheRight) {
  const auto picture = [&](const std::string& materials) {
    const ProgramResult result = render("cloth.obj", materials + " -o " + at("out.exr"));
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return io::read_image(folder / "out.exr");
  };
  const Image left = picture("--material " + at("silk.ktx2"));
  const Image right = picture("--material " + at("clay.exr"));
  const Image both = picture("--material " + at("silk.ktx2") + " --compare " + at("clay.exr"));
  ASSERT_EQ(both.width, 32);
  ASSERT_EQ(both.height, 16);
  EXPECT_EQ(cropped(both, {0, 0, 16, 16}).data, left.data);
  EXPECT_EQ(cropped(both, {16, 0, 16, 16}).data, right.data);
}

TEST_F(RenderCli, TurningTheTangentsSwapsWarpAndWeft) {
  ASSERT_EQ(
      render("cloth.obj", "--material " + at("silk.ktx2") + " -o " + at("out.exr") + " --tangent-angle 45")
          .exit_code,
      0);
  const Vec3 expected = test::analytic_colour(Vec3::UnitZ(), 0.125, 2);
  // Near the middle, where the view is straight; samples of a coarse table.
  EXPECT_LT((io::read_image(folder / "out.exr").rgb(8, 8).cast<double>() - expected).norm(), 0.05);
}

TEST_F(RenderCli, RenderedVectorsShadeToTheSamePicture) {
  ASSERT_EQ(
      render("cloth.obj",
             "--material " + at("silk.ktx2") + " -o " + at("out.exr") +
                 " --camera orthographic --rotate 20,30,40 --aov normal,tangent,k,mask,uv,occlusion,position")
          .exit_code,
      0);
  for (const char* name : {"normal", "tangent", "k", "mask", "uv", "occlusion", "position"}) {
    EXPECT_EQ(io::read_data(folder / (std::string("out.") + name + ".exr")).width, 16) << name;
  }
  ASSERT_EQ(
      test::run_program("shade --normals " + at("out.normal.exr") + " --tangents " + at("out.tangent.exr") +
                        " --material " + at("silk.ktx2") + " -o " + at("shaded.exr"))
          .exit_code,
      0);
  const Image drawn = io::read_image(folder / "out.exr");
  const Image shaded = io::read_image(folder / "shaded.exr");
  for (std::size_t i = 0; i < drawn.data.size(); ++i) EXPECT_NEAR(drawn.data[i], shaded.data[i], 6e-3);
}

TEST_F(RenderCli, EachMaterialOfTheMeshCanHaveItsOwn) {
  ASSERT_EQ(render("cloth.obj", "-m " + at("silk.ktx2") + " -m sleeve=" + at("clay.exr") + " -o " +
                                    at("out.exr") + " --camera view-space")
                .exit_code,
            0);
  const Image picture = io::read_image(folder / "out.exr");
  EXPECT_NEAR(picture.at(4, 4, 0), 0.25, 1e-3);  // upper left: sleeve
  EXPECT_NE(picture.at(12, 12, 0), 0.25f);       // lower right: front
  expect_wrong_input(
      render("cloth.obj", "-m " + at("silk.ktx2") + " -m collar=" + at("clay.exr") + " -o " + at("out.png")),
      "sleeve");
}

TEST_F(RenderCli, ATurntableIsNumberedOrAFilm) {
  const std::string material = "--turntable 3 --material " + at("clay.exr");
  ASSERT_EQ(render("cloth.obj", material + " -o " + at("turn.png")).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "turn_0002.png"));
  ASSERT_EQ(render("cloth.obj", material + " -o " + at("turn")).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "turn" / "0002.png"));
  const ProgramResult film = render("cloth.obj", material + " -o " + at("turn.mp4"));
  EXPECT_EQ(film.exit_code, 0) << film.output;
  EXPECT_GT(std::filesystem::file_size(folder / "turn.mp4"), 500u);
}

TEST_F(RenderCli, BackgroundsAndOddSizes) {
  ASSERT_EQ(test::run_program("render " + at("cloth.obj") +
                              " --size 7x13 --background '#ff8000' --rotate 0,90,0 -m " + at("clay.exr") +
                              " -o " + at("out.png"))
                .exit_code,
            0);
  const Image picture = io::read_data(folder / "out.png");
  EXPECT_EQ(picture.width, 7);
  EXPECT_EQ(picture.height, 13);
  EXPECT_NEAR(picture.at(0, 0, 0), 1, 0.003);
  EXPECT_NEAR(picture.at(0, 0, 1), 128.0 / 255, 0.003);
}

// What cannot be transparent is white, and the user is told.
TEST_F(RenderCli, AnOpaqueFileHasAWhiteBackgroundAndSaysSo) {
  const std::string material = "--rotate 0,90,0 -m " + at("clay.exr") + " -o ";
  for (const char* name : {"out.jpg", "out.hdr"}) {
    const ProgramResult result = render("cloth.obj", material + at(name));
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_THAT(result.output, HasSubstr("background is white"));
    EXPECT_NEAR(io::read_image(folder / name).at(0, 0, 0), 1, 1e-6) << name;
    const ProgramResult asked = render("cloth.obj", "--background 0,0,0 " + material + at(name));
    EXPECT_EQ(asked.output, "");
    EXPECT_NEAR(io::read_image(folder / name).at(0, 0, 0), 0, 1e-6) << name;
  }
  const ProgramResult film = render("cloth.obj", "--turntable 2 " + material + at("turn.mp4"));
  EXPECT_THAT(film.output, HasSubstr("background is white"));
  EXPECT_EQ(render("cloth.obj", material + at("out.png")).output, "");
  EXPECT_EQ(io::read_data(folder / "out.png").at(0, 0, 3), 0);
}

TEST_F(RenderCli, ExposureAndViewChangePicturesAndNoSceneLight) {
  const std::string middle = "--camera view-space -m " + at("clay.exr") + " -o ";  // light of 0.25
  const auto stored = [&](const std::string& options) {
    const ProgramResult result = render("cloth.obj", options + " " + middle + at("out.png"));
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return 255 * io::read_data(folder / "out.png").at(8, 8, 1);
  };
  EXPECT_NEAR(stored(""), 137, 0.1);  // sRGB of 0.25
  EXPECT_NEAR(stored("--view srgb --exposure 0"), 137, 0.1);
  EXPECT_NEAR(stored("--exposure 1"), 188, 0.1);     // of 0.5
  EXPECT_NEAR(stored("--exposure -1"), 99, 0.1);     // of 0.125
  EXPECT_NEAR(stored("--view none"), 64, 0.1);       // 0.25 itself
  EXPECT_NEAR(stored("--view neutral"), 126, 0.1);   // of 0.25 - 0.04
  EXPECT_NEAR(stored("--view agx"), 143, 0.1);       // of three.js' 0.27483
  EXPECT_NEAR(stored("--exposure auto"), 118, 0.1);  // of 0.18
  const ProgramResult exr = render("cloth.obj", "--exposure 1 " + middle + at("out.exr"));
  EXPECT_THAT(exr.output, HasSubstr("--exposure"));
  EXPECT_NEAR(io::read_image(folder / "out.exr").at(8, 8, 1), 0.25, 1e-3);
}

// A lamp of any strength gives the same picture; baked light is what it is.
TEST_F(RenderCli, LitScenesAreExposedAndBakedLightIsNot) {
  const auto lit = [&](const std::string& strength) {
    io::write_text(
        folder / "lit.json",
        R"({"model": "layered", "base": {"color": 0.5}, "lights": [{"direction": [0, 0, 1], "color": )" +
            strength + "}]}");
    const ProgramResult result =
        render("cloth.obj", "--camera view-space -m " + at("lit.json") + " -o " + at("out.png"));
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_THAT(result.output, HasSubstr("metered"));
    return 255 * io::read_data(folder / "out.png").at(8, 8, 0);
  };
  EXPECT_NEAR(lit("0.001"), 118, 0.1);  // sRGB of 0.18
  EXPECT_NEAR(lit("3000"), 118, 0.1);
  const ProgramResult exr =
      render("cloth.obj", "--camera view-space -m " + at("lit.json") + " -o " + at("out.exr"));
  EXPECT_EQ(exr.output, "");
  EXPECT_NEAR(io::read_image(folder / "out.exr").at(8, 8, 0), 3000 * 0.5 / kPi, 0.5);
  EXPECT_EQ(render("cloth.obj", "-m " + at("clay.exr") + " -o " + at("out.png")).output, "");
}

TEST_F(RenderCli, ShadedPicturesAreShownLikeDrawnOnes) {
  Image normals(2, 1, 3);
  normals.set_rgb(0, 0, {0, 0, 1});  // and a pixel with nothing
  io::write_data(folder / "normals.exr", normals);
  const std::string shade =
      "shade --normals " + at("normals.exr") + " -m " + at("clay.exr") + " --exposure 1 --view none -o ";
  ASSERT_EQ(test::run_program(shade + at("out.png")).exit_code, 0);
  EXPECT_NEAR(255 * io::read_data(folder / "out.png").at(0, 0, 0), 128, 0.6);
  const ProgramResult jpeg = test::run_program(shade + at("out.jpg"));
  EXPECT_THAT(jpeg.output, HasSubstr("background is white"));
  EXPECT_GT(io::read_image(folder / "out.jpg").at(1, 0, 0), 0.9);
}

TEST_F(RenderCli, NoUvsIsExplainedAndProceduralTangentsHelp) {
  expect_wrong_input(render("bare.obj", "--material " + at("silk.ktx2") + " -o " + at("out.png")),
                     "--tangents around:y");
  EXPECT_EQ(render("bare.obj", "--material " + at("silk.ktx2") + " --tangents along:x -o " + at("out.png"))
                .exit_code,
            0);
  std::filesystem::remove(folder / "out.png");
  EXPECT_EQ(render("bare.obj", "--material " + at("clay.exr") + " -o " + at("out.png")).exit_code, 0);
}

TEST_F(RenderCli, WrongInputIsNamed) {
  const std::string output = " -o " + at("out.png");
  expect_wrong_input(render("none.obj", "-m " + at("clay.exr") + output), "none.obj");
  expect_wrong_input(render("cloth.obj", "-m " + at("none.ktx2") + output), "none.ktx2");
  expect_wrong_input(render("cloth.obj", "-m " + at("cloth.obj") + output), "no material");
  expect_wrong_input(render("bare.obj", "-m " + at("clay.exr") + " --normal-map " + at("clay.exr") + output),
                     "UVs");
  expect_wrong_input(render("cloth.obj", "-m " + at("clay.exr") + " --occlusion " + at("none.png") + output),
                     "none.png");
  expect_wrong_input(render("cloth.obj", "-m " + at("clay.exr") + " -o " + at("missing/out.png")), "missing");
  expect_wrong_input(render("cloth.obj", "-m " + at("clay.exr") + " -o " + at("out.gif")), "out.gif");
  expect_wrong_input(
      test::run_program("shade --normals " + at("clay.exr") + " -m " + at("silk.ktx2") + output), "tangents");
}

TEST_F(RenderCli, AWrongCommandLineExitsWithTwo) {
  const std::string rest = "-m " + at("clay.exr") + " -o " + at("out.png");
  for (const std::string option :
       {"--rotate 1,2", "--rotate a,b,c", "--background '#12'", "--tangents sideways",
        "--tangents around:0,0,0", "--aov beauty", "--camera fisheye", "--samples 0",
        "--no-cyclic-fix --per-fragment", "--turntable -1", "--exposure bright", "--exposure 1,5",
        "--exposure 99", "--exposure nan", "--view filmic"}) {
    EXPECT_EQ(render("cloth.obj", rest + " " + option).exit_code, 2) << option;
  }
  for (const std::string size : {"0", "10x", "x10", "10x10x10", "99999999x1", "-4"}) {
    EXPECT_EQ(test::run_program("render " + at("cloth.obj") + " " + rest + " --size=" + size).exit_code, 2)
        << size;
  }
  EXPECT_EQ(test::run_program("render " + at("cloth.obj") + " " + rest + " --size 20x10 --camera view-space")
                .exit_code,
            2);
  EXPECT_EQ(render("cloth.obj", "-m " + at("clay.exr") + " -o " + at("film.mp4")).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder / "out.png"));
}

}  // namespace
}  // namespace sateen::render
