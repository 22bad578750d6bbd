// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(Program, AFullStandardOutputIsAFailure) {
  EXPECT_EQ(run_program("amc symmetry " + (test::examples() / "silk").string() + " --size 16 > /dev/full")
                .exit_code,
            1);
}

}  // namespace
}  // namespace sateen
