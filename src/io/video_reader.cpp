// SPDX-License-Identifier: MIT
#include "sateen/io/video_reader.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <mutex>

#include <fmt/format.h>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "sateen/core/error.h"

namespace sateen::io {
namespace {

/// The decoders' own chatter would end up among a program's messages; what matters is told by Error.
void silence_decoders() {
  static std::once_flag once;
  std::call_once(once, [] {
    setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  });
}

}  // namespace

struct VideoReader::State {
  cv::VideoCapture capture;
  cv::Mat frame;
};

std::span<const std::string> video_extensions() {
  static const std::array<std::string, 6> extensions{".mp4", ".mov", ".avi", ".mkv", ".webm", ".m4v"};
  return extensions;
}

VideoReader::VideoReader(const std::filesystem::path& path) : state_(std::make_unique<State>()) {
  std::error_code code;
  if (!std::filesystem::exists(path, code)) throw Error(fmt::format("{}: no such file", path.string()));
  silence_decoders();
  bool opened = false;
  try {
    opened = state_->capture.open(path.string(), cv::CAP_FFMPEG);
  } catch (const cv::Exception&) {
    opened = false;
  }
  if (!opened || width() < 1 || height() < 1) {
    throw Error(
        fmt::format("{}: cannot be decoded as a video; its index may be missing (an interrupted recording) "
                    "or its codec unknown. "
                    "Copy it through ffmpeg into an .mp4, or extract its frames as pictures",
                    path.string()));
  }
}

VideoReader::~VideoReader() = default;
VideoReader::VideoReader(VideoReader&&) noexcept = default;
VideoReader& VideoReader::operator=(VideoReader&&) noexcept = default;

int VideoReader::width() const {
  return static_cast<int>(state_->capture.get(cv::CAP_PROP_FRAME_WIDTH));
}

int VideoReader::height() const {
  return static_cast<int>(state_->capture.get(cv::CAP_PROP_FRAME_HEIGHT));
}

int VideoReader::promised_frames() const {
  const double frames = state_->capture.get(cv::CAP_PROP_FRAME_COUNT);
  return frames > 0 && frames < 1e8 ? static_cast<int>(frames) : 0;
}

double VideoReader::frames_per_second() const {
  const double rate = state_->capture.get(cv::CAP_PROP_FPS);
  return std::isfinite(rate) && rate > 0 ? rate : 0;
}

bool VideoReader::next(Picture8& frame) {
  try {
    if (!state_->capture.read(state_->frame) || state_->frame.empty()) return false;
    frame.width = state_->frame.cols;
    frame.height = state_->frame.rows;
    frame.rgb.resize(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height) * 3);
    cv::Mat target(frame.height, frame.width, CV_8UC3, frame.rgb.data());
    cv::cvtColor(state_->frame, target,
                 state_->frame.channels() == 1 ? cv::COLOR_GRAY2RGB : cv::COLOR_BGR2RGB);
  } catch (const cv::Exception&) {
    return false;
  }
  return true;
}

bool VideoReader::skip() {
  try {
    return state_->capture.grab();
  } catch (const cv::Exception&) {
    return false;
  }
}

}  // namespace sateen::io
