// SPDX-License-Identifier: MIT
#include "sateen/io/image_memory.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "sateen/core/error.h"

namespace sateen::io {
namespace {

// OpenCV decodes a cut-off picture without a word and leaves the rest grey: the end marker has to be there.
void check_whole(std::string_view bytes, const std::string& name) {
  std::string_view end;
  if (bytes.starts_with("\x89PNG")) {
    end = "IEND";
  } else if (bytes.starts_with("\xff\xd8\xff")) {
    end = "\xff\xd9";
  } else {
    throw Error(fmt::format("{}: is neither PNG nor JPEG", name));
  }
  if (bytes.rfind(end) == std::string_view::npos) throw Error(fmt::format("{}: is truncated", name));
}

}  // namespace

Image read_data_from_memory(std::span<const std::byte> bytes, const std::string& name) {
  check_whole({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name);
  cv::Mat picture;
  try {
    const cv::Mat wrapped(1, static_cast<int>(bytes.size()), CV_8U, const_cast<std::byte*>(bytes.data()));
    picture = cv::imdecode(wrapped, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    picture.release();
  }
  if (picture.empty()) throw Error(fmt::format("{}: is corrupt", name));
  if (picture.channels() == 3) cv::cvtColor(picture, picture, cv::COLOR_BGR2RGB);
  if (picture.channels() == 4) cv::cvtColor(picture, picture, cv::COLOR_BGRA2RGBA);
  Image image(picture.cols, picture.rows, picture.channels());
  cv::Mat data(picture.rows, picture.cols, CV_MAKETYPE(CV_32F, picture.channels()), image.data.data());
  picture.convertTo(data, CV_32F, picture.depth() == CV_16U ? 1.0 / 65535 : 1.0 / 255);
  return image;
}

}  // namespace sateen::io
