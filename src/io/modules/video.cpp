// SPDX-License-Identifier: MIT
// The module sateen-video: everything of the project that needs OpenCV's videoio.
#include <cmath>
#include <cstdlib>
#include <mutex>

#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "sateen/io/video_module.h"

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

class CaptureSource final : public FrameSource {
 public:
  cv::VideoCapture capture;
  std::vector<std::string> unfixed;

  int width() const override { return static_cast<int>(capture.get(cv::CAP_PROP_FRAME_WIDTH)); }
  int height() const override { return static_cast<int>(capture.get(cv::CAP_PROP_FRAME_HEIGHT)); }
  double promised_frames() const override { return capture.get(cv::CAP_PROP_FRAME_COUNT); }
  double frames_per_second() const override { return capture.get(cv::CAP_PROP_FPS); }
  std::vector<std::string> not_fixed() const override { return unfixed; }

  bool next(Picture8& frame) override {
    try {
      if (!capture.read(frame_) || frame_.empty()) return false;
      frame.width = frame_.cols;
      frame.height = frame_.rows;
      frame.rgb.resize(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height) * 3);
      cv::Mat target(frame.height, frame.width, CV_8UC3, frame.rgb.data());
      cv::cvtColor(frame_, target, frame_.channels() == 1 ? cv::COLOR_GRAY2RGB : cv::COLOR_BGR2RGB);
    } catch (const cv::Exception&) {
      return false;
    }
    return true;
  }

  bool skip() override {
    try {
      return capture.grab();
    } catch (const cv::Exception&) {
      return false;
    }
  }

 private:
  cv::Mat frame_;
};

std::unique_ptr<FrameSource> open_film(const std::string& path) {
  silence_decoders();
  auto source = std::make_unique<CaptureSource>();
  try {
    if (!source->capture.open(path, cv::CAP_FFMPEG)) return nullptr;
  } catch (const cv::Exception&) {
    return nullptr;
  }
  return source;
}

std::unique_ptr<FrameSource> open_camera(int index) {
  auto source = std::make_unique<CaptureSource>();
  cv::VideoCapture& capture = source->capture;
  if (!capture.open(index, cv::CAP_V4L2)) return nullptr;
  capture.set(cv::CAP_PROP_BUFFERSIZE, 1);
  // Let it adapt to the scene once, then hold it there.
  for (int i = 0; i < 15; ++i) source->skip();
  const auto fix = [&](int automatic, double manual, int property, const char* name) {
    const double now = capture.get(property);
    if (capture.set(automatic, manual)) {
      capture.set(property, now);
    } else {
      source->unfixed.emplace_back(name);
    }
  };
  fix(cv::CAP_PROP_AUTO_EXPOSURE, 1, cv::CAP_PROP_EXPOSURE, "exposure");
  fix(cv::CAP_PROP_AUTO_WB, 0, cv::CAP_PROP_WB_TEMPERATURE, "white balance");
  capture.set(cv::CAP_PROP_AUTOFOCUS, 0);
  return source;
}

class WriterSink final : public FrameSink {
 public:
  cv::VideoWriter writer;

  void write(const Picture8& frame) override {
    const cv::Mat rgb(frame.height, frame.width, CV_8UC3, const_cast<std::uint8_t*>(frame.rgb.data()));
    cv::cvtColor(rgb, bgr_, cv::COLOR_RGB2BGR);
    writer.write(bgr_);
  }

 private:
  cv::Mat bgr_;
};

std::unique_ptr<FrameSink> create_film(const std::string& path, int width, int height,
                                       double frames_per_second) {
  silence_decoders();
  auto sink = std::make_unique<WriterSink>();
  for (const int codec :
       {cv::VideoWriter::fourcc('a', 'v', 'c', '1'), cv::VideoWriter::fourcc('m', 'p', '4', 'v')}) {
    if (sink->writer.open(path, codec, frames_per_second, cv::Size(width, height))) return sink;
  }
  return nullptr;
}

constexpr VideoModule kModule{SATEEN_VERSION, open_film, open_camera, create_film};

}  // namespace
}  // namespace sateen::io

extern "C" __attribute__((visibility("default"))) const sateen::io::VideoModule* sateen_module() {
  return &sateen::io::kModule;
}
