// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "sateen/matcap/decomposition.h"

namespace sateen::matcap {

inline constexpr int kMatcapFileVersion = 1;

/// The KTX2 file of a decomposed MatCap: a 2D array of four half-float layers, low front, low back, high
/// front, high back (sphere_map.h), row 0 where v is 0 ("KTXorientation" "ru"), with the prefiltered levels
/// as mip levels. Metadata: "sateen.kind" is "matcap-decomposition", "sateen.version" the version of these
/// conventions, "sateen.matcap" the parameters as JSON, see matcap_json.
void write_matcap(const std::filesystem::path& path, const MatcapDecomposition& matcap);

/// Throws Error naming the file when it is no decomposed MatCap, follows a newer version, or its parameters
/// or texels make no sense.
MatcapDecomposition read_matcap(const std::filesystem::path& path);

/// The same without maps and kept pixels, from the file's first bytes.
MatcapDecomposition read_matcap_parameters(const std::filesystem::path& path);

/// The parameters as JSON text: space, width, height, disc {x, y, radius}, map_size, low and high {variance,
/// slope, measured, feature, regions, base_color, map_variances}, provenance.
std::string matcap_json(const MatcapDecomposition& matcap);

/// "sateen.kind" of such files.
inline constexpr const char* kMatcapKind = "matcap-decomposition";

}  // namespace sateen::matcap
