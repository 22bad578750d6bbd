// SPDX-License-Identifier: MIT
#include <cmath>

#include <nlohmann/json.hpp>

#include "sateen/capture/advice.h"
#include "sateen/capture/report.h"

namespace sateen::capture {
namespace {

double rounded(double value, double step) {
  return std::round(value / step) * step;
}

/// Numbers with as many digits as they deserve.
double fine(double value) {
  return std::round(value * 1e4) / 1e4;
}

}  // namespace

std::string report_json(const CaptureResult& result) {
  using Json = nlohmann::ordered_json;
  Json json;
  json["frames"] = Json::array();
  for (const CaptureFrame& frame : result.frames) {
    const double exposure = Vec3(0.2126, 0.7152, 0.0722).dot(frame.gain);
    Json entry{{"file", frame.file},
               {"angle_degrees", fine(degrees(frame.angle))},
               {"turned_degrees", fine(degrees(frame.turned))},
               {"center", {fine(frame.centre.x()), fine(frame.centre.y())}},
               {"radius", fine(frame.radius)},
               {"exposure", fine(exposure)},
               {"white_balance",
                {fine(frame.gain.x() / frame.gain.y()), 1.0, fine(frame.gain.z() / frame.gain.y())}},
               {"sharpness", fine(frame.sharpness)},
               {"confidence", fine(frame.confidence)},
               {"used", frame.dropped.empty()}};
    if (!frame.dropped.empty()) entry["dropped"] = frame.dropped;
    json["frames"].push_back(std::move(entry));
  }
  const Vec2 centre = result.sphere.centre_pixel(result.camera);
  Vec2 outline(0, 0);
  for (int i = 0; i < 360; ++i) outline += result.sphere.outline_pixel(result.camera, radians(i)) / 360;
  const Vec2 pole = result.camera.project(result.sphere.centre + result.axis);
  json["sphere"] = {{"center", {fine(centre.x()), fine(centre.y())}},
                    {"radius", fine(result.sphere.radius_pixel(result.camera))},
                    {"outline_center", {fine(outline.x()), fine(outline.y())}},
                    {"wobble_pixels", fine(result.wobble)},
                    {"wobble_residual_pixels", fine(result.wobble_rms)},
                    {"outline_seen", fine(result.outline_support)}};
  json["camera"] = {{"width", result.camera.width},
                    {"height", result.camera.height},
                    {"focal_pixels", {fine(result.camera.focal.x()), fine(result.camera.focal.y())}},
                    {"principal", {fine(result.camera.principal.x()), fine(result.camera.principal.y())}},
                    {"source", result.camera.focal_source}};
  if (result.focal) {
    const LensEffect effect = focal_effect(result);
    json["camera"]["focal_interval"] = {fine(result.focal->low), fine(result.focal->high)};
    json["camera"]["normals_off_degrees"] = fine(effect.normals);
    json["camera"]["tangents_off_degrees"] = fine(effect.tangents);
  }
  json["axis"] = {{"direction", {fine(result.axis.x()), fine(result.axis.y()), fine(result.axis.z())}},
                  {"pole", {fine(pole.x()), fine(pole.y())}}};
  json["turn"] = {{"degrees", fine(degrees(result.turned))},
                  {"direction", result.turned >= 0 ? "counter-clockwise" : "clockwise"},
                  {"equal_steps", result.equal_steps},
                  {"zero", result.zero_source}};
  json["photometry"] = {{"corrected", result.photometry.measured},
                        {"drift", fine(result.photometry.drift)},
                        {"colour_drift", fine(result.photometry.colour_drift)},
                        {"banding", fine(result.photometry.banding)},
                        {"clipped", fine(result.clipped_share)}};
  json["symmetry"] = {{"R", result.table.symmetry}, {"isotropic", result.table.isotropic}};
  for (const amc::Similarity& similarity : result.symmetry.similarities) {
    json["symmetry"]["psnr_db"][std::to_string(similarity.turns)] = rounded(similarity.psnr, 0.01);
  }
  json["mask"] = {{"share", fine(result.mask.share)}};
  json["table"] = {
      {"size", result.table.size}, {"slices", result.table.slices}, {"measured", fine(result.seen_share)}};
  json["warnings"] = result.warnings;
  return json.dump(2) + "\n";
}

}  // namespace sateen::capture
