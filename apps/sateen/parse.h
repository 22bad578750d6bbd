// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "sateen/core/vector.h"

namespace sateen::cli {

// What users write in options, as values. All throw CLI::ValidationError (exit code 2) with what would be
// right.

/// "1024x768", or one number for a square picture; 1 to 65536.
std::pair<int, int> parse_size(const std::string& option, const std::string& text);

/// "I/N": the I-th of N, from 1.
std::pair<int, int> parse_shard(const std::string& option, const std::string& text);

/// "X,Y,Z", three numbers.
Vec3 parse_vector(const std::string& option, const std::string& text);

/// "x", "y", "z" or "X,Y,Z", not zero.
Vec3 parse_axis(const std::string& option, const std::string& text);

/// "transparent" (nothing), "R,G,B" in linear light, or "#rrggbb" in sRGB; linear light.
std::optional<Vec3f> parse_background(const std::string& option, const std::string& text);

}  // namespace sateen::cli
