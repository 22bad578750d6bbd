// SPDX-License-Identifier: MIT
// Pictures of which more or less is stored than shown, written by OpenImageIO.
#include <numeric>

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sateen/core/error.h"
#include "sateen/io/image.h"
#include "sateen/io/image_rows.h"
#include "support/files.h"

namespace sateen::io {
namespace {

namespace fs = std::filesystem;

/// What is stored, 3 channels, placed in a window of 8 x 6 pixels.
void write_stored(const fs::path& path, const PixelRect& stored) {
  OIIO::ImageSpec spec(stored.width, stored.height, 3, OIIO::TypeDesc::FLOAT);
  spec.x = stored.x;
  spec.y = stored.y;
  spec.full_x = spec.full_y = 0;
  spec.full_width = 8;
  spec.full_height = 6;
  std::vector<float> samples;
  for (int y = 0; y < stored.height; ++y) {
    for (int x = 0; x < stored.width; ++x) {
      for (int c = 0; c < 3; ++c)
        samples.push_back(static_cast<float>(100 * (y + stored.y) + (x + stored.x)) +
                          0.25f * static_cast<float>(c));
    }
  }
  const auto out = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(out && out->open(path.string(), spec));
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, samples.data()));
  out->close();
}

TEST(Windows, OverscanIsCutAndWhatIsNotStoredIsBlackInEveryReader) {
  const test::TemporaryFolder folder;
  const PixelRect overscan{-2, -1, 12, 9};
  for (const auto& [name, stored] : {std::pair{"over.exr", overscan},
                                     {"part.exr", {3, 2, 3, 2}},
                                     {"beside.exr", {5, 4, 9, 7}},
                                     {"away.exr", {20, 20, 3, 3}},
                                     {"part.tif", {3, 2, 3, 2}},
                                     {"beside.tif", {5, 4, 9, 7}}}) {
    const fs::path path = folder / name;
    write_stored(path, stored);
    const Image whole = read_data(path);
    ASSERT_EQ(std::pair(whole.width, whole.height), std::pair(8, 6)) << name;
    EXPECT_EQ(std::pair(read_image_info(path).width, read_image_info(path).height), std::pair(8, 6));
    for (int y = 0; y < 6; ++y) {
      for (int x = 0; x < 8; ++x) {
        const bool there =
            x >= stored.x && y >= stored.y && x < stored.x + stored.width && y < stored.y + stored.height;
        EXPECT_EQ(whole.at(x, y, 1), there ? static_cast<float>(100 * y + x) + 0.25f : 0) << name;
      }
    }
    ImageRowReader rows(path);
    ASSERT_EQ(std::pair(rows.width(), rows.height()), std::pair(8, 6)) << name;
    std::vector<float> read(whole.data.size());
    const std::size_t row = 8 * 3;
    rows.read(std::span(read).first(row));
    rows.read(std::span(read).subspan(row, 3 * row));
    rows.read(std::span(read).subspan(4 * row));
    EXPECT_EQ(read, whole.data) << name;
    const PixelRect region{2, 1, 5, 4};
    EXPECT_EQ(read_image(path, {.encoding = Encoding::linear, .region = region}).data,
              cropped(whole, region).data);
  }
}

}  // namespace
}  // namespace sateen::io
