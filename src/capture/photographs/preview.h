// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/capture/photographs/photograph.h"

namespace sateen::capture {

/// The photograph's light, scaled down by a whole factor to at most about 960 pixels across.
Image preview_of(const Photograph& frame);

}  // namespace sateen::capture
