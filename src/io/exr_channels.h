// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace sateen::io {

/// The names of an EXR's channels, which the file has by the alphabet, in the order of a picture: layer by
/// layer (the part of a name before its last dot), in each R G B Y A Z, or R G B X Y Z A where a layer has X
/// and Y or Z, then the rest by the alphabet. As OpenImageIO orders them, so that files mean the same.
std::vector<std::string> in_picture_order(std::vector<std::string> names);

/// Whether a channel is alpha: "A" or "Alpha" behind the layer's name.
bool is_alpha_channel(const std::string& name);

}  // namespace sateen::io
