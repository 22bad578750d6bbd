// SPDX-License-Identifier: MIT
#include "sateen/capture/exposure/frame_light.h"

#include <fmt/format.h>

#include "sateen/capture/turning/used_frames.h"

namespace sateen::capture {

Photometry find_frame_light(std::vector<FrameNotes>& notes, const FirstLook& look, int height,
                            std::vector<CaptureFrame>& frames, std::vector<std::string>& warnings) {
  const std::vector<std::size_t> used = used_frames(frames);
  std::vector<std::vector<Vec3f>> samples;
  for (const std::size_t i : used) samples.push_back(std::move(notes[i].still));
  Photometry photometry = solve_photometry(samples, look.still, height);
  for (std::size_t k = 0; k < used.size(); ++k) frames[used[k]].gain = photometry.gain[k];
  if (!photometry.measured) {
    warnings.emplace_back(
        "too little of the picture stands still and is lit, so exposure drift was not removed. Leave some "
        "lit background around the sphere, or fix the camera's exposure");
  }
  if (photometry.drift > 0.15) {
    warnings.push_back(
        fmt::format("the exposure changes by up to {:.0f} %: the light flickers or the camera adapts. It was "
                    "removed; fix exposure and white balance for less noise",
                    100 * photometry.drift));
  }
  if (photometry.banding > 0.02) {
    warnings.push_back(fmt::format(
        "the upper and lower half of the picture flicker apart by {:.1f} %: a lamp pulses faster than the "
        "camera reads a frame. Use a flicker-free lamp or an exposure of a whole mains period (1/50 or "
        "1/60 s)",
        100 * photometry.banding));
  }
  return photometry;
}

}  // namespace sateen::capture
