// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/image.h"

namespace sateen {

/// Replaces every texel whose centre lies outside the inscribed disc of a square picture of a sphere by the
/// colour of the nearest point of the rim, so that filtering at the rim never sees background. Texels inside
/// stay as they are.
void fill_from_rim(Image& picture);

}  // namespace sateen
