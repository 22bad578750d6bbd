// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace sateen::capture {

/// Why a frame is not used.
enum class Dropped {
  no,  ///< it is used
  blurred,
  no_angle,    ///< its turn cannot be found
  dark,        ///< much darker than the others
  same_angle,  ///< turned by next to nothing since the frame before
};

/// In words, for reports; empty for Dropped::no.
const char* words(Dropped dropped);

/// Places of the frames that are used, ascending.
std::vector<std::size_t> used_frames(std::span<const Dropped> dropped);

/// Per frame: those that have clearly less detail than the frames around them, or hardly any light. The light
/// is that of what stands still.
std::vector<Dropped> blurred_or_dark(std::span<const double> sharpness, std::span<const double> light);

/// `dropped` and the frames that turned by next to nothing since the one before. `turned`: radians.
std::vector<Dropped> without_repeated(std::vector<Dropped> dropped, std::span<const double> turned);

}  // namespace sateen::capture
