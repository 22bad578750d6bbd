// SPDX-License-Identifier: MIT
// What an appearance knows of a surface point: one row a field. From these rows come the C++ and the GLSL
// struct, the vertex attributes and varyings, the packed pictures of a surface, the AOVs of `sateen render`
// and the inputs of `sateen shade` (surface.h, cmake/surface_fields.cmake, scene/surface_images.h). One more
// field is one more row, and the array in core/mesh.h if it comes from the mesh.
//
// SURFACE_FIELD(C++ type, GLSL type, name, AOV or "", input of `shade` or "", meaning, value where nothing is
// known...) SURFACE_VERTEX_FIELD(..., array of core/mesh.h between input and meaning): interpolated from the
// mesh's vertices. Include it as often as there are tables to make: each time it forgets both macros. Types:
// double/float, int, Vec2/vec2, Vec3/vec3, Vec4/vec4. One row a line: a script of CMake reads this file too.
// clang-format off
#ifndef SURFACE_FIELD
#define SURFACE_FIELD(...)
#endif
#ifndef SURFACE_VERTEX_FIELD
#define SURFACE_VERTEX_FIELD(type, glsl, name, aov, input, mesh_array, ...) SURFACE_FIELD(type, glsl, name, aov, input, __VA_ARGS__)
#endif
SURFACE_FIELD(double, float, coverage, "mask", "", "share of the point that is there, 1 unless the appearance says otherwise; 0 where nothing was drawn", 1)
SURFACE_FIELD(Vec3, vec3, position, "position", "positions", "view space; the eye is at the origin under perspective", 0, 0, 0)
SURFACE_FIELD(Vec3, vec3, normal, "normal", "normals", "view space, unit", 0, 0, 1)
SURFACE_FIELD(Vec3, vec3, mesh_normal, "mesh_normal", "mesh-normals", "the same before any normal map", 0, 0, 1)
SURFACE_FIELD(Vec3, vec3, tangent, "tangent", "tangents", "view space, unit, orthogonal to the normal", 1, 0, 0)
SURFACE_FIELD(double, float, bitangent_sign, "", "", "bitangent = bitangent_sign * cross(normal, tangent)", 1)
SURFACE_FIELD(double, float, side, "", "", "1 on the front; -1 on the back, whose normal is turned to the viewer", 1)
SURFACE_FIELD(Vec3, vec3, view, "", "", "view space, unit, from the point towards the eye", 0, 0, 1)
SURFACE_FIELD(Vec3, vec3, eye_normal, "", "", "the normal in the eye frame (core/direction.h): its (x, y) indexes MatCap-like tables", 0, 0, 1)
SURFACE_FIELD(double, float, tangent_angle, "k", "", "k in turns: angle of the eye-frame tangent in the picture plane, from 0 to 1 or a period more", 0)
SURFACE_VERTEX_FIELD(Vec2, vec2, uv, "uv", "uv", uvs, "texture coordinates, v up", 0, 0)
SURFACE_FIELD(Vec4, vec4, footprint, "footprint", "footprint", "change of u and v from one pixel to the next to the right (xy) and upwards (zw); 0: a point", 0, 0, 0, 0)
SURFACE_VERTEX_FIELD(double, float, occlusion, "occlusion", "occlusion", occlusion, "ambient occlusion, 1 is open", 1)
SURFACE_VERTEX_FIELD(double, float, curvature, "curvature", "curvature", curvature, "mean curvature, 1 / view-space unit, positive where convex", 0)
SURFACE_FIELD(Vec3, vec3, curvature_tensor, "curvature_tensor", "curvature-tensor", "second fundamental form in the frame (tangent, bitangent): tt, tb, bb; along a unit (a, b) the surface bends by a^2 tt + 2 a b tb + b^2 bb, in 1 / view-space unit, positive where convex", 0, 0, 0)
SURFACE_FIELD(int, int, material, "", "", "index of the mesh's material", 0)
#undef SURFACE_VERTEX_FIELD
#undef SURFACE_FIELD
