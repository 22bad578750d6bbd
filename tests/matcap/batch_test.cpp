// SPDX-License-Identifier: MIT
#include "sateen/matcap/batch.h"

#include <chrono>
#include <map>
#include <thread>

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

TEST(Batch, LooksAtTheDataNotAtNameAndSize) {
  const test::TemporaryFolder folder;
  const std::vector<std::filesystem::path> inputs{folder / "a.tif"};
  constexpr std::uintmax_t size = 40000;  // of both; what follows the picture is ignored
  io::write_image(inputs[0], test::example_matcap("jade", 48));
  std::filesystem::resize_file(inputs[0], size);
  const auto output = folder / "out";
  const auto reused = [&] { return decompose_files(inputs, output, {}, false)[0].reused; };
  EXPECT_FALSE(reused());
  EXPECT_TRUE(reused());
  io::write_image(inputs[0], test::example_matcap("lead", 48));  // repainted
  std::filesystem::resize_file(inputs[0], size);
  EXPECT_FALSE(reused());
  EXPECT_TRUE(reused());
  std::vector<std::byte> bytes = io::read_bytes(output / "a.ktx2");
  bytes[bytes.size() / 2] ^= std::byte{1};
  io::write_bytes(output / "a.ktx2", bytes);
  EXPECT_FALSE(reused());
  bytes = io::read_bytes(output / "a.ktx2");
  bytes.resize(bytes.size() - 1);
  io::write_bytes(output / "a.ktx2", bytes);
  EXPECT_FALSE(reused());
}

std::map<std::string, std::vector<std::byte>> files_in(const std::filesystem::path& folder) {
  std::map<std::string, std::vector<std::byte>> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file())
      files[entry.path().lexically_relative(folder).string()] = io::read_bytes(entry.path());
  }
  return files;
}

/// Five good MatCaps between files that fail in ways of their own; a name that is no UTF-8 is among the good.
std::filesystem::path mixed_inputs(const test::TemporaryFolder& folder) {
  const auto in = folder / "in";
  std::filesystem::create_directory(in);
  for (const char* name : test::kMatcaps)
    io::write_image(in / (std::string(name) + ".png"), test::example_matcap(name, 32));
  std::filesystem::rename(in / "lead.png", in / "le\xe4"
                                                "d.png");
  io::write_text(in / "a.png", std::string("GIF89a\x01\0\x01\0\0\0\0;", 14));
  io::write_text(in / "k.png", "");
  io::write_text(in / "z.png", "\x89PNG\r\n\x1a\n");
  return in;
}

TEST(Batch, BadFilesLeaveTheOthersAsIfTheyWereAlone) {
  const test::TemporaryFolder folder;
  const auto in = mixed_inputs(folder);
  const auto run = [&](const std::string& name, const std::string& options) {
    const auto result = test::run_program(
        fmt::format("matcap decompose {} -o {} {}", in.string(), (folder / name).string(), options));
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.output, HasSubstr("3 of 8"));
    return files_in(folder / name);
  };
  const auto one = run("one", "--threads 1");
  EXPECT_EQ(one.size(), 5U + 8U + 1U);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(run("two", "--threads 4 --anew"), one);
}

TEST(Batch, ShardsInTwoProcessesAtOnceGiveWhatOneRunGives) {
  const test::TemporaryFolder folder;
  const auto in = mixed_inputs(folder);
  const auto command = [&](const std::string& name, const std::string& options) {
    return fmt::format("matcap decompose {} -o {} {}", in.string(), (folder / name).string(), options);
  };
  EXPECT_EQ(test::run_program(command("one", "")).exit_code, 1);
  const std::string beside = fmt::format("{} {} > {} 2>&1 &", SATEEN_PROGRAM, command("two", "--shard 2/2"),
                                         (folder / "log").string());
  test::run_program(command("two", "--shard 1/2"), beside);
  const auto done = [&] { return io::read_text(folder / "log").find("could not be") != std::string::npos; };
  for (int i = 0; i < 600 && !done(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(files_in(folder / "two"), files_in(folder / "one"));
  for (const char* wrong : {"0/2", "3/2", "1", "1/x", "-1/2", "1/0"}) {
    EXPECT_EQ(test::run_program(command("x", std::string("--shard=") + wrong)).exit_code, 2) << wrong;
  }
}

TEST(Batch, EqualNamesAreRefused) {
  const test::TemporaryFolder folder;
  const std::vector<std::filesystem::path> inputs{"a/gold.png", "b/gold.exr"};
  EXPECT_THROW(decompose_files(inputs, folder / "out", {}, false), Error);
}

}  // namespace
}  // namespace sateen::matcap
