// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/capture/table/stack.h"

namespace sateen::capture {

/// The direction (radians, counter-clockwise in the picture plane at angle 0, a line: modulo half a turn)
/// along which the visible threads run in the middle of the disc: across the strongest ripple of the light
/// there, as it turns with the body. False when no direction stands out.
bool weave_direction(const RectifiedStack& stack, double& direction);

}  // namespace sateen::capture
