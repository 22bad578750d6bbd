// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/mesh.h"
#include "sateen/core/progress.h"

namespace sateen::geometry {

/// Fills mesh.occlusion: the cosine-weighted share of `rays` directions from each vertex that leave the mesh
/// without hitting it within `reach` (0: any distance). The same for any number of threads.
void compute_occlusion(Mesh& mesh, int rays = 128, double reach = 0, const Progress& progress = {});

}  // namespace sateen::geometry
