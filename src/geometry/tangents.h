// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/mesh.h"

namespace sateen::geometry {

/// Fills mesh.normals where the mesh has none: area-weighted over the vertices at the same position, so that
/// UV seams stay smooth; unit everywhere, a vertex without area gets +z.
void compute_normals(Mesh& mesh);

/// Fills mesh.tangents from the UV gradients (Magri et al., section 6): per-triangle gradient of u summed at
/// vertices, made orthogonal to the normal; w from the handedness of (u, v). Slivers and triangles without UV
/// area contribute nothing; a vertex that only they touch takes its neighbours' tangent, or some direction
/// across its normal: never zero. Throws Error when the mesh has no UVs.
void compute_tangents(Mesh& mesh);

/// Procedural fields for meshes without UVs, in object space: circles around an axis through `centre`, or the
/// axis projected to the surface. Where the field vanishes (on the axis, or facing it) the neighbours decide;
/// never zero.
void set_tangents_around(Mesh& mesh, const Vec3f& axis, const Vec3f& centre);
void set_tangents_along(Mesh& mesh, const Vec3f& axis);

/// Turns every tangent about its normal by `angle` radians, counter-clockwise seen from outside.
void rotate_tangents(Mesh& mesh, double angle);

}  // namespace sateen::geometry
