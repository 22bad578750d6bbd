// SPDX-License-Identifier: MIT
#include "sateen/capture/turning/mounting.h"

#include <cmath>

#include <fmt/format.h>

#include "sateen/capture/turning/used_frames.h"
#include "sateen/capture/turning/wobble.h"

namespace sateen::capture {

Rig find_rig(const std::vector<FrameNotes>& notes, const FirstLook& look, const Camera& camera,
             std::vector<CaptureFrame>& frames, std::vector<std::string>& warnings) {
  const double factor = look.factor;
  std::vector<Vec2> centres;
  std::vector<double> angles;
  Rig rig;
  const std::vector<std::size_t> indices = used_frames(frames);
  for (const std::size_t i : indices) {
    centres.push_back(notes[i].centre * factor);
    angles.push_back(frames[i].turned);
    rig.outline_support += notes[i].support / static_cast<double>(indices.size());
  }
  const Wobble wobble = fit_wobble(centres, angles);
  rig.wobble = std::sqrt((wobble.cosine.squaredNorm() + wobble.sine.squaredNorm()) / 2);
  rig.wobble_rms = wobble.rms;
  const double radius = look.outline.radius * factor;
  const bool circular = wobble.rms < 0.4 * factor;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].radius = radius;
    frames[i].centre =
        circular && frames[i].dropped.empty() ? wobble.at(frames[i].turned) : Vec2(notes[i].centre * factor);
  }
  rig.sphere = sphere_at(camera, wobble.middle, radius);
  if (!circular) {
    warnings.push_back(
        fmt::format("the sphere does not turn about a fixed axis (its picture strays by {:.1f} pixels from a "
                    "circle): the stand may have been touched. Each frame was measured alone",
                    wobble.rms));
  }
  if (rig.outline_support < 0.5) {
    warnings.push_back(
        fmt::format("only {:.0f} % of the outline stands out against the background: put something plain "
                    "behind the sphere",
                    100 * rig.outline_support));
  }
  return rig;
}

}  // namespace sateen::capture
