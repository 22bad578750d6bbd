// SPDX-License-Identifier: MIT
#include "sateen/capture/capture.h"

#include <fmt/format.h>

#include "sateen/capture/advice.h"
#include "sateen/capture/exposure/frame_light.h"
#include "sateen/capture/exposure/mirror_ball_shot.h"
#include "sateen/capture/measure.h"
#include "sateen/capture/part_of_progress.h"
#include "sateen/capture/sphere/choose_camera.h"
#include "sateen/capture/sphere/standing_still.h"
#include "sateen/capture/table/collect_stack.h"
#include "sateen/capture/table/make_table.h"
#include "sateen/capture/table/seams.h"
#include "sateen/capture/table/zero_angle.h"
#include "sateen/capture/turning/frame_angles.h"
#include "sateen/capture/turning/mounting.h"
#include "sateen/capture/turning/used_frames.h"
#include "sateen/core/direction.h"
#include "sateen/core/error.h"

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

/// One entry for each frame that could be read; a damaged video ends early.
std::vector<CaptureFrame> frames_of(const FrameSource& source, std::vector<FrameNotes>& notes) {
  while (!notes.empty() && !notes.back().read) notes.pop_back();
  check_count(notes.size());
  std::vector<CaptureFrame> frames(notes.size());
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i].file = source.name(static_cast<int>(i));
  return frames;
}

}  // namespace

CaptureResult build_capture(const std::vector<std::filesystem::path>& inputs, const CaptureOptions& options) {
  FrameSource source = FrameSource::open(inputs, options.source);
  check_count(static_cast<std::size_t>(source.count()));
  CaptureResult result;
  result.camera = choose_camera(source, options);

  const FirstLook look = first_look(source, result.camera, part_of(options.progress, 0, 0.1));
  if (look.focal) {
    result.focal = look.focal->scaled(look.factor);
    result.camera.focal = Vec2::Constant(result.focal->focal);
    if (result.focal->informed) result.camera.focal_source = kEstimatedFocal;
  }
  const StillMask still = find_stand(look, result.warnings);
  const Mat3 axes = eye_frame(-sphere_at(look.camera, look.centre, look.outline.radius).centre.normalized());
  std::vector<FrameNotes> notes =
      measure_frames(source, look, still, axes, part_of(options.progress, 0.1, 0.45));
  result.frames = frames_of(source, notes);

  drop_blurred(notes, result.frames);
  const FrameAngles turn = find_frame_angles(notes, axes, options, source.stride(), result.frames);
  result.axis = turn.axis;
  result.equal_steps = turn.equal_steps;
  result.turned = turn.turned;
  check_turn(result.frames, turn, options, result.warnings);
  const Rig rig = find_rig(notes, look, result.camera, result.frames, result.warnings);
  result.sphere = rig.sphere;
  result.wobble = rig.wobble;
  result.wobble_rms = rig.wobble_rms;
  result.outline_support = rig.outline_support;
  result.photometry = find_frame_light(notes, look, source.height(), result.frames, result.warnings);

  const RectifiedStack stack =
      collect_stack(source, look, still, options, part_of(options.progress, 0.5, 0.9), result);
  result.mask = find_seams(stack, options, result);
  const double first_angle = find_first_angle(stack, options, result);
  for (CaptureFrame& frame : result.frames) frame.angle = wrap(first_angle + frame.turned, 2 * kPi);
  make_table(stack, first_angle, options, result);
  report(options.progress, 1);
  if (!options.mirror_ball.empty()) result.environment = mirror_ball_shot(options, look, result.camera);
  append(result.warnings, dropped_advice(result.frames));
  append(result.warnings, framing_advice(result, options.size));
  append(result.warnings, source.warnings());
  return result;
}

}  // namespace sateen::capture
