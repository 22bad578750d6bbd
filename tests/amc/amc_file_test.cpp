// SPDX-License-Identifier: MIT
#include "sateen/amc/amc_file.h"

#include <cstring>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/ktx2.h"
#include "support/analytic_material.h"
#include "support/files.h"

namespace sateen::amc {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

AmcTable sample(AmcEncoding encoding) {
  AmcTable table = test::analytic_table(13, 7, 3);
  table.encoding = encoding;
  table.isotropic = true;
  table.provenance = {{"cloth", "soie changeante, \xC3\xA9toile"}, {"frames", "21"}};
  quantise(table);
  return table;
}

void expect_equal(const AmcTable& a, const AmcTable& b) {
  EXPECT_EQ(a.size, b.size);
  EXPECT_EQ(a.slices, b.slices);
  EXPECT_EQ(a.symmetry, b.symmetry);
  EXPECT_EQ(a.isotropic, b.isotropic);
  EXPECT_EQ(a.encoding, b.encoding);
  EXPECT_EQ(a.provenance, b.provenance);
  EXPECT_EQ(a.texels, b.texels);
}

TEST(AmcFile, Ktx2AndFoldersReadBackBitForBit) {
  const test::TemporaryFolder folder;
  for (const AmcEncoding encoding : {AmcEncoding::srgb8, AmcEncoding::half}) {
    const AmcTable table = sample(encoding);
    for (const char* name : {"t\xC3\xA4"
                             "ble.ktx2",
                             "slices_a", "slices_b"}) {
      write_amc(folder / name, table);
      expect_equal(read_amc(folder / name), table);
    }
    std::filesystem::remove_all(folder / "slices_a");
    std::filesystem::remove_all(folder / "slices_b");
  }
}

TEST(AmcFile, TheSameTableGivesTheSameBytes) {
  const test::TemporaryFolder folder;
  write_amc(folder / "a.ktx2", sample(AmcEncoding::half));
  write_amc(folder / "b.ktx2", sample(AmcEncoding::half));
  EXPECT_EQ(io::read_bytes(folder / "a.ktx2"), io::read_bytes(folder / "b.ktx2"));
}

TEST(AmcFile, RefusesWhatIsNoAmc) {
  const test::TemporaryFolder folder;
  const auto path = folder / "x.ktx2";
  write_amc(path, sample(AmcEncoding::half));
  const io::Ktx2 good = io::read_ktx2(path);
  const auto refused = [&](auto change, const std::string& message) {
    io::Ktx2 bad = good;
    change(bad);
    io::write_ktx2(path, bad);
    EXPECT_THAT([&] { read_amc(path); }, ThrowsMessage<Error>(HasSubstr(message)));
  };
  refused([](io::Ktx2& t) { t.metadata.erase("sateen.kind"); }, "no Anisotropic MatCap");
  refused([](io::Ktx2& t) { t.metadata["sateen.version"] = "99"; }, "version 99");
  refused([](io::Ktx2& t) { t.metadata["sateen.symmetry"] = "two"; }, "'two'");
  refused([](io::Ktx2& t) { t.metadata["sateen.symmetry"] = "0"; }, "symmetry");
  refused(
      [](io::Ktx2& t) {
        const Half nan = std::numeric_limits<Half>::quiet_NaN();
        std::memcpy(t.levels[0].data() + 8, &nan, sizeof nan);
      },
      "texel (1, 0, 0) is not finite");
  EXPECT_THROW(read_amc(folder / "missing.ktx2"), Error);
  EXPECT_THROW(read_amc(folder.path()), Error);
  EXPECT_THROW(write_amc(folder / "x.png", sample(AmcEncoding::half)), Error);
}

}  // namespace
}  // namespace sateen::amc
