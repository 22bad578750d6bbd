// SPDX-License-Identifier: MIT
#include "sateen/capture/turning/frame_angles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "sateen/capture/turning/angles.h"
#include "sateen/capture/turning/turning.h"
#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/core/median.h"

namespace sateen::capture {
namespace {

constexpr double kRegistrationNoise = radians(0.25);

/// The angles that need not be found, one for each of `indices`; empty when the pictures have to tell. Those
/// given are of all frames there are, of which every `stride`-th is used.
std::vector<double> known_angles(const std::vector<std::size_t>& indices, std::size_t frames,
                                 std::size_t stride, const TurnOptions& options) {
  std::vector<double> known;
  if (options.source == AngleSource::equal) {
    const double turn = (options.clockwise ? -1 : 1) * 2 * kPi;
    for (const std::size_t i : indices)
      known.push_back(turn * static_cast<double>(i) / static_cast<double>(frames));
  }
  if (options.source == AngleSource::given) {
    const std::size_t given = options.angles.size();
    if ((given + stride - 1) / stride != frames) {
      throw Error(fmt::format("{} angles are given for {} frames", given,
                              stride == 1
                                  ? fmt::format("{}", frames)
                                  : fmt::format("{} to {}", (frames - 1) * stride + 1, frames * stride)));
    }
    for (const std::size_t i : indices) known.push_back(options.angles[i * stride]);
  }
  return known;
}

void check_registration(const Turning& turning) {
  if (median(turning.confidence) >= 1.3 * turning.confidence_floor) return;
  throw Error(
      "the turning cannot be followed: the surface shows no detail (weave, grain, a seam) sharp enough. "
      "Stick a few small marks on it outside the part that counts, or say how it turned: --angles equal or "
      "--angles FILE");
}

/// Those of `dropped` and the frames, of which `indices` were registered, that turned out blurred or without
/// an angle.
std::vector<Dropped> without_unregistered(std::vector<Dropped> dropped, const Turning& turning,
                                          const std::vector<std::size_t>& indices) {
  for (std::size_t k = 0; k < indices.size(); ++k) {
    // Against the surface all frames share, blur shows even where noise hides it; the light changes this
    // slowly.
    const auto here = turning.strength.begin() + static_cast<std::ptrdiff_t>(k);
    const auto before = here - static_cast<std::ptrdiff_t>(std::min<std::size_t>(k, 4));
    const auto after = here + static_cast<std::ptrdiff_t>(std::min<std::size_t>(indices.size() - k, 5));
    if (turning.strength[k] < 0.55 * median(std::vector<double>(before, after)))
      dropped[indices[k]] = Dropped::blurred;
    if (turning.confidence[k] < turning.confidence_floor) dropped[indices[k]] = Dropped::no_angle;
  }
  return dropped;
}

/// Where the used frames turn in equal steps all frames do: the angles are made so, and none is unknown.
void recognise_equal_steps(FrameAngles& found) {
  std::vector<int> places;
  std::vector<double> angles;
  for (const std::size_t i : used_frames(found.dropped)) {
    places.push_back(static_cast<int>(i));
    angles.push_back(found.turned[i]);
  }
  const EqualSteps steps =
      equal_steps(places, angles, static_cast<int>(found.turned.size()), kRegistrationNoise);
  found.turn.equal_steps = steps.found;
  if (!steps.found) return;
  for (std::size_t i = 0; i < found.turned.size(); ++i) {
    found.turned[i] = steps.first + steps.step * static_cast<double>(i);
    if (found.dropped[i] == Dropped::no_angle) found.dropped[i] = Dropped::no;
  }
}

/// Angles count from the first frame that is used.
void count_from_first(FrameAngles& found) {
  const std::vector<std::size_t> used = used_frames(found.dropped);
  const double first = found.turned[used.front()];
  for (double& turned : found.turned) turned = wrap(turned - first, 2 * kPi);
  std::vector<double> turned;
  for (const std::size_t i : used) turned.push_back(found.turned[i]);
  found.turn.turned = unwrapped(turned).back();
}

/// Throws Error unless the used frames go all the way round.
void measure_gaps(FrameAngles& found, double period) {
  std::vector<double> angles;
  for (const std::size_t i : used_frames(found.dropped)) angles.push_back(found.turned[i]);
  if (angles.size() < static_cast<std::size_t>(kFewestCaptureFrames)) {
    throw Error(fmt::format(
        "only {} of {} frames can be used; the others are blurred, repeated or not to be registered",
        angles.size(), found.turned.size()));
  }
  const Coverage gaps = coverage(angles, period);
  const double even = period / static_cast<double>(angles.size());
  if (gaps.widest > std::max(radians(25), 3.5 * even)) {
    throw Error(fmt::format(
        "the turn is not complete: the frames cover {:.0f} of {:.0f} degrees and leave a gap of {:.0f}. "
        "Turn the sphere all the way round; if it did, its surface shows too little detail to follow: say "
        "how it turned with --angles",
        degrees(period - gaps.widest + gaps.median), degrees(period), degrees(gaps.widest)));
  }
  found.turn.widest_gap = gaps.widest;
  found.turn.even_gap = even;
}

}  // namespace

FrameAngles find_frame_angles(std::span<const SurfacePatch> patches, std::vector<Dropped> dropped,
                              const Mat3& axes, const TurnOptions& options, int stride, double period) {
  const std::size_t frames = dropped.size();
  const std::vector<std::size_t> indices = used_frames(dropped);
  if (indices.size() < static_cast<std::size_t>(kFewestCaptureFrames))
    throw Error(fmt::format("only {} of {} frames are sharp enough to be used", indices.size(), frames));
  const std::vector<double> known = known_angles(indices, frames, static_cast<std::size_t>(stride), options);
  const Turning turning = known.empty() ? find_turning(patches, axes) : find_axis(patches, axes, known);
  if (known.empty()) check_registration(turning);
  FrameAngles found;
  found.turn.axis = turning.axis;
  found.turn.contradiction = turning.contradiction;
  found.turn.known_off = turning.known_off;
  found.turn.reversed_off = turning.reversed_off;
  found.turned.assign(frames, 0);
  found.confidence.assign(frames, 0);
  for (std::size_t k = 0; k < indices.size(); ++k) {
    found.turned[indices[k]] = turning.angles[k];
    found.confidence[indices[k]] = turning.confidence[k];
  }
  found.dropped = std::move(dropped);
  if (known.empty()) {
    found.dropped = without_unregistered(std::move(found.dropped), turning, indices);
    recognise_equal_steps(found);
  } else {
    found.turn.equal_steps = options.source == AngleSource::equal;
  }
  found.dropped = without_repeated(std::move(found.dropped), found.turned);
  count_from_first(found);
  measure_gaps(found, period);
  return found;
}

}  // namespace sateen::capture
