// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "sateen/amc/table.h"

namespace sateen::amc {

/// Version of the conventions an AMC file follows; higher ones are refused.
inline constexpr int kAmcFileVersion = 1;

/// Writes a KTX2 3D texture (orientation "rui", Zstandard) whose key/value data carry sateen.kind = "amc",
/// sateen.version, sateen.symmetry, sateen.isotropic and one sateen.provenance.KEY for each provenance entry;
/// for a path without extension, or with a trailing slash, a folder of slices: slice_000.png (sRGB8) or .exr
/// (half), row 0 on top, and amc.json. Atomic for KTX2; a folder gets its amc.json last. Throws Error when it
/// cannot be written.
void write_amc(const std::filesystem::path& path, const AmcTable& table);

/// Reads what write_amc writes. Throws Error naming the file for anything else.
AmcTable read_amc(const std::filesystem::path& path);

}  // namespace sateen::amc
