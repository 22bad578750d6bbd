// SPDX-License-Identifier: MIT
#include <cmath>
#include <map>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sateen/amc/amc_file.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "sateen/io/video_reader.h"
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
  /// Output variables of the drawn cloth, by name.
  std::map<std::string, Image> aovs(const std::vector<std::string>& names, const std::string& rest,
                                    const std::string& mesh = "cloth.obj") const {
    const ProgramResult result = render(mesh, fmt::format("-m {} --aov {} -o {} {}", at("clay.exr"),
                                                          fmt::join(names, ","), at("out.exr"), rest));
    EXPECT_EQ(result.exit_code, 0) << result.output;
    std::map<std::string, Image> found;
    for (const std::string& name : names) found[name] = io::read_data(folder / ("out." + name + ".exr"));
    return found;
  }
  Image aov(const std::string& name, const std::string& rest) const { return aovs({name}, rest).at(name); }
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
  // About x, then y, then z, with the thumb along each.
  const Vec3 about_x(0, -std::sin(radians(20)), std::cos(radians(20)));
  const Vec3 about_y(about_x.z() * std::sin(radians(30)), about_x.y(), about_x.z() * std::cos(radians(30)));
  const Vec3 about_z(about_y.x() * std::cos(radians(40)) - about_y.y() * std::sin(radians(40)),
                     about_y.x() * std::sin(radians(40)) + about_y.y() * std::cos(radians(40)), about_y.z());
  EXPECT_LT((io::read_data(folder / "out.normal.exr").rgb(8, 8).cast<double>() - about_z).norm(), 1e-4);
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
  const ProgramResult film =
      render("cloth.obj", material + " --rotate 0,90,0 --background '#ff8000' --fps 10 -o " + at("turn.mp4"));
  EXPECT_EQ(film.exit_code, 0) << film.output;
  io::VideoReader reader(folder / "turn.mp4");
  EXPECT_NEAR(reader.frames_per_second(), 10, 1e-6);
  io::Picture8 frame;
  ASSERT_TRUE(reader.next(frame));  // the cloth seen from its edge
  EXPECT_NEAR(frame.rgb[0], 255, 12);
  EXPECT_NEAR(frame.rgb[1], 128, 12);
  EXPECT_NEAR(frame.rgb[2], 0, 12);
}

// --rotate says how the object stands on the table; the table turns counter-clockwise, seen from above, and
// its last picture is not its first again.
TEST_F(RenderCli, ATurntableTurnsTheObjectAsItStands) {
  ASSERT_EQ(render("cloth.obj", "-m " + at("clay.exr") +
                                    " --camera orthographic --rotate 20,0,0 --turntable 8 --aov normal -o " +
                                    at("turn.exr"))
                .exit_code,
            0);
  const Vec3 expected(std::cos(radians(20)) * std::sin(radians(45)), -std::sin(radians(20)),
                      std::cos(radians(20)) * std::cos(radians(45)));
  EXPECT_LT((io::read_data(folder / "turn_0001.normal.exr").rgb(8, 8).cast<double>() - expected).norm(),
            1e-4);
}

TEST_F(RenderCli, TheCameraIsWhereTheOptionsSay) {
  const auto distance = [&](int fov) { return -aov("position", fmt::format("--fov {}", fov)).at(8, 8, 2); };
  EXPECT_NEAR(distance(20) / distance(60), std::tan(radians(30)) / std::tan(radians(10)), 1e-3);
  // The plane of coordinates itself, without a margin.
  const Image position = aov("position", "--camera view-space");
  EXPECT_NEAR(position.at(0, 3, 0), -15.0 / 16, 1e-5);
  EXPECT_NEAR(position.at(0, 3, 1), 9.0 / 16, 1e-5);
}

