// SPDX-License-Identifier: MIT
// A decomposed MatCap whose look no texture varies over the surface: all of it (light, warp, both parts, silhouettes,
// decoding) is one table over the eye-frame normals (src/matcap/decomposed_appearance.cpp). Unlike a MatCap's own
// orthographic picture, the table's paraboloid does not run out of texels at the rim, where turned light shows.
// needs: surface.glsl

uniform sampler2D matcap_normals;  // linear, v up; at n.xy / (2 (1 + n.z)) + 1/2

vec3 matcap_by_normal(Surface s) {
  vec3 n = vec3(s.eye_normal.xy, max(s.eye_normal.z, 0.0));
  return s.occlusion * textureLod(matcap_normals, n.xy / (2.0 * (length(n) + n.z)) + 0.5, 0.0).rgb;
}
