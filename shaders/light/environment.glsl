// SPDX-License-Identifier: MIT
// Light of the surroundings (src/light): spherical harmonics as polynomials, Ramamoorthi and Hanrahan 2001, and a
// latitude-longitude map prefiltered with GGX, Karis 2013.

uniform vec3 environment_harmonics[9];  // 1, y, z, x, xy, yz, 3z^2-1, xz, x^2-y^2
uniform sampler2D environment_map;      // level i of n: perceptual roughness i / (n - 1); u repeats, v up
uniform float environment_last_level;   // n - 1
uniform bool environment_present;       // without a map there are the harmonics alone
uniform mat3 environment_from_view;     // the map's turn; the harmonics are in view space

vec3 harmonics_linear(vec3 d) {
  return environment_harmonics[1] * d.y + environment_harmonics[2] * d.z + environment_harmonics[3] * d.x;
}

// As |d|^2 times the value along d.
vec3 harmonics_quadratic(vec3 d) {
  return environment_harmonics[4] * (d.x * d.y) + environment_harmonics[5] * (d.y * d.z) +
         environment_harmonics[6] * (3.0 * d.z * d.z - dot(d, d)) + environment_harmonics[7] * (d.x * d.z) +
         environment_harmonics[8] * (d.x * d.x - d.y * d.y);
}

// The light convolved with a lobe about the unit d of Legendre coefficients w.
vec3 harmonics_lobe(vec3 d, vec3 w) {
  return environment_harmonics[0] * w.x + harmonics_linear(d) * w.y + harmonics_quadratic(d) * w.z;
}

// The light convolved with a lobe of mean direction d, |d| <= 1, whose Legendre coefficients fall like those of a Gaussian
// on the sphere: 1, |d|, |d|^3.
vec3 harmonics_mean(vec3 d) {
  return environment_harmonics[0] + harmonics_linear(d) + harmonics_quadratic(d) * length(d);
}

// Radiance along a unit direction, blurred for a GGX alpha. The middle column is seen along -z.
vec3 environment_radiance(vec3 view_direction, float alpha) {
  vec3 d = environment_from_view * view_direction;
  // At the poles every column is the same light.
  float u = dot(d.xz, d.xz) > 0.0 ? atan(d.x, -d.z) * 0.15915494309189535 + 0.5 : 0.5;  // 1 / 2 pi
  float v = asin(clamp(d.y, -1.0, 1.0)) * 0.3183098861837907 + 0.5;                     // 1 / pi
  return textureLod(environment_map, vec2(u, v), sqrt(clamp(alpha, 0.0, 1.0)) * environment_last_level).rgb;
}
