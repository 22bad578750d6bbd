// SPDX-License-Identifier: MIT
#pragma once

#include "capture/simulator.h"
#include "sateen/capture/capture.h"

namespace sateen::test {

/// How far what a capture found is from the simulation's truth.
struct CaptureErrors {
  double centre = 0;       // rms, pixels
  double radius = 0;       // pixels
  double axis = 0;         // pixels at the sphere's surface
  double angle = 0;        // rms, degrees, up to a constant
  double exposure = 0;     // worst of the frames, share, up to a constant
  double table = 0;        // dB, seen texels
  double seam_recall = 0;  // of the seam's texels inside 0.95 of the disc
  double seam_precision = 0;
};
CaptureErrors judge(const capture::CaptureResult& result, const Simulation& truth);

/// Options under which the simulation's first angle is known and, if `lens`, its focal length.
capture::CaptureOptions informed_options(const Simulation& truth, bool lens = true);

/// The same for a table of 48 x 48 x 24, which small_simulation is sharp enough for.
capture::CaptureOptions small_options(const Simulation& truth);

/// The capture of the simulation's pictures.
capture::CaptureResult capture_of(const Simulation& simulation, const capture::CaptureOptions& options);

}  // namespace sateen::test
