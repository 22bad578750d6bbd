// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace sateen::io {

/// Checks what a GLB or glTF claims before anyone asks for that much memory: chunks, buffers, views and
/// accessors lie inside one another, files beside it exist, and no extension is required that the reader
/// lacks. Throws Error saying what fails.
void check_gltf(const std::filesystem::path& path);

}  // namespace sateen::io
