// SPDX-License-Identifier: MIT
#include "sateen/capture/table/seams.h"

#include <fmt/format.h>

#include "sateen/capture/table/stack.h"
#include "sateen/core/error.h"
#include "sateen/io/image.h"

namespace sateen::capture {
namespace {

SurfaceMask painted_mask(const SeamOptions& options, const Camera& camera,
                         std::span<const CaptureFrame> frames, const Vec3& axis, int size) {
  const Image painting = io::read_data(options.mask);
  if (painting.width != camera.width || painting.height != camera.height) {
    throw Error(fmt::format("{}: is {} x {}, the frames are {} x {}", options.mask.string(), painting.width,
                            painting.height, camera.width, camera.height));
  }
  if (options.mask_frame < 0 || options.mask_frame >= static_cast<int>(frames.size())) {
    throw Error(fmt::format("the mask is said to be painted on frame {}, there are {}", options.mask_frame,
                            frames.size()));
  }
  const CaptureFrame& frame = frames[static_cast<std::size_t>(options.mask_frame)];
  return mask_from_painting(painting, camera, sphere_at(camera, frame.centre, frame.radius), axis,
                            frame.turned, size);
}

}  // namespace

Seams find_seams(const RectifiedStack& stack, const Camera& camera, std::span<const CaptureFrame> frames,
                 const SeamOptions& options) {
  Seams seams;
  if (!options.mask.empty()) seams.mask = painted_mask(options, camera, frames, stack.axis, stack.size);
  if (!options.find_blemishes) return seams;
  const SurfaceMask found = find_blemishes(stack, seams.mask);
  if (found.share > 0.4) {
    seams.uneven = found.share;
  } else {
    seams.mask = united(found, seams.mask);
  }
  return seams;
}

std::vector<std::string> advice(const Seams& seams) {
  if (seams.uneven == 0) return {};
  return {
      fmt::format("the surface is so uneven that {:.0f} % of it would count as seam; nothing was masked. "
                  "Paint a mask on one frame (--mask) if there is a seam",
                  100 * seams.uneven)};
}

}  // namespace sateen::capture
