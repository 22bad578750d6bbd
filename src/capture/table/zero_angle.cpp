// SPDX-License-Identifier: MIT
#include "sateen/capture/table/zero_angle.h"

#include <fmt/format.h>

#include "sateen/capture/table/weave.h"
#include "sateen/core/error.h"

namespace sateen::capture {
namespace {

double turned_of(const CaptureResult& result, int frame) {
  const auto count = static_cast<int>(result.frames.size());
  if (frame < 0 || frame >= count)
    throw Error(fmt::format("the thread is read off frame {}, there are {}", frame, count));
  return result.frames[static_cast<std::size_t>(frame)].turned;
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

double find_first_angle(const RectifiedStack& stack, const CaptureOptions& options, CaptureResult& result) {
  switch (options.zero) {
    case ZeroAngle::first_frame:
      break;
    case ZeroAngle::thread:
      result.zero_source = "thread direction read off a frame";
      return options.zero_angle - turned_of(result, options.zero_frame);
    case ZeroAngle::seam: {
      const double direction = seam_direction(result.mask);
      result.zero_source = fmt::format("seam found at {:.1f} degrees in the first frame", degrees(direction));
      return options.zero_angle + direction;
    }
    case ZeroAngle::weave: {
      const double direction = threads_direction(stack);
      result.zero_source =
          fmt::format("weave found at {:.1f} degrees in the first frame", degrees(direction));
      return options.zero_angle + direction;
    }
  }
  result.zero_source = "angle of the first frame given";
  if (!options.zero_given) {
    result.zero_source = "not given: first frame is 0";
    result.warnings.emplace_back(
        "the tangent's direction is unknown, so the first frame's was called 0 degrees. Give "
        "--first-angle, or --thread-direction read off a picture, or --tangent-from-seam when the cloth is "
        "sewn at a pole");
  }
  return options.zero_angle;
}

}  // namespace sateen::capture
