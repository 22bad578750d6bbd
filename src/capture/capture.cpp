// SPDX-License-Identifier: MIT
#include "sateen/capture/capture.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "sateen/capture/advice.h"
#include "sateen/capture/exposure/still_points.h"
#include "sateen/capture/first_pass.h"
#include "sateen/capture/photographs/preview.h"
#include "sateen/capture/sphere/choose_lens.h"
#include "sateen/capture/sphere/first_look.h"
#include "sateen/capture/sphere/stand.h"
#include "sateen/capture/table/collect_stack.h"
#include "sateen/capture/turning/frame_angles.h"
#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/core/median.h"

namespace sateen::capture {
namespace {

void check_count(std::size_t frames) {
  if (frames >= static_cast<std::size_t>(kFewestCaptureFrames)) return;
  throw Error(fmt::format("only {} frames given; a turn needs at least {}, better 64 or more", frames,
                          kFewestCaptureFrames));
}

void append(std::vector<std::string>& all, const std::vector<std::string>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// The part of `whole` from one fraction to another.
Progress part_of(const Progress& whole, double from, double to) {
  if (!whole) return {};
  return [whole, from, to](double fraction) { whole(from + (to - from) * fraction); };
}

/// One value of each frame's notes.
template <typename Value>
auto each_of(const std::vector<FrameNotes>& notes, const Value& value) {
  std::vector<decltype(value(notes.front()))> values;
  values.reserve(notes.size());
  for (const FrameNotes& note : notes) values.push_back(value(note));
  return values;
}

/// A part of the frames' notes that is wanted of the used ones only, taken out for its memory's sake.
template <typename Part>
std::vector<Part> taken(std::vector<FrameNotes>& notes, const std::vector<std::size_t>& used,
                        Part FrameNotes::*part) {
  std::vector<Part> parts;
  parts.reserve(used.size());
  for (const std::size_t i : used) parts.push_back(std::move(notes[i].*part));
  return parts;
}

/// All that is known of each frame but its angle in the table. `sharpness` as in the notes, `photometry` of
/// the used frames.
std::vector<CaptureFrame> frames_of(const FrameSource& source, const std::vector<double>& sharpness,
                                    const FrameAngles& angles, const FrameCentres& places,
                                    const Photometry& photometry) {
  const double typical = std::max(1e-9, median(sharpness));
  std::vector<CaptureFrame> frames(sharpness.size());
  auto gain = photometry.gain.begin();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    CaptureFrame& frame = frames[i];
    frame.file = source.name(static_cast<int>(i));
    frame.turned = angles.turned[i];
    frame.centre = places.centres[i];
    frame.radius = places.mounting.radius;
    frame.sharpness = sharpness[i] / typical;
    frame.confidence = angles.confidence[i];
    frame.dropped = angles.dropped[i];
    if (frame.used()) frame.gain = *gain++;
  }
  return frames;
}

/// Where each texel of the table is seen.
RectifyMap rectify_map(const FirstLook& look, const StillMask& stand, const SphereView& sphere,
                       const TableOptions& options) {
  // A bright background shines in further than a pixel: the lens blurs, JPEG rings.
  const double rim = 2.5 * look.factor;
  RectifyMap map(look.lens.camera, sphere, options.size, options.frame, rim);
  map.hide(stand);
  return map;
}

/// What the table's file says of where it comes from.
std::map<std::string, std::string> provenance_of(const CaptureResult& result, TableFrame frame) {
  const auto used = std::ranges::count_if(result.frames, &CaptureFrame::used);
  return {
      {"source", "capture"},
      {"frames", fmt::format("{} of {}", used, result.frames.size())},
      {"first_angle_degrees", fmt::format("{:.3f}", degrees(wrap(result.first_angle.angle, 2 * kPi)))},
      {"focal_pixels", fmt::format("{:.2f} ({})", result.lens.camera.focal.x(), words(result.lens.source))},
      {"table_frame", frame == TableFrame::eye ? "eye" : "view"},
  };
}

}  // namespace

CaptureResult build_capture(const std::vector<std::filesystem::path>& inputs, const CaptureOptions& options) {
  FrameSource source = FrameSource::open(inputs, options.source);
  check_count(static_cast<std::size_t>(source.count()));
  const FirstLook look =
      first_look(source, choose_lens(source, options.lens), part_of(options.progress, 0, 0.1));
  const StandInFront stand = find_stand(look);
  const StillPoints points = still_points(look);
  const Mat3 axes = eye_frame(-sphere_at(look.camera, look.centre, look.outline.radius).centre.normalized());
  std::vector<FrameNotes> notes =
      first_pass(source, look, stand.mask, points, axes, part_of(options.progress, 0.1, 0.45));
  check_count(notes.size());

  const auto sharpness = each_of(notes, [](const FrameNotes& note) { return note.patch.sharpness; });
  const auto light = each_of(notes, [](const FrameNotes& note) { return mean_light(note.still); });
  const std::vector<Dropped> bad = blurred_or_dark(sharpness, light);
  const FrameAngles angles =
      find_frame_angles(taken(notes, used_frames(bad), &FrameNotes::patch), bad, axes, options.turn,
                        source.stride(), 2 * kPi / options.table.symmetry.value_or(1));
  const FrameCentres places =
      find_mounting(each_of(notes, [](const FrameNotes& note) { return note.outline; }), look, angles);

  CaptureResult result;
  result.lens = look.lens;
  result.turn = angles.turn;
  result.mounting = places.mounting;
  const std::vector<std::size_t> used = used_frames(angles.dropped);
  result.photometry =
      solve_photometry(taken(notes, used, &FrameNotes::still), points.pixels, source.height());
  result.frames = frames_of(source, sharpness, angles, places, result.photometry);
  result.preview_frame = static_cast<int>(used.front());
  result.preview = preview_of(source.read(result.preview_frame));

  const RectifyMap map = rectify_map(look, stand.mask, result.mounting.sphere, options.table);
  const RectifiedStack stack =
      collect_stack(source, map, result.frames, result.turn.axis, part_of(options.progress, 0.5, 0.9));
  result.clipping = count_clipped(stack);
  result.seams = find_seams(stack, result.lens.camera, result.frames, options.seams);
  result.first_angle = find_first_angle(stack, result.seams.mask, result.frames, options.tangent);
  for (CaptureFrame& frame : result.frames)
    frame.angle = wrap(result.first_angle.angle + frame.turned, 2 * kPi);
  result.table = make_table(stack, result.seams.mask, result.first_angle.angle, options.table);
  result.table.amc.provenance = provenance_of(result, options.table.frame);
  report(options.progress, 1);
  if (!options.mirror_ball.picture.empty())
    result.environment = mirror_ball_shot(options.mirror_ball, options.source, look);

  append(result.warnings, advice(stand));
  append(result.warnings, advice(result));
  append(result.warnings, source.warnings());
  return result;
}

}  // namespace sateen::capture
