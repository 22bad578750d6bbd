// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace sateen {

/// Checks the sizes a PLY header claims against the length of the file, before anyone asks for that much
/// memory. Throws Error when the header is broken or the file is shorter than its elements need.
void check_ply(const std::filesystem::path& path);

/// The same for GLB and glTF: chunks, buffers, views and accessors lie inside one another, files beside it
/// exist, and no extension is required that the reader lacks. Throws Error saying which one fails.
void check_gltf(const std::filesystem::path& path);

}  // namespace sateen
