// SPDX-License-Identifier: MIT
// One colour from every side: for silhouettes, and the base line of benchmarks.
// needs: surface.glsl

uniform vec3 constant_color;  // linear

vec3 constant_appearance(Surface s) {
  return s.occlusion * constant_color;
}
