// SPDX-License-Identifier: MIT
#include "sateen/capture/photographs/grey_picture.h"

#include <algorithm>
#include <cmath>

namespace sateen::capture {

int grey_factor(int width, int height) {
  return std::max(1, (std::max(width, height) + 1279) / 1280);
}

GreyPicture grey_picture(const Photograph& frame, int factor) {
  GreyPicture picture;
  grey_picture(frame, factor, {0, 0, frame.width() / factor, frame.height() / factor}, picture);
  return picture;
}

namespace {

/// The code of all light from 0 to Photograph::kWhite.
const std::vector<std::uint8_t>& codes_of_light() {
  static const std::vector<std::uint8_t> codes = [] {
    std::vector<std::uint8_t> table(Photograph::kWhite + 1);
    for (std::size_t light = 0; light < table.size(); ++light) {
      const double share = static_cast<double>(light) / Photograph::kWhite;
      table[light] = static_cast<std::uint8_t>(std::lround(255 * std::sqrt(share)));
    }
    return table;
  }();
  return codes;
}

}  // namespace

void grey_picture(const Photograph& frame, int factor, const GreyRegion& region, GreyPicture& picture) {
  picture.width = frame.width() / factor;
  picture.height = frame.height() / factor;
  picture.codes.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  const int first = std::max(0, region.left);
  const int end = std::min(picture.width, region.right);
  if (first >= end) return;
  const std::vector<std::uint8_t>& code_of = codes_of_light();
  const int pixels = factor * factor;
  std::vector<int> sums(static_cast<std::size_t>(end - first));
  for (int y = std::max(0, region.top); y < std::min(picture.height, region.bottom); ++y) {
    std::ranges::fill(sums, 0);
    for (int v = 0; v < factor; ++v) frame.add_grey_row(first * factor, y * factor + v, factor, sums);
    std::uint8_t* codes = &picture.codes[pixel_index(first, y, picture.width)];
    if (pixels > 1) {
      for (int& sum : sums) sum /= pixels;
    }
    for (std::size_t i = 0; i < sums.size(); ++i) codes[i] = code_of[static_cast<std::size_t>(sums[i])];
  }
}

}  // namespace sateen::capture
