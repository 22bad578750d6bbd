// SPDX-License-Identifier: MIT
#include "capture_options.h"

#include <charconv>

#include <fmt/format.h>

#include "command.h"
#include "sateen/capture/report.h"
#include "sateen/capture/rig/live.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"

namespace sateen::cli {
namespace {

/// Numbers separated by blanks, commas or line ends; # starts a comment.
std::vector<double> read_numbers(const std::filesystem::path& path) {
  const std::string text = io::read_text(path);
  std::vector<double> numbers;
  int line = 1;
  for (const char* p = text.c_str(); *p != '\0';) {
    if (*p == '#') {
      while (*p != '\0' && *p != '\n') ++p;
    } else if (*p == '\n' || *p == ' ' || *p == ',' || *p == '\t' || *p == '\r') {
      line += *p == '\n' ? 1 : 0;
      ++p;
    } else {
      double value = 0;
      const auto [end, error] = std::from_chars(p, text.c_str() + text.size(), value);
      if (error != std::errc()) throw Error(fmt::format("{}: line {} holds no number", path.string(), line));
      numbers.push_back(value);
      p = end;
    }
  }
  return numbers;
}

std::optional<capture::Response> response_of(const std::string& name) {
  if (name == "auto") return std::nullopt;
  if (name == "srgb") return capture::Response::srgb();
  if (name == "linear") return capture::Response::linear();
  if (name.starts_with("gamma:")) {
    double exponent = 0;
    const char* first = name.c_str() + 6;
    const auto [end, error] = std::from_chars(first, name.c_str() + name.size(), exponent);
    if (error != std::errc() || *end != '\0' || !(exponent > 0)) {
      throw CLI::ValidationError("--response", "gamma:G needs a positive number, as in gamma:2.2");
    }
    return capture::Response::gamma(exponent);
  }
  capture::Response response;
  for (const double value : read_numbers(name)) response.curve.push_back(static_cast<float>(value));
  if (response.curve.size() < 2 || !(response.curve.back() > response.curve.front())) {
    throw Error(fmt::format(
        "{}: a response curve is at least two rising numbers, the light for evenly spaced codes", name));
  }
  return response;
}

}  // namespace

void add_capture_options(CLI::App& command, CaptureArguments& a) {
  capture::CaptureOptions& o = a.options;
  command.add_option("--report", a.report, "Folder for report.json and report.html");
  command.add_option("--size", o.table.size, "Texels along each normal axis (S)")
      ->check(CLI::Range(16, 1024));
  command.add_option("--slices", o.table.slices, "Tangent angles in one period (S_k)")
      ->check(CLI::Range(4, 2048));
  command
      .add_option("--symmetry", a.symmetry, "R: equivalent turns to average; auto takes the largest found")
      ->check(CLI::IsMember({"auto", "1", "2", "3", "4"}));
  command.add_option("--threshold", o.table.symmetry_threshold,
                     "PSNR in dB from which a turn counts as alike");
  command.add_option("--encoding", a.encoding, "Texels in the file")->check(CLI::IsMember({"srgb8", "half"}));

  const auto lens = "Lens";
  command
      .add_option("--focal-mm", o.lens.focal_mm,
                  "Focal length in mm (otherwise EXIF); needs the sensor's width")
      ->check(CLI::PositiveNumber)
      ->group(lens);
  command.add_option("--sensor-mm", o.lens.sensor_mm, "Width of the sensor in mm")
      ->check(CLI::PositiveNumber)
      ->group(lens);
  command.add_option("--fov", a.fov, "Horizontal field of view in degrees")
      ->check(CLI::Range(1.0, 170.0))
      ->group(lens);
  command.add_option("--calibration", a.calibration, "Camera from sateen capture calibrate (JSON)")
      ->group(lens);
  command
      .add_option("--perspective", a.perspective,
                  "Normals relative to the eye from each surface point, or to the camera's axis")
      ->check(CLI::IsMember({"eye", "view"}))
      ->group(lens);

  const auto turning = "Turning";
  command
      .add_option(
          "--angles", a.angles,
          "How far each frame is turned: pictures (found out), equal (one full turn in equal steps), a "
          "text file of degrees, counter-clockwise, or auto (what the stage of a live capture knew, "
          "otherwise pictures)")
      ->group(turning);
  command.add_option("--direction", a.direction, "Of equal steps, as the picture shows it")
      ->check(CLI::IsMember({"ccw", "cw"}))
      ->group(turning);
  command.add_option("--max-frames", o.source.max_frames, "Of longer sequences every n-th frame is used")
      ->check(CLI::Range(capture::kFewestCaptureFrames, 100000))
      ->group(turning);

  const auto tangent = "Tangent (all angles in degrees, counter-clockwise from the picture's right)";
  a.first_angle_option =
      command.add_option("--first-angle", a.first_angle, "The tangent's direction in the first frame")
          ->group(tangent);
  a.thread_option = command
                        .add_option("--thread-direction", a.thread_direction,
                                    "The tangent's direction read off one frame, in the middle of the sphere")
                        ->group(tangent);
  command.add_option("--thread-frame", a.thread_frame, "The frame it was read off, counted from 0")
      ->needs(a.thread_option)
      ->group(tangent);
  a.seam_option = command
                      .add_option("--tangent-from-seam", a.from_seam,
                                  "The tangent's direction relative to where the seam lies, seen from the "
                                  "middle; -90 for a seam at "
                                  "the pole of the parallels the threads follow")
                      ->group(tangent);
  a.weave_option = command
                       .add_option("--tangent-from-weave", a.from_weave,
                                   "The tangent's direction relative to the threads visible in the middle")
                       ->group(tangent);
  const std::vector<CLI::Option*> zeros{a.first_angle_option, a.thread_option, a.seam_option, a.weave_option};
  for (CLI::Option* one : zeros) {
    for (CLI::Option* other : zeros) {
      if (one != other) one->excludes(other);
    }
  }

  const auto light = "Light and seams";
  command
      .add_option("--response", a.response,
                  "From code values to light: auto (sRGB, or linear for EXR and HDR), srgb, linear, gamma:G, "
                  "or a text file "
                  "of numbers")
      ->group(light);
  command
      .add_option("--mask", o.seams.mask,
                  "Picture of one frame's size, white where the sphere shows no clean material")
      ->group(light);
  command.add_option("--mask-frame", o.seams.mask_frame, "The frame the mask was painted on, counted from 0")
      ->group(light);
  command
      .add_option("--mirror-ball", o.mirror_ball.picture,
                  "Picture of a chrome ball on the same stand: writes the light around it beside the AMC, "
                  "NAME.light.exr")
      ->group(light);
  command.add_option("--mirror-reflectance", o.mirror_ball.reflectance, "Of the chrome ball")
      ->check(CLI::Range(0.01, 1.0))
      ->group(light);
  command.add_flag("--keep-seams", a.keep_seams, "Do not look for seams")->group(light);
}

capture::CaptureOptions capture_options(const CaptureArguments& a) {
  capture::CaptureOptions o = a.options;
  if (a.symmetry != "auto") o.table.symmetry = std::stoi(a.symmetry);
  o.table.encoding = a.encoding == "half" ? amc::AmcEncoding::half : amc::AmcEncoding::srgb8;
  o.table.frame = a.perspective == "eye" ? capture::TableFrame::eye : capture::TableFrame::view;
  o.lens.fov = radians(a.fov);
  o.seams.find_blemishes = !a.keep_seams;
  o.source.response = response_of(a.response);
  if (!a.calibration.empty()) o.lens.camera = capture::read_camera(a.calibration);
  if (a.angles == "equal") {
    o.turn.source = capture::AngleSource::equal;
    o.turn.clockwise = a.direction == "cw";
  } else if (a.angles != "pictures" && a.angles != "auto") {
    o.turn.source = capture::AngleSource::given;
    for (const double angle : read_numbers(a.angles)) o.turn.angles.push_back(radians(angle));
  }
  if (a.first_angle_option->count() > 0) {
    o.tangent.given = true;
    o.tangent.angle = radians(a.first_angle);
  } else if (a.thread_option->count() > 0) {
    o.tangent.from = capture::ZeroAngle::thread;
    o.tangent.angle = radians(a.thread_direction);
    o.tangent.frame = a.thread_frame;
  } else if (a.seam_option->count() > 0) {
    o.tangent.from = capture::ZeroAngle::seam;
    o.tangent.angle = radians(a.from_seam);
  } else if (a.weave_option->count() > 0) {
    o.tangent.from = capture::ZeroAngle::weave;
    o.tangent.angle = radians(a.from_weave);
  }
  return o;
}

void take_stage_angles(const CaptureArguments& arguments, const std::vector<std::filesystem::path>& inputs,
                       capture::CaptureOptions& options) {
  std::error_code code;
  if (arguments.angles != "auto" || inputs.size() != 1 || !std::filesystem::is_directory(inputs[0], code))
    return;
  for (const double angle : capture::stage_angles(inputs[0])) options.turn.angles.push_back(radians(angle));
  if (!options.turn.angles.empty()) options.turn.source = capture::AngleSource::given;
}

namespace {

std::filesystem::path light_path(std::filesystem::path output) {
  return output.replace_extension(".light.exr");
}

}  // namespace

std::vector<std::filesystem::path> capture_outputs(const CaptureArguments& arguments,
                                                   const std::filesystem::path& output) {
  std::vector<std::filesystem::path> outputs{output, light_path(output)};
  if (arguments.report.empty()) return outputs;
  io::check_writable_folder(arguments.report);
  if (std::filesystem::is_directory(arguments.report)) {
    for (const char* name : capture::kReportFiles) outputs.push_back(arguments.report / name);
  }
  return outputs;
}

void report_capture(const CaptureArguments& arguments, const std::filesystem::path& output,
                    const capture::CaptureResult& result) {
  if (!result.environment.empty()) io::write_image(light_path(output), result.environment);
  for (const std::string& warning : result.warnings) warn(warning);
  if (!arguments.report.empty()) capture::write_report(arguments.report, result);
}

}  // namespace sateen::cli
