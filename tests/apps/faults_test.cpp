// SPDX-License-Identifier: MIT
// Every command that writes, on a disk that fills up, killed in the middle, and with other numbers of
// threads: what it wrote before stays whole, nothing half-written is left, and running it again gives the
// same bytes.
#include <cstdlib>
#include <map>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sateen/io/file.h"
#include "support/files.h"

namespace sateen {
namespace {

namespace fs = std::filesystem;
using test::run_program;
using testing::HasSubstr;

struct Command {
  std::string name;
  std::string arguments;  ///< {in}: the folder of inputs, {ex}: the examples, {out}: where outputs go
};

std::ostream& operator<<(std::ostream& out, const Command& command) {
  return out << command.name;
}

using Files = std::map<std::string, std::vector<std::byte>>;

Files files_in(const fs::path& folder) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file())
      files[entry.path().lexically_relative(folder).string()] = io::read_bytes(entry.path());
  }
  return files;
}

/// The files of a folder, those that contain "old" as their names only: what an earlier run left.
class Faults : public testing::TestWithParam<Command> {
 protected:
  static void SetUpTestSuite() {
    inputs_ = std::make_unique<test::TemporaryFolder>();
    const auto make = [](const std::string& arguments) {
      const auto result = run_program(arguments);
      ASSERT_EQ(result.exit_code, 0) << result.output;
    };
    const std::string in = inputs_->path().string();
    const std::string ex = test::examples().string();
    make(fmt::format("amc build {}/silk -o {}/silk.ktx2 --size 24 --slices 8", ex, in));
    make(fmt::format("matcap decompose {}/matcaps/jade.exr -o {}/jade.ktx2 --map-size 64", ex, in));
  }
  static void TearDownTestSuite() { inputs_.reset(); }

  static std::string arguments_for(const fs::path& out) {
    std::string text = GetParam().arguments;
    const auto put = [&](const std::string& word, const std::string& value) {
      for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word)) {
        text.replace(at, word.size(), value);
      }
    };
    put("{in}", inputs_->path().string());
    put("{ex}", test::examples().string());
    put("{out}", out.string());
    return text;
  }

  /// What the command writes when nothing is in its way.
  static const Files& right() {
    static std::map<std::string, Files> known;
    if (const auto found = known.find(GetParam().name); found != known.end()) return found->second;
    const test::TemporaryFolder folder;
    const auto result = run_program(arguments_for(folder.path()));
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return known[GetParam().name] = files_in(folder.path());
  }

  /// Puts an older file in place of each that the command writes.
  static void put_older(const fs::path& folder) {
    for (const auto& [name, bytes] : right()) {
      io::make_folder((folder / name).parent_path());
      io::write_text(folder / name, "older " + name);
    }
  }

  /// Every file is the older one or the right one, and no other is there.
  static void expect_whole(const fs::path& folder, bool leftovers_allowed, const std::string& when) {
    for (const auto& [name, bytes] : files_in(folder)) {
      if (leftovers_allowed && name.find(".sateen-") != std::string::npos) continue;
      // The page of a batch says what failed.
      if (name == "all/index.html" || name.ends_with(".txt")) continue;
      const auto found = right().find(name);
      ASSERT_NE(found, right().end()) << when << ": " << name << " is left";
      const std::string older = "older " + name;
      const auto old_bytes = std::as_bytes(std::span(older));
      EXPECT_TRUE(bytes == found->second || std::ranges::equal(bytes, old_bytes)) << when << ": " << name;
    }
  }

  static std::unique_ptr<test::TemporaryFolder> inputs_;
};

std::unique_ptr<test::TemporaryFolder> Faults::inputs_;

TEST_P(Faults, EqualRunsGiveEqualBytesForAnyNumberOfThreads) {
  for (const char* threads : {"1", "2", "64"}) {
    const test::TemporaryFolder folder;
    const auto result = run_program(arguments_for(folder.path()) + " --threads " + threads);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    const Files files = files_in(folder.path());
    ASSERT_EQ(files.size(), right().size());
    for (const auto& [name, bytes] : right())
      EXPECT_TRUE(files.at(name) == bytes) << name << " with " << threads;
  }
}

TEST_P(Faults, AFullDiskAtAnyTenthLeavesOlderFilesWhole) {
  std::size_t largest = 0;
  for (const auto& [name, bytes] : right()) largest = std::max(largest, bytes.size());
  for (int tenth = 0; tenth < 10; ++tenth) {
    const test::TemporaryFolder folder;
    put_older(folder.path());
    // In units of 512 bytes; writing beyond fails as it does on a full disk.
    const std::string limit =
        fmt::format("trap '' XFSZ; ulimit -f {};", largest * static_cast<std::size_t>(tenth) / 10 / 512);
    const auto result = run_program(arguments_for(folder.path()), limit);
    expect_whole(folder.path(), false, fmt::format("{} of 10: {}", tenth, result.output));
    if (largest > 5120) {
      EXPECT_EQ(result.exit_code, 1) << tenth << result.output;
    }
    EXPECT_EQ(result.output.find("unexpected"), std::string::npos) << result.output;
  }
}

