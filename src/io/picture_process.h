// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "sateen/io/picture_source.h"

namespace sateen::io {

// Pictures of kinds that the library itself does not read are decoded by OpenImageIO in a process of their
// own, the program sateen-read-picture beside the modules: its memory and time are bounded, and a decoder
// that a file breaks breaks nothing here.

/// What that program writes to its standard output before `icc_bytes` of a profile and the rows.
struct PictureStart {
  char version[16] = SATEEN_VERSION;
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::int32_t channels = 0;
  std::int32_t samples = 0;  ///< SampleType
  std::int32_t bits = 0;
  std::int32_t floating = 0;
  std::int32_t alpha = 0;
  std::int32_t associated = 0;
  std::int32_t orientation = 0;
  std::int32_t window[4] = {};
  std::uint32_t icc_bytes = 0;
};

/// Where it writes what is wrong, in place of all that.
inline constexpr int kMessageFile = 3;
/// The most memory it may ask for, and its processor time.
inline constexpr std::uint64_t kMostAddresses = std::uint64_t{8} << 30;
inline constexpr std::uint64_t kMostSeconds = 120;

/// The kind is told by the file's first bytes or, for those that have no mark, by its extension; no other
/// decoder gets to see it. Throws Error naming the file when it is of no known kind, when its decoder refuses
/// it, or the program is missing.
std::unique_ptr<PictureSource> open_with_openimageio(const std::filesystem::path& path);

}  // namespace sateen::io
