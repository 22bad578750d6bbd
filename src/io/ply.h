// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "sateen/core/mesh.h"

namespace sateen::io {

/// Reads a PLY file, text or binary of either byte order: positions, normals (nx, ny, nz), UVs (s, t; u, v;
/// texture_u, texture_v) of its vertices, polygons and strips. The triangles are as the file has them,
/// degenerate ones included. Our own and not assimp's: that one makes up the faces a truncated file lacks,
/// and takes four times as long. Throws Error when the header is broken, the file shorter than the header
/// says, or an index points outside the vertices.
Mesh read_ply(const std::filesystem::path& path);

}  // namespace sateen::io
