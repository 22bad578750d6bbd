// SPDX-License-Identifier: MIT
// Every seed and every input that once broke a reader, read again; and seeds with random damage.
#include <random>

#include <gtest/gtest.h>

#include "readers.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "sateen/io/warnings.h"
#include "support/files.h"

namespace sateen {
namespace {

namespace fs = std::filesystem;

class Replay : public testing::TestWithParam<test::Reader> {
 protected:
  static void SetUpTestSuite() {
    io::set_warning_handler([](const std::string&) {});
    io::set_max_pixels(1 << 22);
  }
  static std::vector<fs::path> seeds() {
    std::vector<fs::path> paths;
    for (const auto& entry :
         fs::directory_iterator(test::source_dir() / "tests/fuzz/corpus" / GetParam().name)) {
      paths.push_back(entry.path());
    }
    std::ranges::sort(paths);
    return paths;
  }
};

TEST_P(Replay, EverySeedIsReadOrRefused) {
  ASSERT_FALSE(seeds().empty());
  for (const fs::path& seed : seeds()) {
    SCOPED_TRACE(seed.string());
    EXPECT_NO_THROW(test::feed(GetParam(), io::read_bytes(seed)));
  }
}

TEST_P(Replay, SeedsWithDamageAreReadOrRefused) {
  std::mt19937 random(5);
  for (const fs::path& seed : seeds()) {
    const std::vector<std::byte> whole = io::read_bytes(seed);
    if (whole.empty()) continue;
    for (int i = 0; i < 8; ++i) {
      std::vector<std::byte> bytes = whole;
      for (int flips = 0; flips <= i; ++flips) bytes[random() % bytes.size()] ^= std::byte(1 << random() % 8);
      if (i % 4 == 3) bytes.resize(random() % bytes.size());
      SCOPED_TRACE(fmt::format("{} {}", seed.string(), i));
      EXPECT_NO_THROW(test::feed(GetParam(), bytes));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Readers, Replay, testing::ValuesIn(test::readers().begin(), test::readers().end()),
                         [](const auto& reader) { return std::string(reader.param.name); });

}  // namespace
}  // namespace sateen