TEST_P(Faults, BeingKilledLeavesOlderFilesWholeAndTheNextRunIsRight) {
  const char* wanted = std::getenv("SATEEN_KILLS");
  const int kills = wanted != nullptr ? std::atoi(wanted) : 4;
  const test::TemporaryFolder timing;
  const auto start = std::chrono::steady_clock::now();
  run_program(arguments_for(timing.path()));
  const std::chrono::duration<double> length = std::chrono::steady_clock::now() - start;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> moment(0.2, 1.05);
  for (int i = 0; i < kills; ++i) {
    const test::TemporaryFolder folder;
    put_older(folder.path());
    const char* signal = i % 4 == 0 ? "TERM" : "KILL";
    const double seconds = moment(random) * length.count();
    run_program(arguments_for(folder.path()), fmt::format("timeout -s {} {:.4f}", signal, seconds));
    expect_whole(folder.path(), true, fmt::format("{} after {} s", signal, seconds));
    if (i % 4 == 0) expect_whole(folder.path(), false, "TERM");
    const auto again = run_program(arguments_for(folder.path()));
    EXPECT_EQ(again.exit_code, 0) << again.output;
    EXPECT_TRUE(files_in(folder.path()) == right()) << signal << " after " << seconds << " s";
  }
}

TEST_P(Faults, ReadOnlyFilesAreRefusedBeforeTheWork) {
  for (const auto& [name, bytes] : right()) {
    const test::TemporaryFolder folder;
    put_older(folder.path());
    fs::permissions(folder / name, fs::perms(0444));
    const auto result = run_program(arguments_for(folder.path()));
    if (result.exit_code == 0) {  // folders are replaced whole, whatever they hold
      EXPECT_TRUE(GetParam().name == "amc_convert_folder") << name;
      continue;
    }
    EXPECT_THAT(result.output, HasSubstr("read-only"));
    expect_whole(folder.path(), false, name);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Commands, Faults,
    testing::Values(
        Command{"amc_build", "amc build {ex}/silk -o {out}/a.ktx2 --size 32 --slices 8"},
        Command{"amc_convert_folder", "amc convert {in}/silk.ktx2 -o {out}/slices"},
        Command{"amc_isotropic", "amc isotropic {in}/silk.ktx2 -o {out}/a.exr"},
        Command{"capture_build",
                "capture build {ex}/capture -o {out}/a.ktx2 --report {out}/report --size 16 --slices 8 "
                "--focal-mm 70 "
                "--sensor-mm 36 --first-angle 0"},
        Command{"matcap_decompose", "matcap decompose {ex}/matcaps/jade.exr -o {out}/a.ktx2 --map-size 64"},
        Command{"matcap_separate",
                "matcap separate {ex}/matcaps/jade.exr --low {out}/l.exr --high {out}/h.png"},
        Command{"matcap_estimate", "matcap estimate {ex}/matcaps/jade.exr --plot {out}/a.svg"},
        Command{"matcap_bake", "matcap bake {in}/jade.ktx2 --size 256 -o {out}/a.tif"},
        Command{"matcap_batch",
                "matcap decompose {ex}/matcaps/jade.exr {ex}/matcaps/lead.exr -o {out}/all --map-size 32"},
        Command{"brdf_plot", "brdf plot ggx --params {ex}/brdf/ggx.json -o {out}/a.svg"},
        Command{"maps_author",
                "maps aniso author --roughness-u {ex}/textures/weave_normal.png:r --roughness-v 0.3 -o "
                "{out}/a.png"},
        Command{"maps_filter", "maps aniso filter --normals {ex}/textures/weave_normal.png -o {out}/a.png"},
        Command{"maps_filter_ktx2",
                "maps aniso filter --normals {ex}/textures/weave_normal.png -o {out}/a.ktx2"},
        Command{"render",
                "render {ex}/garment/jacket.obj -m {in}/silk.ktx2 --size 200 -o {out}/a.png --aov normal"},
        Command{"render_film",
                "render {ex}/garment/jacket.obj -m {in}/silk.ktx2 --size 64 --turntable 6 -o {out}/a.mp4"},
        Command{"render_turntable",
                "render {ex}/garment/jacket.obj -m {in}/silk.ktx2 --size 64 --turntable 3 -o {out}/turn"}),
    [](const auto& command) { return command.param.name; });

}  // namespace
}  // namespace sateen
