// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sateen/amc/symmetry.h"
#include "sateen/amc/table.h"
#include "sateen/capture/sphere/sphere_view.h"

namespace sateen::capture {

struct RectifiedStack;
struct SurfaceMask;

struct TableOptions {
  int size = 128;    ///< S
  int slices = 128;  ///< S_k over one period
  amc::AmcEncoding encoding = amc::AmcEncoding::half;
  TableFrame frame = TableFrame::eye;
  std::optional<int> symmetry;                                 ///< R to enforce; otherwise detected
  double symmetry_threshold = amc::kDefaultSymmetryThreshold;  ///< dB
};

/// The table and how much of it was measured.
struct CaptureTable {
  amc::AmcTable amc;
  amc::SymmetryReport symmetry;
  double seen_share = 0;           ///< of table entries inside the disc that were measured, not filled
  std::vector<std::uint8_t> seen;  ///< AssembledSlices::seen
};

/// Finds the symmetry and assembles the table, whose tangent stands at `first_angle` (radians) at angle 0.
/// Its provenance is left to the caller.
CaptureTable make_table(const RectifiedStack& stack, const SurfaceMask& mask, double first_angle,
                        const TableOptions& options);

}  // namespace sateen::capture
