// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/capture/photographs/frame_source.h"
#include "sateen/capture/sphere/lens.h"
#include "sateen/capture/sphere/outline.h"
#include "sateen/core/progress.h"

namespace sateen::capture {

/// What a first look at a few frames finds: where the sphere is. In grey pixels.
struct FirstLook {
  int factor = 1;     ///< picture pixels per grey pixel
  Lens lens;          ///< of the photographs: as it was told, or what the outline tells of an assumed one
  Camera camera;      ///< of the grey pictures
  Scouting scouting;  ///< the sphere as the outline has it
  OutlineFit outline;
  Vec2 centre{0, 0};  ///< mean of the scouts' centres
  double reach = 0;   ///< farthest scout centre from it
};

/// Throws Error as find_sphere and fit_outlines do.
FirstLook first_look(FrameSource& source, const Lens& lens, const Progress& progress);

}  // namespace sateen::capture
