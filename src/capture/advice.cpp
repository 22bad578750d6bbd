// SPDX-License-Identifier: MIT
#include "sateen/capture/advice.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace sateen::capture {
namespace {

std::vector<std::string> dropped_advice(const std::vector<CaptureFrame>& frames) {
  constexpr std::size_t kNamed = 4;
  std::map<Dropped, std::vector<std::string>> files;
  for (const CaptureFrame& frame : frames) {
    if (!frame.used() && frame.dropped != Dropped::same_angle) files[frame.dropped].push_back(frame.file);
  }
  std::vector<std::string> advice;
  for (auto& [reason, names] : files) {
    const std::size_t more = names.size() - std::min(kNamed, names.size());
    names.resize(names.size() - more);
    advice.push_back(fmt::format("left out ({}): {}{}", words(reason), fmt::join(names, ", "),
                                 more > 0 ? fmt::format(" and {} more", more) : ""));
  }
  return advice;
}

std::vector<std::string> framing_advice(const CaptureResult& result) {
  const double radius = result.mounting.radius;
  const double fills = 200 * radius / result.lens.camera.height;
  const int texels = result.table.amc.size;
  if (fills >= 35 && 2 * radius >= 1.2 * texels) return {};
  return {
      fmt::format("the sphere fills {:.0f} % of the picture's height ({:.0f} pixels for {} texels): move "
                  "closer or use a longer lens",
                  fills, 2 * radius, texels)};
}

std::vector<std::string> lens_advice(const CaptureResult& result) {
  if (!result.lens.estimate) return {};
  const FocalEstimate& estimate = *result.lens.estimate;
  const auto fov = [&](double focal) {
    return degrees(2 * std::atan(result.lens.camera.width / 2.0 / focal));
  };
  const LensEffect effect = focal_effect(result);
  const std::string source =
      estimate.informed ? "its focal length was estimated from the sphere's outline"
                        : "the sphere's outline does not tell the focal length (it is too near the picture's "
                          "middle, or too small), so what cameras commonly have was assumed";
  return {fmt::format(
      "the lens is unknown: {}, {:.0f} pixels. That is a horizontal field of view of {:.0f} degrees; it may "
      "be {:.0f} to {:.0f} degrees. At either end normals would be off by up to {:.1f} and tangents by up to "
      "{:.1f} degrees half-way to the rim. Give --focal-mm with --sensor-mm, --fov, or a calibration "
      "(sateen capture calibrate)",
      source, estimate.focal, fov(estimate.focal), fov(estimate.high), fov(estimate.low), effect.normals,
      effect.tangents)};
}

std::vector<std::string> axis_advice(const CaptureResult& result) {
  const double past = degrees(
      std::acos(std::clamp(-result.turn.axis.dot(result.mounting.sphere.centre.normalized()), -1.0, 1.0)));
  if (past <= 5) return {};
  return {
      fmt::format("the turning axis points {:.1f} degrees past the camera: parts of the material are seen "
                  "only in part of the turn. Point the axis at the lens",
                  past)};
}

}  // namespace

LensEffect focal_effect(const CaptureResult& result) {
  const FocalEstimate& estimate = *result.lens.estimate;
  const double radius = result.mounting.sphere.radius_pixel(result.lens.camera);
  const LensEffect low = lens_effect(radius, estimate.focal, estimate.low);
  const LensEffect high = lens_effect(radius, estimate.focal, estimate.high);
  return {std::max(low.normals, high.normals), std::max(low.tangents, high.tangents)};
}

std::vector<std::string> advice(const CaptureResult& result) {
  std::vector<std::string> all;
  for (const std::vector<std::string>& some :
       {advice(result.turn), advice(result.mounting), advice(result.photometry), advice(result.clipping),
        advice(result.seams), advice(result.first_angle), dropped_advice(result.frames),
        framing_advice(result), lens_advice(result), axis_advice(result)}) {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

}  // namespace sateen::capture
