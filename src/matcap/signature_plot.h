// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "sateen/matcap/filter_estimate.h"

namespace sateen::matcap {

/// A curve of the plot and what to call it.
struct LabelledEstimate {
  std::string label;
  FilterEstimate estimate;
};

/// Signatures as in Figure 4, as SVG text: variance over window size, both logarithmic, the chosen window
/// marked.
std::string signature_svg(std::span<const LabelledEstimate> curves);

}  // namespace sateen::matcap
