// SPDX-License-Identifier: MIT
#include "sateen/capture/rig/live.h"

#include <charconv>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sateen/core/error.h"
#include "sateen/io/camera.h"
#include "sateen/io/file.h"
#include "sateen/io/image_encode.h"
#include "sateen/io/json.h"
#include "sateen/io/video_reader.h"

namespace sateen::capture {
namespace fs = std::filesystem;

namespace {

class V4lCamera final : public LiveCamera {
 public:
  explicit V4lCamera(int index) : camera_(index) {}

  io::Picture8 shoot() override { return camera_.shoot(); }

  std::vector<std::string> warnings() const override {
    std::vector<std::string> warnings;
    for (const std::string& what : camera_.not_fixed()) {
      warnings.push_back(
          fmt::format("the camera's driver does not let its {} be fixed; drift is removed afterwards", what));
    }
    return warnings;
  }

 private:
  io::Camera camera_;
};

/// A recording in place of a camera: one frame of it a shot.
class RecordedCamera final : public LiveCamera {
 public:
  explicit RecordedCamera(const fs::path& path) : path_(path), reader_(path) {}

  io::Picture8 shoot() override {
    io::Picture8 picture;
    if (!reader_.next(picture)) throw Error(fmt::format("{}: has no more frames", path_.string()));
    return picture;
  }

 private:
  fs::path path_;
  io::VideoReader reader_;
};

std::string frame_name(int i) {
  return fmt::format("frame_{:03}.png", i);
}

/// What capture.json beside the frames says.
struct Plan {
  int frames = 0;
  std::vector<double> degrees;  ///< per frame; empty: the stage did not know
};

std::optional<Plan> read_plan(const fs::path& folder) {
  const fs::path path = folder / "capture.json";
  std::error_code code;
  if (!fs::exists(path, code)) return std::nullopt;
  try {
    const auto json = io::read_json(path);
    Plan plan{json.at("frames").get<int>(), json.value("degrees", std::vector<double>{})};
    if (plan.degrees.empty() || plan.degrees.size() == static_cast<std::size_t>(plan.frames)) return plan;
  } catch (const nlohmann::json::exception&) {
  }
  throw Error(fmt::format("{}: is no capture's plan; choose another folder", path.string()));
}

void write_plan(const fs::path& folder, const Plan& plan) {
  nlohmann::ordered_json json{{"frames", plan.frames}};
  if (!plan.degrees.empty()) json["degrees"] = plan.degrees;
  io::write_text(folder / "capture.json", io::json_text(json, 2) + "\n");
}

int frames_in(const fs::path& folder, int frames) {
  int found = 0;
  std::error_code code;
  for (int i = 0; i < frames; ++i) found += fs::exists(folder / frame_name(i), code) ? 1 : 0;
  return found;
}

}  // namespace

std::unique_ptr<LiveCamera> open_live_camera(const std::string& name) {
  int index = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), index);
  if (error == std::errc() && end == name.data() + name.size()) return std::make_unique<V4lCamera>(index);
  return std::make_unique<RecordedCamera>(name);
}

std::vector<double> stage_angles(const fs::path& folder) {
  const std::optional<Plan> plan = read_plan(folder);
  return plan ? plan->degrees : std::vector<double>{};
}

LiveResult capture_live(Stage& stage, LiveCamera& camera, const LiveOptions& options) {
  io::make_folder(options.folder);
  std::error_code code;
  const std::optional<Plan> earlier = read_plan(options.folder);
  if (earlier && earlier->frames != options.frames) {
    throw Error(
        fmt::format("{}: holds a capture of {} frames; resume it with --frames {} or choose another folder",
                    options.folder.string(), earlier->frames, earlier->frames));
  }
  LiveResult result;
  result.found = frames_in(options.folder, options.frames);
  // Frames of which nobody knows the angle make the others' useless.
  const bool earlier_known = result.found == 0 || (earlier && !earlier->degrees.empty());
  std::vector<double> degrees;
  for (int i = 0; i < options.frames; ++i) degrees.push_back(360.0 * i / options.frames);
  if (stage.knows_angles() && earlier_known) result.degrees = degrees;
  write_plan(options.folder, {options.frames, result.degrees});
  int last_found = -1;
  for (int i = 0; i < options.frames; ++i) {
    const fs::path path = options.folder / frame_name(i);
    if (fs::exists(path, code)) {
      last_found = i;
      continue;
    }
    if (last_found >= 0) stage.stands_at(degrees[static_cast<std::size_t>(last_found)]);
    last_found = -1;
    stage.move_to(degrees[static_cast<std::size_t>(i)]);
    const io::Picture8 picture = camera.shoot();
    try {
      io::write_bytes(path,
                      io::encode_png(picture));  // whole or not at all: a frame is there when its file is
    } catch (const Error& error) {
      throw Error(fmt::format("{}. The frames before it are whole: make room, then the same command goes on",
                              error.what()));
    }
    ++result.taken;
    report(options.progress, static_cast<double>(i + 1) / options.frames);
  }
  return result;
}

}  // namespace sateen::capture