TEST_F(RenderCli, SamplesSoftenEdges) {
  const auto partly_covered = [&](int samples) {
    EXPECT_EQ(test::run_program(fmt::format("render {} --size 16 --samples {} --rotate 0,0,30 -m {} -o {}",
                                            at("cloth.obj"), samples, at("clay.exr"), at("out.exr")))
                  .exit_code,
              0);
    const Image picture = io::read_image(folder / "out.exr");
    int count = 0;
    for (int i = 0; i < 256; ++i) {
      const float alpha = picture.at(i % 16, i / 16, 3);
      count += alpha > 0.1f && alpha < 0.9f ? 1 : 0;
    }
    return count;
  };
  EXPECT_EQ(partly_covered(1), 0);
  EXPECT_GT(partly_covered(4), 10);
}

// A MatCap whose red is n_x: what each way makes of a normal that points to the viewer's plane.
TEST_F(RenderCli, PerspectiveIsCorrectedAsAsked) {
  Image ramp(64, 64, 3);
  for (int i = 0; i < 64 * 64; ++i)
    ramp.set_rgb(i % 64, i / 64, Vec3f::Constant((static_cast<float>(i % 64) + 0.5f) / 64));
  io::write_image(folder / "ramp.exr", ramp);
  const auto n_x = [&](const std::string& how) {
    EXPECT_EQ(
        render("cloth.obj", "--fov 90 -m " + at("ramp.exr") + " --aov position -o " + at("out.exr") + how)
            .exit_code,
        0);
    return 2.0 * io::read_image(folder / "out.exr").at(3, 3, 0) - 1;
  };
  const double rotated = n_x("");
  const Vec3 p = io::read_data(folder / "out.position.exr").rgb(3, 3).cast<double>();
  EXPECT_NEAR(rotated, p.x() / p.norm(), 3e-3);
  EXPECT_NEAR(n_x(" --perspective equation4"), p.x() / std::hypot(p.x(), p.z()), 3e-3);
  EXPECT_NEAR(n_x(" --perspective none"), 0, 3e-3);
}

TEST_F(RenderCli, MapsAreLaidOnAsAsked) {
  const auto plain = [&](const char* name, const Vec3f& value) {
    Image picture(4, 4, 3);
    for (int i = 0; i < 16; ++i) picture.set_rgb(i % 4, i / 4, value);
    io::write_data(folder / name, picture);
    return at(name);
  };
  const auto seen = aovs({"normal", "tangent", "occlusion"},
                         "--camera view-space --normal-map " + plain("n.exr", {0.8f, 0.5f, 0.9f}) +
                             " --normal-scale 0.5 --direction-map " + plain("d.exr", {0.5f, 1, 0}) +
                             " --occlusion " + plain("o.exr", {0.25f, 1, 1}));
  EXPECT_LT((seen.at("normal").rgb(8, 8) - Vec3f(0.3f, 0, 0.8f).normalized()).norm(), 2e-3);
  EXPECT_LT((seen.at("tangent").rgb(8, 8) - Vec3f::UnitY()).norm(), 2e-3);
  EXPECT_NEAR(seen.at("occlusion").at(8, 8, 0), 0.25, 1e-3);
}

TEST_F(RenderCli, TangentsFollowTheFieldAndTheAngle) {
  const auto tangent = [&](const std::string& options) -> Vec3 {
    return aov("tangent", "--camera view-space --per-fragment " + options).rgb(12, 3).cast<double>();
  };
  const Vec3 place(9.0 / 16, 9.0 / 16, 0);  // of that pixel; the field is interpolated from the corners
  const Vec3 around = Vec3(-place.y(), place.x(), 0).normalized();
  EXPECT_LT((tangent("--tangents around:z") - around).norm(), 0.05);
  EXPECT_LT((tangent("--tangents around:z --tangent-angle 90") + place.normalized()).norm(), 0.05);
  EXPECT_LT((tangent("--tangents along:0,2,0") - Vec3::UnitY()).norm(), 1e-4);
}

