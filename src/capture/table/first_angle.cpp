// SPDX-License-Identifier: MIT
#include "sateen/capture/table/first_angle.h"

#include <fmt/format.h>

#include "sateen/capture/table/surface_mask.h"
#include "sateen/capture/table/weave.h"
#include "sateen/core/error.h"

namespace sateen::capture {
namespace {

double turned_of(std::span<const CaptureFrame> frames, int frame) {
  const auto count = static_cast<int>(frames.size());
  if (frame < 0 || frame >= count)
    throw Error(fmt::format("the thread is read off frame {}, there are {}", frame, count));
  return frames[static_cast<std::size_t>(frame)].turned;
}

double seam_direction(const SurfaceMask& mask) {
  double direction = 0;
  if (mask_direction(mask, direction)) return direction;
  throw Error(
      "no seam found to one side of the sphere's middle, so the tangent cannot be taken from it; paint it "
      "on one frame (--mask) or give --first-angle");
}

double threads_direction(const RectifiedStack& stack) {
  double direction = 0;
  if (weave_direction(stack, direction)) return direction;
  throw Error("no weave is visible to take the tangent from; give --first-angle or --thread-direction");
}

}  // namespace

FirstAngle find_first_angle(const RectifiedStack& stack, const SurfaceMask& mask,
                            std::span<const CaptureFrame> frames, const TangentOptions& options) {
  FirstAngle first{options.angle, options.from, options.given, 0};
  switch (options.from) {
    case ZeroAngle::first_frame:
      break;
    case ZeroAngle::thread:
      first.angle -= turned_of(frames, options.frame);
      break;
    case ZeroAngle::seam:
      first.found = seam_direction(mask);
      break;
    case ZeroAngle::weave:
      first.found = threads_direction(stack);
      break;
  }
  first.angle += first.found;
  return first;
}

std::string words(const FirstAngle& angle) {
  switch (angle.from) {
    case ZeroAngle::first_frame:
      break;
    case ZeroAngle::thread:
      return "thread direction read off a frame";
    case ZeroAngle::seam:
      return fmt::format("seam found at {:.1f} degrees in the first frame", degrees(angle.found));
    case ZeroAngle::weave:
      return fmt::format("weave found at {:.1f} degrees in the first frame", degrees(angle.found));
  }
  return angle.given ? "angle of the first frame given" : "not given: first frame is 0";
}

std::vector<std::string> advice(const FirstAngle& angle) {
  if (angle.from != ZeroAngle::first_frame || angle.given) return {};
  return {
      "the tangent's direction is unknown, so the first frame's was called 0 degrees. Give "
      "--first-angle, or --thread-direction read off a picture, or --tangent-from-seam when the cloth is "
      "sewn at a pole"};
}

}  // namespace sateen::capture
