// SPDX-License-Identifier: MIT
#include "sateen/capture/advice.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sateen/capture/turning/used_frames.h"

namespace sateen::capture {
namespace {

std::string lens_advice(const CaptureResult& result) {
  const FocalEstimate& lens = *result.focal;
  const auto fov = [&](double focal) { return degrees(2 * std::atan(result.camera.width / 2.0 / focal)); };
  const LensEffect effect = focal_effect(result);
  const std::string source =
      lens.informed ? "its focal length was estimated from the sphere's outline"
                    : "the sphere's outline does not tell the focal length (it is too near the picture's "
                      "middle, or too small), so what cameras commonly have was assumed";
  return fmt::format(
      "the lens is unknown: {}, {:.0f} pixels. That is a horizontal field of view of {:.0f} degrees; it may "
      "be "
      "{:.0f} to {:.0f} degrees. At either end normals would be off by up to {:.1f} and tangents by up to "
      "{:.1f} degrees half-way to the rim. Give --focal-mm with --sensor-mm, --fov, or a calibration "
      "(sateen capture calibrate)",
      source, lens.focal, fov(lens.focal), fov(lens.high), fov(lens.low), effect.normals, effect.tangents);
}

}  // namespace

LensEffect focal_effect(const CaptureResult& result) {
  const double radius = result.sphere.radius_pixel(result.camera);
  const LensEffect low = lens_effect(radius, result.focal->focal, result.focal->low);
  const LensEffect high = lens_effect(radius, result.focal->focal, result.focal->high);
  return {std::max(low.normals, high.normals), std::max(low.tangents, high.tangents)};
}

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
  if (result.focal) advice.push_back(lens_advice(result));
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

}  // namespace sateen::capture