TEST_F(RenderCli, AnglesAreInterpolatedAsAsked) {
  const auto worst = [&](const std::string& options) {
    const auto seen = aovs({"k", "tangent", "mask"},
                           "--camera view-space --tangents around:z --tangent-angle 20 " + options);
    double most = 0;
    for (int i = 0; i < 256; ++i) {
      const Vec3f t = seen.at("tangent").rgb(i % 16, i / 16);
      const double k = std::atan2(t.y(), t.x()) / (2 * kPi);
      most = std::max(most, std::abs(std::remainder(seen.at("k").at(i % 16, i / 16, 0) - k, 1)));
    }
    return most;
  };
  EXPECT_LT(worst("--per-fragment"), 1e-4);
  const double fixed = worst("");
  EXPECT_GT(fixed, 1e-3);
  EXPECT_LT(fixed, 0.25);  // between corners that point opposite ways
  EXPECT_GT(worst("--no-cyclic-fix"), 0.3);
}

TEST_F(RenderCli, NormalsAreMadeUnitUnlessAskedNotTo) {
  io::write_text(folder / "bent.obj",
                 "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvn -0.6 0 0.8\nvn 0.6 0 0.8\n"
                 "f 1//1 2//2 3//2\nf 1//1 3//2 4//1\n");
  const auto length = [&](const std::string& options) {
    return aovs({"normal"}, "--camera view-space " + options, "bent.obj").at("normal").rgb(8, 8).norm();
  };
  EXPECT_NEAR(length(""), 1, 1e-4);
  EXPECT_LT(length("--no-renormalise"), 0.85);
}

// Light from the left; turned counter-clockwise, seen from above, it comes from the viewer.
TEST_F(RenderCli, AnEnvironmentTurnsCounterClockwise) {
  Image left(64, 32, 3);
  for (int y = 0; y < 32; ++y) {
    for (int x = 12; x < 20; ++x) left.set_rgb(x, y, Vec3f::Ones());  // the middle is behind the object
  }
  io::write_image(folder / "left.exr", left);
  io::write_text(folder / "white.json", R"({"model": "layered", "base": {"color": 1}})");
  Image normal(1, 1, 3);
  normal.set_rgb(0, 0, {0, 0, 1});
  io::write_data(folder / "normal.exr", normal);
  const std::string lit = " -m " + at("white.json") + " --env " + at("left.exr") + " -o " + at("out.exr");
  const auto drawn = [&](int angle) {
    EXPECT_EQ(render("cloth.obj", fmt::format("--camera view-space --env-rotate {}{}", angle, lit)).exit_code,
              0);
    return io::read_image(folder / "out.exr").at(8, 8, 1);
  };
  const auto shaded = [&](int angle) {
    EXPECT_EQ(
        test::run_program(fmt::format("shade --normals {} --env-rotate {}{}", at("normal.exr"), angle, lit))
            .exit_code,
        0);
    return io::read_image(folder / "out.exr").at(0, 0, 1);
  };
  EXPECT_GT(drawn(60), 3 * drawn(-60) + 0.05);
  EXPECT_GT(shaded(60), 3 * shaded(-60) + 0.05);
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
  EXPECT_NEAR(stored("--exposure 1"), 188, 0.1);  // of 0.5
  EXPECT_NEAR(stored("--exposure +1"), 188, 0.1);
  EXPECT_NEAR(stored("--exposure -1"), 99, 0.1);     // of 0.125
  EXPECT_NEAR(stored("--view none"), 64, 0.1);       // 0.25 itself
  EXPECT_NEAR(stored("--view neutral"), 126, 0.1);   // of 0.25 - 0.04
  EXPECT_NEAR(stored("--view agx"), 143, 0.1);       // of three.js' 0.27483
  EXPECT_NEAR(stored("--exposure auto"), 118, 0.1);  // of 0.18
  for (const char* name : {"out.exr", "out.hdr"}) {
    const ProgramResult light = render("cloth.obj", "--exposure 1 " + middle + at(name));
    EXPECT_THAT(light.output, HasSubstr("--exposure"));
    EXPECT_NEAR(io::read_image(folder / name).at(8, 8, 1), 0.25, 1e-3);
  }
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
       {"--rotate 1,2", "--rotate a,b,c", "--rotate inf,0,0", "--background '#12'", "--tangents sideways",
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
