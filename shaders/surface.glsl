// SPDX-License-Identifier: MIT
// What an appearance sees of a surface point; the same fields as Surface in src/core/appearance.h. View space: x right,
// y up, z towards the viewer; angles are in turns.

struct Surface {
  vec3 position;         // view space; the eye is at the origin under perspective
  vec3 normal;           // view space, unit
  vec3 mesh_normal;      // the same before any normal map
  vec3 tangent;          // view space, unit, orthogonal to the normal
  float side;            // 1 on the front; -1 on the back, whose normal is turned to the viewer
  float bitangent_sign;  // bitangent = bitangent_sign * cross(normal, tangent)
  vec3 view;             // view space, unit, from the point towards the eye
  vec3 eye_normal;       // the normal in the eye frame: its (x, y) indexes MatCap-like tables
  float tangent_angle;   // k in turns, [0, 1) or a period more
  vec2 uv;               // v up
  float occlusion;       // ambient occlusion, 1 is open
  float curvature;       // 1 / view-space unit, positive where convex
  int material;          // index of the mesh's material
};
