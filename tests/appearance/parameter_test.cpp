// SPDX-License-Identifier: MIT
// Parameters are said once: what JSON takes, what get and set know, what the documentation prints.
#include "sateen/appearance/parameter.h"

#include <gmock/gmock.h>

#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/scene/registry.h"
#include "support/files.h"

namespace sateen::appearance {
namespace {

using testing::HasSubstr;

std::string message(const auto& body) {
  try {
    body();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Parameter, RangesAreOpenOrClosedAndSaidInWords) {
  const Parameter half_open{.name = "alpha", .low_open = true, .standard = 0.3};
  EXPECT_FALSE(allows(half_open, 0.0));
  EXPECT_TRUE(allows(half_open, 1.0));
  EXPECT_FALSE(allows(half_open, std::nan("")));
  EXPECT_FALSE(allows(half_open, true));
  EXPECT_EQ(expectation(half_open), "a number in (0, 1]");
  const Parameter whole{.name = "n", .kind = Parameter::Kind::integer, .high = 64};
  EXPECT_FALSE(allows(whole, 1.5));
  const Parameter color{.name = "color", .kind = Parameter::Kind::color};
  EXPECT_TRUE(allows(color, Vec3(0, 0.5, 1)));
  EXPECT_FALSE(allows(color, Vec3(0, 0.5, 1.01)));
  const Parameter word{.name = "phase", .kind = Parameter::Kind::choice, .choices = {"a", "b"}};
  EXPECT_TRUE(allows(word, std::string("b")));
  EXPECT_FALSE(allows(word, std::string("c")));
  EXPECT_THAT(message([&] { check(word, std::string("c")); }),
              testing::AllOf(HasSubstr("\"phase\""), HasSubstr("one of a, b"), HasSubstr("found c")));
}

TEST(Parameter, EveryExampleGivesBackWhatItIsGiven) {
  for (const auto& entry : std::filesystem::directory_iterator(test::examples() / "materials")) {
    if (entry.path().extension() != ".json") continue;
    const auto appearance = scene::load_appearance(entry.path());
    EXPECT_FALSE(appearance->parameters().empty()) << entry.path();
    for (const Parameter& parameter : appearance->parameters()) {
      EXPECT_TRUE(allows(parameter, parameter.standard)) << parameter.name;
      EXPECT_FALSE(parameter.help.empty()) << parameter.name;
      const ParameterValue value = appearance->get(parameter.name);
      const std::uint64_t before = appearance->revision();
      appearance->set(parameter.name, value);
      EXPECT_EQ(appearance->get(parameter.name), value) << parameter.name;
      appearance->settle(true);
      EXPECT_GT(appearance->revision(), before) << parameter.name;
    }
    EXPECT_THAT(message([&] { appearance->set("fuz.density", 1.0); }),
                testing::AllOf(HasSubstr("fuz.density"), HasSubstr("base.color")));
  }
}

TEST(Parameter, SettingOneIsWritingItInTheFile) {
  const test::TemporaryFolder folder;
  const std::string start = R"({"model": "layered", "fuzz": {"density": 0.2, "tilt": 20},
                                "specular": {"alpha_t": 0.4, "alpha_b": 0.2}})";
  io::write_text(folder / "start.json", start);
  io::write_text(folder / "end.json",
                 R"({"model": "layered", "base": {"model": "fibre-diffuse", "color": [0.1, 0.2, 0.3]},
      "fuzz": {"density": 0.6, "tilt": 45, "azimuth": 30, "phase": "schlick"},
      "specular": {"alpha_t": 0.1, "alpha_b": 0.5, "energy_compensation": true}})");
  const auto set = scene::load_appearance(folder / "start.json");
  const auto read = scene::load_appearance(folder / "end.json");
  for (const Parameter& parameter : read->parameters()) set->set(parameter.name, read->get(parameter.name));
  set->settle(true);
  light::Lighting lighting;
  lighting.lamps.resize(1);
  lighting.lamps[0].direction = Vec3(0.4, 0.1, 0.8).normalized();
  lighting.surroundings = light::make_surroundings(Image(64, 32, 3, 0.7f));
  for (int i = 0; i < 10; ++i) {
    Surface surface;
    surface.view = Vec3(0.6 * std::cos(i), 0.6 * std::sin(i), 0.8);
    EXPECT_LT((set->radiance(surface, lighting) - read->radiance(surface, lighting)).norm(), 1e-12);
  }
  EXPECT_EQ(set->shader(), read->shader());
}

TEST(Parameter, OldSpellingsAreReadAndUnknownKeysRefusedWithTheListOfThatPlace) {
  const test::TemporaryFolder folder;
  const auto load = [&](const std::string& text) {
    io::write_text(folder / "m.json", text);
    return scene::load_appearance(folder / "m.json");
  };
  EXPECT_EQ(std::get<Vec3>(load(R"({"model": "constant", "colour": [1, 2, 3]})")->get("color")),
            Vec3(1, 2, 3));
  EXPECT_EQ(std::get<Vec3>(load(R"({"model": "layered", "base": {"colour": 0.25}})")->get("base.color")),
            Vec3(0.25, 0.25, 0.25));
  EXPECT_THAT(message([&] { load(R"({"model": "constant", "color": 1, "tint": 2})"); }),
              testing::AllOf(HasSubstr("\"tint\""), HasSubstr("color, model, name")));
  EXPECT_THAT(message([&] { load(R"({"model": "layered", "fuzz": {"densty": 2}})"); }),
              testing::AllOf(HasSubstr("m.json, fuzz"), HasSubstr("\"densty\""), HasSubstr("density"),
                             testing::Not(HasSubstr("specular"))));
}

TEST(Parameter, TheDocumentationsTablesAreTheParameters) {
  const std::string page = io::read_text(std::filesystem::path(SATEEN_SOURCE_DIR) / "docs" / "materials.md");
  for (const char* name : {"velvet.json", "mapped-weave.json"}) {
    const auto appearance = scene::load_appearance(test::examples() / "materials" / name);
    EXPECT_THAT(page, HasSubstr(markdown(appearance->parameters())))
        << "put the output of \"sateen brdf parameters examples/materials/" << name << "\" there";
  }
}

}  // namespace
}  // namespace sateen::appearance
