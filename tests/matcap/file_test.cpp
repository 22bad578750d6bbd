// SPDX-License-Identifier: MIT
#include "sateen/io/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sateen/core/error.h"
#include "sateen/io/ktx2.h"
#include "sateen/matcap/decomposition_file.h"
#include "support/matcaps.h"

namespace sateen::matcap {
namespace {

using testing::HasSubstr;

MatcapDecomposition small() {
  MatcapDecomposition matcap =
      decompose(test::example_matcap("jade", 64), inscribed_disc(64, 64), {}, "jade");
  matcap.provenance = {{"source", "jade.exr"}};
  return matcap;
}

std::string message(const std::filesystem::path& path) {
  try {
    read_matcap(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(MatcapFile, KeepsParametersAndMapsToHalfPrecision) {
  const test::TemporaryFolder folder;
  const MatcapDecomposition before = small();
  write_matcap(folder / "jade.ktx2", before);
  const MatcapDecomposition after = read_matcap(folder / "jade.ktx2");
  EXPECT_EQ(after.width, 64);
  EXPECT_EQ(after.disc.radius, 32);
  EXPECT_EQ(after.provenance, before.provenance);
  for (const Part part : kParts) {
    EXPECT_EQ(after[part].variance, before[part].variance);
    EXPECT_EQ(after[part].measured, before[part].measured);
    EXPECT_EQ(after[part].base_color, before[part].base_color);
    EXPECT_EQ(after[part].map.variances, before[part].map.variances);
    ASSERT_EQ(after[part].map.levels.size(), before[part].map.levels.size());
    for (std::size_t level = 0; level < after[part].map.levels.size(); ++level) {
      const auto& a = after[part].map.levels[level].back.data;
      const auto& b = before[part].map.levels[level].back.data;
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1e-6F + 6e-4F * std::abs(b[i]));
    }
  }
}

TEST(MatcapFile, IsAnArrayOfFourMapsWithRowZeroBelow) {
  const test::TemporaryFolder folder;
  MatcapDecomposition matcap = small();
  matcap[Part::high].map.levels[0].back.set_rgb(3, 63, {0.25F, 0.5F, 0.75F});  // the lowest row
  matcap[Part::high].map.levels[0].back.set_rgb(4, 63, {1e6F, 0, 0});
  write_matcap(folder / "jade.ktx2", matcap);
  const io::Ktx2 texture = io::read_ktx2(folder / "jade.ktx2");
  EXPECT_EQ(texture.layers, 4U);
  EXPECT_EQ(texture.width, 64U);
  EXPECT_EQ(texture.metadata.at("sateen.kind"), "matcap-decomposition");
  EXPECT_EQ(texture.metadata.at("KTXorientation"), "ru");
  Half texel[4];
  std::memcpy(texel, texture.levels[0].data() + (3 * 64 * 64 + 3) * sizeof texel, sizeof texel);
  EXPECT_EQ(static_cast<float>(texel[1]), 0.5F);
  EXPECT_EQ(static_cast<float>(texel[3]), 1.0F);
  std::memcpy(texel, texture.levels[0].data() + (3 * 64 * 64 + 4) * sizeof texel, sizeof texel);
  EXPECT_EQ(static_cast<float>(texel[0]), 65504.0F);
}

TEST(MatcapFile, WrongFilesAreNamedWithWhatIsWrong) {
  const test::TemporaryFolder folder;
  const auto path = folder / "jade.ktx2";
  write_matcap(path, small());
  const io::Ktx2 good = io::read_ktx2(path);
  const auto spoilt = [&](const char* key, const std::string& value) {
    io::Ktx2 bad = good;
    bad.metadata[key] = value;
    io::write_ktx2(path, bad);
    return message(path);
  };
  EXPECT_THAT(spoilt("sateen.kind", "amc"), HasSubstr("no decomposed MatCap"));
  EXPECT_THAT(spoilt("sateen.version", "99"), HasSubstr("version"));
  EXPECT_THAT(spoilt("sateen.matcap", "{"), HasSubstr("jade.ktx2"));
  std::string text = good.metadata.at("sateen.matcap");
  EXPECT_THAT(spoilt("sateen.matcap", "{}"), HasSubstr("space"));
  text.replace(text.find("\"width\":64"), 10, "\"width\":-4");
  EXPECT_THAT(spoilt("sateen.matcap", text), HasSubstr("width"));
  io::Ktx2 flat = good;
  flat.layers = 0;
  for (auto& level : flat.levels) level.resize(level.size() / 4);
  io::write_ktx2(path, flat);
  EXPECT_THAT(message(path), HasSubstr("four square layers"));
  auto bytes = io::read_bytes(path);
  bytes.resize(bytes.size() / 2);
  io::write_bytes(path, bytes);
  EXPECT_THAT(message(path), HasSubstr("jade.ktx2"));
}

}  // namespace
}  // namespace sateen::matcap
