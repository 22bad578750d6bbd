// SPDX-License-Identifier: MIT
#include "sateen/capture/live.h"

#include <cstring>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "sateen/core/error.h"
#include "sateen/io/file.h"

namespace sateen {
namespace fs = std::filesystem;

namespace {

class V4lCamera final : public LiveCamera {
 public:
  explicit V4lCamera(int index) {
    if (!capture_.open(index, cv::CAP_V4L2)) {
      throw Error(fmt::format(
          "no camera {} answers (V4L2); look at /dev/video* and whether another program uses it", index));
    }
    capture_.set(cv::CAP_PROP_BUFFERSIZE, 1);
    // Let it adapt to the scene once, then hold it there.
    cv::Mat frame;
    for (int i = 0; i < 15; ++i) capture_.read(frame);
    fix(cv::CAP_PROP_AUTO_EXPOSURE, 1, cv::CAP_PROP_EXPOSURE, "exposure");
    fix(cv::CAP_PROP_AUTO_WB, 0, cv::CAP_PROP_WB_TEMPERATURE, "white balance");
    capture_.set(cv::CAP_PROP_AUTOFOCUS, 0);
  }

  Picture8 shoot() override {
    cv::Mat frame;
    // The driver may still hold frames from while the stage moved.
    for (int i = 0; i < 3; ++i) {
      if (!capture_.read(frame) || frame.empty())
        throw Error("the camera delivers no more pictures; is it still plugged in?");
    }
    Picture8 picture;
    picture.width = frame.cols;
    picture.height = frame.rows;
    picture.rgb.resize(frame.total() * 3);
    cv::Mat target(frame.rows, frame.cols, CV_8UC3, picture.rgb.data());
    cv::cvtColor(frame, target, cv::COLOR_BGR2RGB);
    return picture;
  }

  std::vector<std::string> warnings() const override { return warnings_; }

 private:
  void fix(int automatic, double manual, int property, const char* name) {
    const double now = capture_.get(property);
    if (capture_.set(automatic, manual)) {
      capture_.set(property, now);
    } else {
      warnings_.push_back(
          fmt::format("the camera's driver does not let its {} be fixed; drift is removed afterwards", name));
    }
  }

  cv::VideoCapture capture_;
  std::vector<std::string> warnings_;
};

std::string frame_name(int i) {
  return fmt::format("frame_{:03}.png", i);
}

/// A frame is there when its file is: files appear whole or not at all.
void write_frame(const fs::path& path, Picture8 picture) {
  cv::Mat bgr;
  cv::cvtColor(cv::Mat(picture.height, picture.width, CV_8UC3, picture.rgb.data()), bgr, cv::COLOR_RGB2BGR);
  std::vector<unsigned char> png;
  if (!cv::imencode(".png", bgr, png, {cv::IMWRITE_PNG_COMPRESSION, 3})) {
    throw Error(fmt::format("{}: the camera's picture cannot be encoded", path.string()));
  }
  write_bytes(path, std::as_bytes(std::span(png)));
}

void check_plan(const fs::path& folder, int frames) {
  const fs::path plan = folder / "capture.json";
  std::error_code code;
  if (!fs::exists(plan, code)) return;
  int planned = 0;
  try {
    planned = nlohmann::json::parse(read_text(plan)).at("frames").get<int>();
  } catch (const nlohmann::json::exception&) {
    throw Error(fmt::format("{}: is no capture's plan; choose another folder", plan.string()));
  }
  if (planned != frames) {
    throw Error(
        fmt::format("{}: holds a capture of {} frames; resume it with --frames {} or choose another folder",
                    folder.string(), planned, planned));
  }
}

}  // namespace

std::unique_ptr<LiveCamera> open_live_camera(int index) {
  return std::make_unique<V4lCamera>(index);
}

LiveResult capture_live(Stage& stage, LiveCamera& camera, const LiveOptions& options) {
  std::error_code code;
  fs::create_directories(options.folder, code);
  if (!fs::is_directory(options.folder)) {
    throw Error(fmt::format("{}: cannot be made as a folder for the frames", options.folder.string()));
  }
  check_plan(options.folder, options.frames);
  LiveResult result;
  result.angles_known = stage.knows_angles();
  nlohmann::ordered_json plan{{"frames", options.frames}};
  for (int i = 0; i < options.frames; ++i) {
    result.degrees.push_back(360.0 * i / options.frames);
    if (result.angles_known) plan["degrees"].push_back(result.degrees.back());
  }
  write_text(options.folder / "capture.json", plan.dump(2) + "\n");
  int last_found = -1;
  for (int i = 0; i < options.frames; ++i) {
    const fs::path path = options.folder / frame_name(i);
    if (fs::exists(path, code)) {
      ++result.found;
      last_found = i;
      continue;
    }
    if (last_found >= 0) stage.stands_at(result.degrees[static_cast<std::size_t>(last_found)]);
    last_found = -1;
    stage.move_to(result.degrees[static_cast<std::size_t>(i)]);
    write_frame(path, camera.shoot());
    ++result.taken;
    report(options.progress, static_cast<double>(i + 1) / options.frames);
  }
  if (!result.angles_known) result.degrees.clear();
  return result;
}

}  // namespace sateen
