// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "sateen/core/image.h"
#include "sateen/io/picture_source.h"

namespace sateen::io {

/// Whether the file says that its colours are other than Encoding::automatic takes them for.
bool says_other_colours(const PictureHeader& header);

/// Turns samples as stored (integers scaled to [0, 1], alpha not multiplied in) into linear Rec. 709 light by
/// what the file says: its ICC profile, its gamma, chromaticities and exposure. What cannot be used is a
/// warning, which calls the file `name`.
Image to_linear_rec709(Image stored, const PictureHeader& header, const std::string& name);

}  // namespace sateen::io
