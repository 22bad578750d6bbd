// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/capture/capture.h"

namespace sateen::capture {

/// Finds the symmetry and assembles the table, whose tangent stands at `first_angle` (radians) at angle 0.
/// Sets the result's table, symmetry and what of it was seen.
void make_table(const RectifiedStack& stack, double first_angle, const CaptureOptions& options,
                CaptureResult& result);

}  // namespace sateen::capture
