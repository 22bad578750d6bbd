// SPDX-License-Identifier: MIT
#include "sateen/scene/registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "support/files.h"

namespace sateen::scene {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string message(const std::filesystem::path& path) {
  try {
    load_appearance(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Registry, APictureIsAMatCapAndJsonNamesItsModel) {
  const test::TemporaryFolder folder;
  io::write_image(folder / "clay.exr", Image(8, 8, 3, 0.25f));
  EXPECT_NEAR(load_appearance(folder / "clay.exr")->radiance({}, {}).y(), 0.25, 1e-4);
  io::write_text(folder / "red.json", R"({"model": "constant", "colour": [1, 0.5, 0]})");
  const auto red = load_appearance(folder / "red.json");
  EXPECT_TRUE(red->radiance({}, {}).isApprox(Vec3(1, 0.5, 0)));
  EXPECT_THROW(red->set("color", Vec3(-1, 0, 0)), Error);
  EXPECT_TRUE(red->radiance({}, {}).isApprox(Vec3(1, 0.5, 0)));
}

TEST(Registry, WrongMaterialsAreNamedWithWhatWouldBeRight) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(message(folder / "none.png"), AllOf(HasSubstr("none.png"), HasSubstr("no such file")));
  io::write_text(folder / "notes.txt", "hello");
  EXPECT_THAT(message(folder / "notes.txt"), AllOf(HasSubstr("notes.txt"), HasSubstr(".ktx2")));
  io::write_text(folder / "broken.json", "{");
  EXPECT_THAT(message(folder / "broken.json"), AllOf(HasSubstr("broken.json"), HasSubstr("JSON")));
  io::write_text(folder / "odd.json", R"({"model": "plaid"})");
  EXPECT_THAT(message(folder / "odd.json"), AllOf(HasSubstr("plaid"), HasSubstr("constant")));
  io::write_text(folder / "colour.json", R"({"model": "constant", "colour": ["red", 0, 0]})");
  EXPECT_THAT(message(folder / "colour.json"), AllOf(HasSubstr("colour.json"), HasSubstr("colour")));
  io::write_image(folder / "wide.png", Image(8, 4, 3));
  EXPECT_THAT(message(folder / "wide.png"), AllOf(HasSubstr("wide.png"), HasSubstr("8 x 4")));
}

}  // namespace
}  // namespace sateen::scene
