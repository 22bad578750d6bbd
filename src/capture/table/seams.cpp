// SPDX-License-Identifier: MIT
#include "sateen/capture/table/seams.h"

#include <fmt/format.h>

#include "sateen/core/error.h"
#include "sateen/io/image.h"

namespace sateen::capture {
namespace {

SurfaceMask painted_mask(const CaptureOptions& options, const CaptureResult& result) {
  const Image painting = io::read_data(options.mask);
  if (painting.width != result.camera.width || painting.height != result.camera.height) {
    throw Error(fmt::format("{}: is {} x {}, the frames are {} x {}", options.mask.string(), painting.width,
                            painting.height, result.camera.width, result.camera.height));
  }
  if (options.mask_frame < 0 || options.mask_frame >= static_cast<int>(result.frames.size())) {
    throw Error(fmt::format("the mask is said to be painted on frame {}, there are {}", options.mask_frame,
                            result.frames.size()));
  }
  const CaptureFrame& frame = result.frames[static_cast<std::size_t>(options.mask_frame)];
  return mask_from_painting(painting, result.camera, sphere_at(result.camera, frame.centre, frame.radius),
                            result.axis, frame.turned, options.size);
}

}  // namespace

SurfaceMask find_seams(const RectifiedStack& stack, const CaptureOptions& options, CaptureResult& result) {
  SurfaceMask painted;
  if (!options.mask.empty()) painted = painted_mask(options, result);
  if (!options.find_blemishes) return painted;
  const SurfaceMask found = find_blemishes(stack, painted);
  if (found.share > 0.4) {
    result.warnings.push_back(
        fmt::format("the surface is so uneven that {:.0f} % of it would count as seam; nothing was masked. "
                    "Paint a mask on one frame (--mask) if there is a seam",
                    100 * found.share));
    return painted;
  }
  return united(found, painted);
}

}  // namespace sateen::capture
