// SPDX-License-Identifier: MIT
#include "sateen/capture/turning/frame_angles.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sateen/capture/turning/angles.h"
#include "sateen/capture/turning/used_frames.h"
#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/core/median.h"

namespace sateen::capture {
namespace {

constexpr double kRegistrationNoise = radians(0.25);
constexpr double kDoubtful = radians(0.6);  // above it is no registration noise
constexpr double kWrong = radians(10);      // above it known angles are not those of the pictures
constexpr const char* kNoAngle = "its angle cannot be found";

/// The angles that need not be found, one for each of `indices`; empty when the pictures have to tell. Those
/// given are of all frames there are, of which every `stride`-th is used.
std::vector<double> known_angles(const std::vector<std::size_t>& indices, std::size_t frames,
                                 std::size_t stride, const CaptureOptions& options) {
  std::vector<double> known;
  if (options.angle_source == AngleSource::equal) {
    const double turn = (options.clockwise ? -1 : 1) * 2 * kPi;
    for (const std::size_t i : indices)
      known.push_back(turn * static_cast<double>(i) / static_cast<double>(frames));
  }
  if (options.angle_source == AngleSource::given) {
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

void drop_unregistered(const Turning& turning, const std::vector<std::size_t>& indices,
                       std::vector<CaptureFrame>& frames) {
  for (std::size_t k = 0; k < indices.size(); ++k) {
    CaptureFrame& frame = frames[indices[k]];
    // Against the surface all frames share, blur shows even where noise hides it; the light changes this
    // slowly.
    const auto here = turning.strength.begin() + static_cast<std::ptrdiff_t>(k);
    const auto before = here - static_cast<std::ptrdiff_t>(std::min<std::size_t>(k, 4));
    const auto after = here + static_cast<std::ptrdiff_t>(std::min<std::size_t>(indices.size() - k, 5));
    if (turning.strength[k] < 0.55 * median(std::vector<double>(before, after))) frame.dropped = "blurred";
    if (turning.confidence[k] < turning.confidence_floor) frame.dropped = kNoAngle;
  }
}

bool recognise_equal_steps(std::vector<CaptureFrame>& frames) {
  std::vector<int> places;
  std::vector<double> angles;
  for (const std::size_t i : used_frames(frames)) {
    places.push_back(static_cast<int>(i));
    angles.push_back(frames[i].turned);
  }
  const EqualSteps steps = equal_steps(places, angles, static_cast<int>(frames.size()), kRegistrationNoise);
  if (!steps.found) return false;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].turned = steps.first + steps.step * static_cast<double>(i);
    if (frames[i].dropped == kNoAngle) frames[i].dropped.clear();
  }
  return true;
}

}  // namespace

FrameAngles find_frame_angles(std::vector<FrameNotes>& notes, const Mat3& axes, const CaptureOptions& options,
                              int stride, std::vector<CaptureFrame>& frames) {
  const std::vector<std::size_t> indices = used_frames(frames);
  if (indices.size() < static_cast<std::size_t>(kFewestCaptureFrames)) {
    throw Error(
        fmt::format("only {} of {} frames are sharp enough to be used", indices.size(), frames.size()));
  }
  std::vector<SurfacePatch> patches;
  for (const std::size_t i : indices) patches.push_back(std::move(notes[i].patch));
  const std::vector<double> known =
      known_angles(indices, frames.size(), static_cast<std::size_t>(stride), options);
  const Turning turning =
      known.empty() ? find_turning(patches, axes) : find_axis(patches, axes, known, false);
  if (known.empty()) check_registration(turning);
  for (std::size_t k = 0; k < indices.size(); ++k) {
    frames[indices[k]].turned = turning.angles[k];
    frames[indices[k]].confidence = turning.confidence[k];
  }
  FrameAngles found;
  found.axis = turning.axis;
  found.contradiction = turning.contradiction;
  found.known_off = turning.known_off;
  found.reversed_off = turning.reversed_off;
  if (known.empty()) {
    drop_unregistered(turning, indices, frames);
    found.equal_steps = recognise_equal_steps(frames);
  } else {
    found.equal_steps = options.angle_source == AngleSource::equal;
  }
  drop_duplicates(frames);
  // Angles count from the first frame that is used.
  const std::vector<std::size_t> used = used_frames(frames);
  const double first = frames[used.front()].turned;
  for (CaptureFrame& frame : frames) frame.turned = wrap(frame.turned - first, 2 * kPi);
  std::vector<double> turned;
  for (const std::size_t i : used) turned.push_back(frames[i].turned);
  found.turned = unwrapped(turned).back();
  return found;
}

void check_turn(const std::vector<CaptureFrame>& frames, const FrameAngles& turn,
                const CaptureOptions& options, std::vector<std::string>& warnings) {
  std::vector<double> angles;
  for (const std::size_t i : used_frames(frames)) angles.push_back(frames[i].turned);
  if (angles.size() < static_cast<std::size_t>(kFewestCaptureFrames)) {
    throw Error(fmt::format(
        "only {} of {} frames can be used; the others are blurred, repeated or not to be registered",
        angles.size(), frames.size()));
  }
  const double period = 2 * kPi / options.symmetry.value_or(1);
  const Coverage found = coverage(angles, period);
  const double even = period / static_cast<double>(angles.size());
  if (found.widest > std::max(radians(25), 3.5 * even)) {
    throw Error(fmt::format(
        "the turn is not complete: the frames cover {:.0f} of {:.0f} degrees and leave a gap of {:.0f}. "
        "Turn the sphere all the way round; if it did, its surface shows too little detail to follow: say "
        "how it turned with --angles",
        degrees(period - found.widest + found.median), degrees(period), degrees(found.widest)));
  }
  if (found.widest > std::max(radians(10), 2.5 * even)) {
    warnings.push_back(fmt::format(
        "between two frames the sphere turned by {:.0f} degrees: the material is interpolated there. Turn "
        "it more evenly",
        degrees(found.widest)));
  }
  if (turn.known_off > kWrong) {
    const bool reversed = turn.reversed_off < kWrong;
    warnings.push_back(
        reversed
            ? std::string(
                  "in the pictures the sphere turns the other way than the angles given: the table is "
                  "wrong. Swap --direction (of a live capture: --reverse), or find the angles with "
                  "--angles pictures")
            : fmt::format("the angles given are not those of the pictures, which differ from them by {:.0f} "
                          "degrees (median): the table is wrong. Check --angles, or find them with --angles "
                          "pictures",
                          degrees(turn.known_off)));
  } else if (turn.contradiction > kDoubtful) {
    warnings.push_back(fmt::format(
        "the frames' angles are doubtful: parts of the sphere contradict them by {:.1f} degrees. The axis "
        "may "
        "be tilted too far, the surface may move on the sphere or show too little detail. Point the axis at "
        "the lens, or give the stage's angles (--angles)",
        degrees(turn.contradiction)));
  }
}

}  // namespace sateen::capture
