// SPDX-License-Identifier: MIT
#include "sateen/capture/turning/mounting.h"

#include <cmath>

#include <fmt/format.h>

#include "sateen/capture/sphere/first_look.h"
#include "sateen/capture/turning/frame_angles.h"
#include "sateen/capture/turning/wobble.h"

namespace sateen::capture {

FrameCentres find_mounting(const std::vector<SeenOutline>& seen, const FirstLook& look,
                           const FrameAngles& angles) {
  FrameCentres found;
  Mounting& mounting = found.mounting;
  std::vector<Vec2> centres;
  std::vector<double> turned;
  const std::vector<std::size_t> used = used_frames(angles.dropped);
  for (const std::size_t i : used) {
    centres.push_back(seen[i].centre);
    turned.push_back(angles.turned[i]);
    mounting.outline_support += seen[i].support / static_cast<double>(used.size());
  }
  const Wobble wobble = fit_wobble(centres, turned);
  mounting.wobble = std::sqrt((wobble.cosine.squaredNorm() + wobble.sine.squaredNorm()) / 2);
  mounting.wobble_rms = wobble.rms;
  mounting.strays = wobble.rms >= 0.4 * look.factor;
  mounting.radius = look.outline.radius * look.factor;
  mounting.sphere = sphere_at(look.lens.camera, wobble.middle, mounting.radius);
  for (const SeenOutline& outline : seen) found.centres.push_back(outline.centre);
  if (mounting.strays) return found;
  for (const std::size_t i : used) found.centres[i] = wobble.at(angles.turned[i]);
  return found;
}

std::vector<std::string> advice(const Mounting& mounting) {
  std::vector<std::string> warnings;
  if (mounting.strays) {
    warnings.push_back(
        fmt::format("the sphere does not turn about a fixed axis (its picture strays by {:.1f} pixels from a "
                    "circle): the stand may have been touched. Each frame was measured alone",
                    mounting.wobble_rms));
  }
  if (mounting.outline_support < 0.5) {
    warnings.push_back(
        fmt::format("only {:.0f} % of the outline stands out against the background: put something plain "
                    "behind the sphere",
                    100 * mounting.outline_support));
  }
  return warnings;
}

}  // namespace sateen::capture
