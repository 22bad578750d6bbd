// SPDX-License-Identifier: MIT
// The diffuse layer at the bottom of layered and mapped materials (src/brdf/diffuse_base.h): Lambert, or the fibres of Hast
// et al.
// needs: environment.glsl fibre_diffuse.glsl shading_frame.glsl

#ifndef DIFFUSE_FIBRES
#define DIFFUSE_FIBRES true
#endif

uniform vec3 base_color;
uniform vec3 base_bands[3];  // Legendre coefficients of what the layer receives, under the fuzz if there is one
uniform vec2 base_lobe;      // the fibres' light is (|l across the fibre| + x n.l) y
uniform vec3 base_moments;   // of that over the hemisphere: xx, yy, zz
uniform float base_moment_z;
uniform vec2 base_axis;      // cosine and sine of the fibres' azimuth

// `light` in the shading frame, above the horizon.
vec3 diffuse_lit(vec3 light) {
  return base_color * (DIFFUSE_FIBRES ? fibre_lobe(turned(light, base_axis), base_lobe) : light.z * 0.3183098861837907);
}

// The light of the surroundings on a flat white Lambert surface; `bands` as base_bands.
vec3 received(vec3 normal, mat3 bands) {
  return environment_harmonics[0] * bands[0] + harmonics_linear(normal) * bands[1] + harmonics_quadratic(normal) * bands[2];
}

vec3 diffuse_surroundings(mat3 frame, mat3 bands) {
  if (!DIFFUSE_FIBRES) return base_color * received(frame[2], bands);
  vec3 fibre = frame * vec3(base_axis, 0.0);
  vec3 across = frame * vec3(-base_axis.y, base_axis.x, 0.0);
  return base_color * bands[0] *
         (environment_harmonics[0] + harmonics_linear(frame[2]) * base_moment_z + harmonics_quadratic(fibre) * base_moments.x +
          harmonics_quadratic(across) * base_moments.y + harmonics_quadratic(frame[2]) * base_moments.z);
}
