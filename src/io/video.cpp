// SPDX-License-Identifier: MIT
#include "sateen/io/video.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/videoio.hpp>

#include "sateen/core/colour.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"

namespace sateen::io {
namespace {

namespace fs = std::filesystem;

cv::Mat bgr8(const Image& linear) {
  const Image encoded = srgb_encoded(with_channels(linear, 3));
  cv::Mat mat(encoded.height, encoded.width, CV_8UC3);
  for (int y = 0; y < encoded.height; ++y) {
    for (int x = 0; x < encoded.width; ++x) {
      const auto in = encoded.pixel(x, y);
      auto& out = mat.at<cv::Vec3b>(y, x);
      for (int c = 0; c < 3; ++c) {
        const float v = std::clamp(in[static_cast<std::size_t>(2 - c)], 0.0f, 1.0f);
        out[c] = static_cast<unsigned char>(std::lround(v * 255));
      }
    }
  }
  return mat;
}

bool open(cv::VideoWriter& writer, const fs::path& path, double frames_per_second, const cv::Size& size) {
  for (const int codec :
       {cv::VideoWriter::fourcc('a', 'v', 'c', '1'), cv::VideoWriter::fourcc('m', 'p', '4', 'v')}) {
    if (writer.open(path.string(), codec, frames_per_second, size)) return true;
  }
  return false;
}

}  // namespace

bool is_video_path(const fs::path& path) {
  const std::string extension = extension_of(path);
  return extension == ".mp4" || extension == ".mov" || extension == ".avi";
}

void write_video(const fs::path& path, int count, double frames_per_second,
                 const std::function<Image(int)>& picture) {
  if (!is_video_path(path))
    throw Error(fmt::format("{}: films are written as .mp4, .mov or .avi", path.string()));
  // The library reports to stderr what is told to the user here.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  write_atomically(path, [&](const fs::path& temporary) {
    cv::VideoWriter writer;
    cv::Size size;
    for (int i = 0; i < count; ++i) {
      const Image image = picture(i);
      if (i == 0) {
        size = cv::Size(image.width, image.height);
        if (size.width % 2 != 0 || size.height % 2 != 0) {
          throw Error(fmt::format("{}: a film needs an even width and height, not {} x {}", path.string(),
                                  size.width, size.height));
        }
        if (!open(writer, temporary, frames_per_second, size)) {
          throw Error(
              fmt::format("{}: no film can be written there; is the folder writable and an MPEG-4 encoder "
                          "installed?",
                          path.string()));
        }
      }
      writer.write(bgr8(image));
    }
  });
}

}  // namespace sateen::io
