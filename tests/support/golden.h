// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "sateen/io/image.h"
#include "support/files.h"

namespace sateen::test {

/// How far a picture may be from its golden one; values of the 8-bit file, 0 to 255.
struct GoldenTolerance {
  int largest = 40;             ///< no channel may differ by more
  int visible = 3;              ///< a pixel with a channel further off than this fails ...
  double failing_share = 0.01;  ///< ... and no larger share of all pixels may
};

/// Compares with tests/golden/NAME.png. When that is missing or differs, the candidate is left in the folder
/// golden-candidates beside the test program, to be looked at and copied.
inline void expect_golden(const Image& picture, const std::string& name,
                          const GoldenTolerance& tolerance = {}) {
  namespace fs = std::filesystem;
  const fs::path candidate = fs::path(SATEEN_PROGRAM).parent_path() / "golden-candidates" / (name + ".png");
  fs::create_directories(candidate.parent_path());
  io::write_image(candidate, picture);
  const fs::path golden = source_dir() / "tests" / "golden" / (name + ".png");
  ASSERT_TRUE(fs::exists(golden)) << "no golden picture yet; look at " << candidate << " and copy it to "
                                  << golden;
  const Image expected = io::read_data(golden);
  const Image seen = io::read_data(candidate);
  ASSERT_EQ(seen.width, expected.width);
  ASSERT_EQ(seen.height, expected.height);
  ASSERT_EQ(seen.channels, expected.channels);
  int largest = 0;
  int failing = 0;
  for (int y = 0; y < seen.height; ++y) {
    for (int x = 0; x < seen.width; ++x) {
      int apart = 0;
      for (int c = 0; c < seen.channels; ++c) {
        apart = std::max(
            apart, static_cast<int>(std::lround(std::abs(seen.at(x, y, c) - expected.at(x, y, c)) * 255)));
      }
      largest = std::max(largest, apart);
      failing += apart > tolerance.visible ? 1 : 0;
    }
  }
  const double share = static_cast<double>(failing) / (seen.width * seen.height);
  EXPECT_TRUE(largest <= tolerance.largest && share <= tolerance.failing_share)
      << "largest difference " << largest << " of 255, " << share * 100
      << " % of the pixels differ visibly; compare " << candidate << " with " << golden;
  if (largest <= tolerance.largest && share <= tolerance.failing_share) fs::remove(candidate);
}

}  // namespace sateen::test
