// SPDX-License-Identifier: MIT
// Decoding of anisotropy maps (docs/anisotropy-maps.md; encodings in src/texture/anisotropy.h). After Patry, "Samurai
// Shading in Ghost of Tsushima" 2020, DecodeSggx. Sample the map as linear data, never sRGB.

// A GGX lobe in the tangent plane: alpha_t >= alpha_b, both in [1e-3, 1]; `axis` is the unit direction of alpha_t, along
// the long highlight, x along U and y along V. It is a line: the sign means nothing.
struct AnisotropicLobe {
  float alpha_t;
  float alpha_b;
  vec2 axis;
};

// The axis of the larger eigenvalue of [[m + half, off], [off, m - half]].
vec2 long_axis(float half_difference, float off) {
  float radius = length(vec2(half_difference, off));
  if (radius < 1e-7) return vec2(1.0, 0.0);
  float cos_double = clamp(half_difference / radius, -1.0, 1.0);
  return vec2(sqrt(0.5 + 0.5 * cos_double), (off < 0.0 ? -1.0 : 1.0) * sqrt(0.5 - 0.5 * cos_double));
}

// Encoding `root`: the channels are the square root of the matrix, its eigenvalues the alphas themselves. Interpolation
// cannot make them negative; quantisation can, by half a step: the matrix is the square, hence abs.
AnisotropicLobe decode_anisotropy_root(vec3 channels) {
  float off = channels.y - 0.5;
  float mean = 0.5 * (channels.x + channels.z);
  float half_difference = 0.5 * (channels.x - channels.z);
  float radius = length(vec2(half_difference, off));
  return AnisotropicLobe(clamp(mean + radius, 1e-3, 1.0), clamp(abs(mean - radius), 1e-3, 1.0),
                         long_axis(half_difference, off));
}

// Encoding `correlation`, the slides': hardware interpolates the channels, not the matrix, so the result may be singular
// or larger than 1 (outside [0, 1] also negative): both eigenvalues are clamped. The small one comes from the determinant,
// which does not cancel.
AnisotropicLobe decode_anisotropy_correlation(vec3 channels) {
  float xx = channels.x * channels.x;
  float yy = channels.z * channels.z;
  float correlation = 2.0 * channels.y - 1.0;
  float xy = channels.x * correlation * channels.z;
  float half_difference = 0.5 * (xx - yy);
  float large = 0.5 * (xx + yy) + length(vec2(half_difference, xy));
  float small = large > 0.0 ? xx * yy * (1.0 - correlation * correlation) / large : 0.0;
  return AnisotropicLobe(sqrt(clamp(large, 1e-6, 1.0)), sqrt(clamp(small, 1e-6, 1.0)), long_axis(half_difference, xy));
}

// The tangent-space normal of a map that stores x and y as n / 2 + 1/2 (BC5); green up.
vec3 decode_normal_xy(vec2 channels) {
  vec2 n = 2.0 * channels - 1.0;
  return vec3(n, sqrt(max(1.0 - dot(n, n), 0.0)));
}

// The frame the lobe's axis lives in: the smallest rotation that takes +z to the tangent-space normal n. Its columns
// are the normal-mapped tangent, bitangent and n.
mat3 normal_map_frame(vec3 n) {
  float k = 1.0 / max(1.0 + n.z, 1e-6);
  return mat3(vec3(1.0 - n.x * n.x * k, -n.x * n.y * k, -n.x), vec3(-n.x * n.y * k, 1.0 - n.y * n.y * k, -n.y), n);
}
