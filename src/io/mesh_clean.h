// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/mesh.h"

namespace sateen::io {

/// Puts a mesh as a file has it in order: drops triangles without area and vertices that none uses; gives
/// zero normals their triangles' and tangents without a direction their neighbours'; makes tangents
/// orthogonal to the normals. With `join`, vertices equal in all they have become one.
void clean_mesh(Mesh& mesh, bool join);

}  // namespace sateen::io
