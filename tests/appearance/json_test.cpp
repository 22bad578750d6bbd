// SPDX-License-Identifier: MIT
// What a user's JSON says is taken as written, or refused with file, key and what would be right.
#include "sateen/io/json.h"

#include <gmock/gmock.h>

#include "sateen/appearance/json_reader.h"
#include "sateen/appearance/lighting_keys.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "sateen/light/environment.h"
#include "support/files.h"

namespace sateen::appearance {
namespace {

using light::PunctualLight;
using testing::HasSubstr;

std::string complaint(const auto& body) {
  try {
    body();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

LightingKeys lighting_keys(const std::string& text, const std::filesystem::path& file = "m.json") {
  const nlohmann::json value = nlohmann::json::parse(text);
  JsonObject json(value, file.string());
  LightingKeys keys = read_lighting_keys(json, file);
  json.finish();
  return keys;
}

TEST(Json, NumbersPairsColoursAndDirectionsAreTakenAsWritten) {
  const nlohmann::json value = nlohmann::json::parse(
      R"({"half": 0.5, "none": 0, "pair": [0.25, 0.75], "even": 0.5, "color": [0, 0.5, 1], "up": [0, 30, 40]})");
  JsonObject json(value, "m.json");
  EXPECT_EQ(json.number("half", 0, {0, 1}), 0.5);
  EXPECT_EQ(json.number("none", 1, {0, 1}), 0);
  EXPECT_EQ(json.pair("pair", {0, 0}, {0, 1}), Vec2(0.25, 0.75));
  EXPECT_EQ(json.pair("even", {0, 0}, {0, 1}), Vec2(0.5, 0.5));
  EXPECT_EQ(json.color("color", {0, 0, 0}), Vec3(0, 0.5, 1));
  EXPECT_LT((json.direction("up") - Vec3(0, 0.6, 0.8)).norm(), 1e-12);
  json.finish();
  EXPECT_THAT(complaint([&] { json.number("none", 1, {0, 1, true}); }), HasSubstr("(0, 1]"));
  EXPECT_THAT(complaint([&] { json.number("half", 1, {0, 0.5, false, true}); }), HasSubstr("[0, 0.5)"));
  EXPECT_THAT(complaint([&] { json.pair("pair", {0, 0}, {0, 0.5}); }), HasSubstr("[0, 0.5]"));
  EXPECT_THAT(complaint([&] { json.color("color", {0, 0, 0}, 0.5); }), HasSubstr("each in [0, 0.5]"));
}

TEST(Json, BrokenFilesAreNamedWithTheLineAndDeepOnesRefused) {
  const test::TemporaryFolder folder;
  const auto read = [&](const std::string& text) {
    io::write_text(folder / "m.json", text);
    return complaint([&] { io::read_json(folder / "m.json"); });
  };
  EXPECT_THAT(read("{\n\"a\": 1,\n\"b\": ?\n}"), HasSubstr("line 3 "));
  EXPECT_THAT(read("{\n\"a\": \"open\n}"), HasSubstr("line 2 "));
  EXPECT_EQ(read(std::string(64, '[') + std::string(64, ']')), "");
  EXPECT_THAT(read(std::string(65, '[') + std::string(65, ']')), HasSubstr("nested"));
}

TEST(Json, LampsHaveTheKindPlaceAndConesTheyAreGiven) {
  const LightingKeys keys = lighting_keys(R"({"lights": [
      {"direction": [0, 0, 5], "color": [1, 2, 3]},
      {"kind": "point", "position": [1, 2, 3]},
      {"kind": "spot", "position": [4, 5, 6], "direction": [0, -2, 0], "inner_cone": 15, "outer_cone": 30}]})");
  ASSERT_TRUE(keys.lamps);
  ASSERT_EQ(keys.lamps->size(), 3U);
  const PunctualLight& sun = (*keys.lamps)[0];
  EXPECT_EQ(sun.kind, PunctualLight::Kind::directional);
  EXPECT_EQ(sun.direction, Vec3(0, 0, 1));
  EXPECT_EQ(sun.colour, Vec3(1, 2, 3));
  EXPECT_EQ((*keys.lamps)[1].kind, PunctualLight::Kind::point);
  EXPECT_EQ((*keys.lamps)[1].position, Vec3(1, 2, 3));
  const PunctualLight& spot = (*keys.lamps)[2];
  EXPECT_EQ(spot.kind, PunctualLight::Kind::spot);
  EXPECT_EQ(spot.direction, Vec3(0, -1, 0));
  EXPECT_NEAR(spot.inner_cone, kPi / 12, 1e-12);
  EXPECT_NEAR(spot.outer_cone, kPi / 6, 1e-12);
}

TEST(Json, LampsThatCannotBeAreRefused) {
  const auto refused = [](const std::string& lights) {
    return complaint([&] { lighting_keys("{\"lights\": " + lights + "}"); });
  };
  const std::string spot = R"([{"kind": "spot", "position": [0, 0, 1], "direction": [0, 0, -1], )";
  EXPECT_THAT(refused(spot + R"("inner_cone": 40, "outer_cone": 30}])"), HasSubstr("\"inner_cone\""));
  EXPECT_THAT(refused(spot + R"("inner_cone": 30, "outer_cone": 30}])"), HasSubstr("\"inner_cone\""));
  EXPECT_THAT(refused(spot + R"("outer_cone": 0}])"), HasSubstr("\"outer_cone\""));
  EXPECT_THAT(refused(R"([{"direction": [0, 0, 0]}])"), HasSubstr("\"direction\""));
  std::string many = R"({"direction": [0, 0, 1]})";
  for (std::size_t i = 1; i < light::kMaximumLamps; ++i) many += R"(, {"direction": [0, 0, 1]})";
  EXPECT_EQ(refused("[" + many + "]"), "");
  EXPECT_THAT(refused("[" + many + R"(, {"direction": [0, 0, 1]}])"), HasSubstr("at most 8 lights"));
}

TEST(Json, SurroundingsAreEvenOrAPictureBesideTheFile) {
  const light::Lighting even = make_lighting(lighting_keys(R"({"ambient": [0.5, 1, 2]})"));
  // Irradiance of light that is the same all around is pi times it.
  EXPECT_LT((even.surroundings.harmonics.irradiance(Vec3::UnitZ()) - kPi * Vec3(0.5, 1, 2)).norm(), 1e-9);
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "materials");
  io::write_image(folder / "materials" / "sky.exr", Image(16, 8, 3, 0.5f));
  const light::Lighting sky =
      make_lighting(lighting_keys(R"({"environment": "sky.exr"})", folder / "materials" / "m.json"));
  EXPECT_LT((sky.surroundings.radiance(Vec3::UnitX(), 0) - Vec3(0.5, 0.5, 0.5)).norm(), 1e-3);
  EXPECT_THAT(complaint([] { lighting_keys(R"({"ambient": 1, "environment": "sky.exr"})"); }),
              HasSubstr("left out"));
}

}  // namespace
}  // namespace sateen::appearance
