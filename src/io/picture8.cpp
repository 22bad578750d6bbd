// SPDX-License-Identifier: MIT
#include "sateen/io/picture8.h"

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"

namespace sateen {
namespace {

/// A JPEG ends with its end-of-image marker, perhaps with padding behind it. libjpeg fills a truncated
/// picture with grey and goes on, so it has to be seen here.
bool jpeg_is_truncated(const std::vector<std::byte>& bytes) {
  if (bytes.size() < 4 || bytes[0] != std::byte{0xff} || bytes[1] != std::byte{0xd8}) return false;
  const std::size_t tail = bytes.size() > 4096 ? bytes.size() - 4096 : 2;
  for (std::size_t i = bytes.size() - 1; i > tail; --i) {
    if (bytes[i - 1] == std::byte{0xff} && bytes[i] == std::byte{0xd9}) return false;
  }
  return true;
}

}  // namespace

Picture8 read_picture8(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  Picture8 picture;
  if (extension != ".jpg" && extension != ".jpeg") {
    const Image image = with_channels(read_data(path), 3);
    picture.width = image.width;
    picture.height = image.height;
    picture.rgb.reserve(image.data.size());
    for (const float v : image.data) picture.rgb.push_back(static_cast<std::uint8_t>(v * 255 + 0.5f));
    return picture;
  }
  std::vector<std::byte> bytes = read_bytes(path);
  if (bytes.empty()) throw Error(fmt::format("{}: is empty, a picture is needed", path.string()));
  if (jpeg_is_truncated(bytes)) throw Error(fmt::format("{}: is a truncated JPEG", path.string()));
  cv::Mat decoded;
  try {
    const cv::Mat file(1, static_cast<int>(bytes.size()), CV_8U, bytes.data());
    decoded = cv::imdecode(file, cv::IMREAD_COLOR);
  } catch (const cv::Exception&) {
    decoded.release();
  }
  if (decoded.empty()) throw Error(fmt::format("{}: cannot be read as a picture", path.string()));
  picture.width = decoded.cols;
  picture.height = decoded.rows;
  picture.rgb.resize(static_cast<std::size_t>(decoded.cols) * static_cast<std::size_t>(decoded.rows) * 3);
  cv::Mat target(decoded.rows, decoded.cols, CV_8UC3, picture.rgb.data());
  cv::cvtColor(decoded, target, cv::COLOR_BGR2RGB);
  return picture;
}

}  // namespace sateen
