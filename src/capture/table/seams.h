// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sateen/capture/sphere/camera.h"
#include "sateen/capture/table/frame.h"
#include "sateen/capture/table/surface_mask.h"

namespace sateen::capture {

struct RectifiedStack;

struct SeamOptions {
  std::filesystem::path mask;  ///< painted on one frame; empty: none
  int mask_frame = 0;
  bool find_blemishes = true;
};

/// What of the turning body shows no clean material.
struct Seams {
  SurfaceMask mask;
  double uneven = 0;  ///< share of the disc where blemishes were found: so much that none of them was masked
};

/// The painted mask, when there is one (throws Error when it does not fit the frames), and the blemishes
/// found without a hint.
Seams find_seams(const RectifiedStack& stack, const Camera& camera, std::span<const CaptureFrame> frames,
                 const SeamOptions& options);

/// What to do about blemishes that are too many to be seams, in plain words.
std::vector<std::string> advice(const Seams& seams);

}  // namespace sateen::capture
