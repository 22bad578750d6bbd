// SPDX-License-Identifier: MIT
// The module sateen-camera: everything of the project that needs OpenCV's videoio.
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "sateen/io/camera_module.h"

namespace sateen::io {
namespace {

class CaptureSource final : public CameraSource {
 public:
  cv::VideoCapture capture;
  std::vector<std::string> unfixed;

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

std::unique_ptr<CameraSource> open_camera(int index) {
  // The drivers' own chatter would end up among a program's messages; what matters is told by Error.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
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

constexpr CameraModule kModule{SATEEN_VERSION, open_camera};

}  // namespace
}  // namespace sateen::io

extern "C" __attribute__((visibility("default"))) const sateen::io::CameraModule* sateen_module() {
  return &sateen::io::kModule;
}
