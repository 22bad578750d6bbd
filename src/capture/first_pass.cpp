// SPDX-License-Identifier: MIT
#include "sateen/capture/first_pass.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include <tbb/enumerable_thread_specific.h>

namespace sateen::capture {
namespace {

constexpr int kLargestPatch = 192;

/// Where a frame shows the sphere, in grey pixels.
SeenOutline outline_in(const GreyPicture& grey, double gain, const FirstLook& look) {
  Vec2 centre = look.centre;
  double support = 0;
  for (const double reach : {look.reach + 4, 3.0}) {
    const OutlineOffset offset =
        measure_outline(grey, gain, look.outline.plate, look.camera,
                        sphere_at(look.camera, centre, look.outline.radius), reach, true);
    support = offset.support;
    if (offset.support > 0.25) centre += offset.shift;
  }
  return {centre, support};
}

}  // namespace

std::vector<FrameNotes> first_pass(FrameSource& source, const FirstLook& look, const StillMask& stand,
                                   const StillPoints& points, const Mat3& axes, const Progress& progress) {
  const double radius = look.outline.radius;
  const int patch_size = std::clamp(static_cast<int>(2 * radius * kPatchReach) / 2 * 2, 48, kLargestPatch);
  const double margin = radius * 1.05 + look.reach + 12;
  const GreyRegion region{
      static_cast<int>(look.centre.x() - margin), static_cast<int>(look.centre.y() - margin),
      static_cast<int>(look.centre.x() + margin) + 1, static_cast<int>(look.centre.y() + margin) + 1};
  const PatchMap patches(look.camera, sphere_at(look.camera, look.centre, radius), axes, patch_size, stand);
  std::vector<FrameNotes> notes(static_cast<std::size_t>(source.count()));
  std::vector<int> indices(notes.size());
  std::iota(indices.begin(), indices.end(), 0);
  std::atomic<int> done = 0;
  tbb::enumerable_thread_specific<GreyPicture> greys;
  source.visit(indices, [&](int index, const Photograph& frame) {
    FrameNotes& note = notes[static_cast<std::size_t>(index)];
    GreyPicture& grey = greys.local();
    grey_picture(frame, look.factor, region, grey);
    note.still = sample_still_points(points, frame);
    note.outline = outline_in(grey, code_gain(points, note.still), look);
    note.patch = patches.patch(grey, note.outline.centre);
    note.outline.centre *= look.factor;
    note.read = true;
    report(progress, static_cast<double>(++done) / static_cast<double>(indices.size()));
  });
  while (!notes.empty() && !notes.back().read) notes.pop_back();
  return notes;
}

}  // namespace sateen::capture
