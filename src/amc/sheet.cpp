// SPDX-License-Identifier: MIT
#include "sateen/amc/sheet.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "sateen/core/direction.h"

namespace sateen::amc {
namespace {

constexpr int kTile = 160;
constexpr int kMargin = 12;
constexpr int kLabel = 22;
constexpr float kPaper = 0.035f;

void paste(Image& sheet, const Image& picture, int left, int top) {
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) sheet.set_rgb(left + x, top + y, picture.rgb(x, y));
  }
}

void label(Image& sheet, const std::string& text, int left, int top) {
  cv::Mat view(sheet.height, sheet.width, CV_32FC3, sheet.data.data());
  cv::putText(view, text, {left, top + kLabel - 7}, cv::FONT_HERSHEY_SIMPLEX, 0.45, {0.6, 0.6, 0.6}, 1,
              cv::LINE_AA);
}

/// A slice cut out along its disc, on paper colour.
Image disc_tile(const AmcTable& table, int slice) {
  Image tile = resized(slice_image(table, slice), kTile, kTile);
  for (int y = 0; y < kTile; ++y) {
    for (int x = 0; x < kTile; ++x) {
      const double outside = (disc_of_pixel(x, y, kTile).norm() - 1) * kTile / 2 + 0.5;
      const float t = static_cast<float>(std::clamp(outside, 0.0, 1.0));
      tile.set_rgb(x, y, (1 - t) * tile.rgb(x, y) + t * Vec3f::Constant(kPaper));
    }
  }
  return tile;
}

/// k runs down one period, the other axis (n_x or n_y) to the right.
Image cut(const AmcTable& table, bool along_x, int height) {
  const int middle = table.size / 2;
  Image picture(table.size, table.slices, 3);
  for (int f = 0; f < table.slices; ++f) {
    for (int i = 0; i < table.size; ++i) {
      picture.set_rgb(i, f, along_x ? table.texel(i, middle, f) : table.texel(middle, i, f));
    }
  }
  return resized(picture, kTile, height);
}

}  // namespace

Image contact_sheet(const AmcTable& table, int columns, int rows) {
  const int step_y = kTile + kLabel + kMargin;
  const int width = (columns + 2) * (kTile + kMargin) + 2 * kMargin;
  const int height = rows * step_y + kMargin;
  Image sheet(width, height, 3, kPaper);
  const int count = columns * rows;
  for (int i = 0; i < count; ++i) {
    const int slice = i * table.slices / count;
    const int left = kMargin + i % columns * (kTile + kMargin);
    const int top = kMargin + i / columns * step_y;
    paste(sheet, disc_tile(table, slice), left, top);
    label(sheet, fmt::format("{:.1f} deg", 360 * table.slice_angle(slice)), left, top + kTile);
  }
  const int cut_height = rows * step_y - kMargin - kLabel;
  for (const bool along_x : {true, false}) {
    const int left = 2 * kMargin + (columns + (along_x ? 0 : 1)) * (kTile + kMargin);
    paste(sheet, cut(table, along_x, cut_height), left, kMargin);
    label(sheet, along_x ? "nx right, k down" : "ny right, k down", left, kMargin + cut_height);
  }
  return sheet;
}

}  // namespace sateen::amc
