// SPDX-License-Identifier: MIT
#include "sateen/matcap/batch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/matcap/contact_sheet.h"
#include "sateen/matcap/decomposition_file.h"
#include "support/matcaps.h"

namespace sateen::matcap {
namespace {

using testing::HasSubstr;

TEST(Batch, GoesOnWhereItStoppedAndSurvivesBadInputs) {
  const test::TemporaryFolder folder;
  const auto jade = folder / "jade <1>.exr";
  const auto lead = folder / "lead.exr";
  const auto broken = folder / "broken.png";
  io::write_image(jade, test::example_matcap("jade", 48));
  io::write_image(lead, test::example_matcap("lead", 48));
  io::write_text(broken, "no picture");
  const std::vector<std::filesystem::path> inputs{broken, jade, lead};
  const auto output = folder / "out";
  auto entries = decompose_files(inputs, output, {}, false);
  ASSERT_EQ(entries.size(), 3U);
  EXPECT_THAT(entries[0].failure, HasSubstr("broken.png"));
  EXPECT_FALSE(entries[1].reused);
  EXPECT_TRUE(entries[1].failure.empty() && entries[2].failure.empty());
  EXPECT_FALSE(std::filesystem::exists(output / "broken.ktx2"));

  std::filesystem::remove(output / "lead.ktx2");
  entries = decompose_files(inputs, output, {}, false);
  EXPECT_TRUE(entries[1].reused);
  EXPECT_FALSE(entries[2].reused);
  DecomposeFileOptions other;
  other.decompose.space = AddUpSpace::linear;
  EXPECT_FALSE(decompose_files(inputs, output, other, false)[1].reused);
  EXPECT_FALSE(decompose_files(inputs, output, other, true)[1].reused);
  io::write_image(jade, test::example_matcap("jade", 40));
  EXPECT_FALSE(decompose_files(inputs, output, other, false)[1].reused);

  write_contact_sheet(output, entries);
  const std::string html = io::read_text(output / "index.html");
  EXPECT_THAT(html, HasSubstr("jade &lt;1&gt;"));
  EXPECT_THAT(html, HasSubstr("sheet/jade%20%3C1%3E.png"));
  EXPECT_THAT(html, HasSubstr("class=\"failed\""));
  EXPECT_EQ(io::read_image(output / "sheet" / "lead.png").width, 1280);
}

TEST(Batch, EqualNamesAreRefused) {
  const test::TemporaryFolder folder;
  const std::vector<std::filesystem::path> inputs{"a/gold.png", "b/gold.exr"};
  EXPECT_THROW(decompose_files(inputs, folder / "out", {}, false), Error);
}

}  // namespace
}  // namespace sateen::matcap
