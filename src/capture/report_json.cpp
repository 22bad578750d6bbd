// SPDX-License-Identifier: MIT
#include <cmath>

#include <nlohmann/json.hpp>

#include "sateen/capture/advice.h"
#include "sateen/capture/report.h"
#include "sateen/io/json.h"

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
               {"used", frame.used()}};
    if (!frame.used()) entry["dropped"] = words(frame.dropped);
    json["frames"].push_back(std::move(entry));
  }
  const Camera& camera = result.lens.camera;
  const Mounting& mounting = result.mounting;
  const Turn& turn = result.turn;
  const amc::AmcTable& table = result.table.amc;
  const Vec2 centre = mounting.sphere.centre_pixel(camera);
  Vec2 outline(0, 0);
  for (int i = 0; i < 360; ++i) outline += mounting.sphere.outline_pixel(camera, radians(i)) / 360;
  const Vec2 pole = camera.project(mounting.sphere.centre + turn.axis);
  json["sphere"] = {{"center", {fine(centre.x()), fine(centre.y())}},
                    {"radius", fine(mounting.sphere.radius_pixel(camera))},
                    {"outline_center", {fine(outline.x()), fine(outline.y())}},
                    {"wobble_pixels", fine(mounting.wobble)},
                    {"wobble_residual_pixels", fine(mounting.wobble_rms)},
                    {"outline_seen", fine(mounting.outline_support)}};
  json["camera"] = {{"width", camera.width},
                    {"height", camera.height},
                    {"focal_pixels", {fine(camera.focal.x()), fine(camera.focal.y())}},
                    {"principal", {fine(camera.principal.x()), fine(camera.principal.y())}},
                    {"source", words(result.lens.source)}};
  if (result.lens.estimate) {
    const LensEffect effect = focal_effect(result);
    json["camera"]["focal_interval"] = {fine(result.lens.estimate->low), fine(result.lens.estimate->high)};
    json["camera"]["normals_off_degrees"] = fine(effect.normals);
    json["camera"]["tangents_off_degrees"] = fine(effect.tangents);
  }
  json["axis"] = {{"direction", {fine(turn.axis.x()), fine(turn.axis.y()), fine(turn.axis.z())}},
                  {"pole", {fine(pole.x()), fine(pole.y())}}};
  json["turn"] = {{"degrees", fine(degrees(turn.turned))},
                  {"direction", turn.turned >= 0 ? "counter-clockwise" : "clockwise"},
                  {"equal_steps", turn.equal_steps},
                  {"zero", words(result.first_angle)}};
  json["photometry"] = {{"corrected", result.photometry.measured},
                        {"drift", fine(result.photometry.drift)},
                        {"colour_drift", fine(result.photometry.colour_drift)},
                        {"banding", fine(result.photometry.banding)},
                        {"clipped", fine(result.clipping.share)}};
  json["symmetry"] = {{"R", table.symmetry}, {"isotropic", table.isotropic}};
  for (const amc::Similarity& similarity : result.table.symmetry.similarities) {
    json["symmetry"]["psnr_db"][std::to_string(similarity.turns)] = rounded(similarity.psnr, 0.01);
  }
  json["mask"] = {{"share", fine(result.seams.mask.share)}};
  json["table"] = {
      {"size", table.size}, {"slices", table.slices}, {"measured", fine(result.table.seen_share)}};
  json["warnings"] = result.warnings;
  return io::json_text(json, 2) + "\n";
}

}  // namespace sateen::capture
