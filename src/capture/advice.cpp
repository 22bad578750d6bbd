// SPDX-License-Identifier: MIT
#include "sateen/capture/advice.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sateen/capture/choose_camera.h"
#include "sateen/capture/used_frames.h"

namespace sateen {
namespace {

/// What a wrong guess of the lens costs grows with how much of the view the sphere fills.
std::string lens_advice(const SphereView& sphere) {
  const double half = sphere.half_angle();
  const double bend = std::abs(std::sin(std::atan(0.5 * std::tan(half))) / std::sin(half) - 0.5);
  return fmt::format(
      "the lens is unknown, so a horizontal field of view of {:.0f} degrees was assumed. If it is much "
      "longer, normals are off by about {:.1f} and tangents by about {:.1f} degrees half-way to the rim. "
      "Give --focal-mm with --sensor-mm, --fov, or a calibration (sateen capture calibrate)",
      kAssumedFov, degrees(bend), degrees(half / 2));
}

}  // namespace

std::vector<std::string> dropped_advice(const std::vector<CaptureFrame>& frames) {
  constexpr std::size_t kNamed = 4;
  std::map<std::string, std::vector<std::string>> files;  // of each reason
  for (const CaptureFrame& frame : frames) {
    if (!frame.dropped.empty() && frame.dropped != kSameAngle) files[frame.dropped].push_back(frame.file);
  }
  std::vector<std::string> advice;
  for (auto& [reason, names] : files) {
    const std::size_t more = names.size() - std::min(kNamed, names.size());
    names.resize(names.size() - more);
    advice.push_back(fmt::format("left out ({}): {}{}", reason, fmt::join(names, ", "),
                                 more > 0 ? fmt::format(" and {} more", more) : ""));
  }
  return advice;
}

std::vector<std::string> framing_advice(const CaptureResult& result, int texels) {
  std::vector<std::string> advice;
  const double radius = result.frames.front().radius;
  const double fills = 200 * radius / result.camera.height;
  if (fills < 35 || 2 * radius < 1.2 * texels) {
    advice.push_back(
        fmt::format("the sphere fills {:.0f} % of the picture's height ({:.0f} pixels for {} texels): move "
                    "closer or use a longer lens",
                    fills, 2 * radius, texels));
  }
  if (result.camera.focal_source == "assumed") advice.push_back(lens_advice(result.sphere));
  const double towards =
      degrees(std::acos(std::clamp(-result.axis.dot(result.sphere.centre.normalized()), -1.0, 1.0)));
  if (towards > 5) {
    advice.push_back(
        fmt::format("the turning axis points {:.1f} degrees past the camera: parts of the material are seen "
                    "only in part of the turn. Point the axis at the lens",
                    towards));
  }
  return advice;
}

}  // namespace sateen
