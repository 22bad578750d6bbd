// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sateen/io/file.h"
#include "support/files.h"

namespace sateen {
namespace {

using test::run_program;
using testing::HasSubstr;

TEST(Program, HelpExitsWithZeroAndEndsWithAnExample) {
  EXPECT_EQ(run_program("--help").exit_code, 0);
  const auto help = run_program("amc build --help");
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.output, HasSubstr("Example:"));
  EXPECT_THAT(help.output, HasSubstr("--threads")) << "options every command takes are listed too";
}

TEST(Program, AWrongCommandLineExitsWithTwoAndSuggestsTheNearestWord) {
  EXPECT_EQ(run_program("").exit_code, 2);
  const auto option = run_program("amc build x --siz 3");
  EXPECT_EQ(option.exit_code, 2);
  EXPECT_THAT(option.output, HasSubstr("Did you mean --size?"));
  const auto verb = run_program("amc biuld x");
  EXPECT_EQ(verb.exit_code, 2);
  EXPECT_THAT(verb.output, HasSubstr("Did you mean build?"));
  EXPECT_EQ(run_program("amc build x -o y.ktx2 --direction up").exit_code, 2);
}

TEST(Program, AWrongInputExitsWithOneAndNamesIt) {
  const auto result = run_program("amc info nowhere.ktx2");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output, HasSubstr("nowhere.ktx2"));
}

TEST(Program, WhatAnAbsentModuleWouldReadIsSaidWithWhatIsMissing) {
  // The program alone in a folder, where its modules are not.
  const test::TemporaryFolder folder;
  std::filesystem::copy_file(SATEEN_PROGRAM, folder / "sateen");
  io::write_text(folder / "film.mp4", "no film, but nobody comes to look");
  const std::string command = (folder / "sateen").string() + " capture build " +
                              (folder / "film.mp4").string() + " -o " + (folder / "x.ktx2").string() +
                              " --fov 40 --angles equal 2>&1 #";
  const auto result = run_program("", command);
  EXPECT_EQ(result.exit_code, 1) << result.output;
  EXPECT_THAT(result.output, testing::AllOf(HasSubstr("sateen-video.so"), HasSubstr("not installed")));
}

TEST(Program, AFullStandardOutputIsAFailure) {
  EXPECT_EQ(run_program("amc symmetry " + (test::examples() / "silk").string() + " --size 16 > /dev/full")
                .exit_code,
            1);
}

}  // namespace
}  // namespace sateen
