// MatCap decomposition (Zubiaga et al. 2015, section 5): warp, turn the light back, look both parts up, add them.
// SPDX-License-Identifier: MIT
// The same formulas as src/matcap/edited_matcap.cpp, for looks that textures vary over the surface; all others are a
// function of the normal alone (matcap_by_normal.glsl). Not for anisotropic materials: the filter is round.
// needs: surface.glsl

#define DECOMPOSED_LEVELS 12

uniform sampler2DArray decomposed_maps;             // layers low front, low back, high front, high back; v up; all levels
uniform vec4 decomposed_variances[DECOMPOSED_LEVELS];  // x: blur of each level of the high part; y: levels there are
uniform mat3 decomposed_light_back;                 // view space to the light's own frame
uniform float decomposed_low_slope;                 // mu of the low part
uniform float decomposed_high_variance;             // nu of the high part
uniform vec3 decomposed_low_color;                  // base colour times intensity
uniform vec3 decomposed_high_color;
uniform vec4 decomposed_low_silhouette;             // theta0, m1, alpha1 - mean of the base colour, 1 if there is one
uniform vec4 decomposed_high_silhouette;
uniform int decomposed_display;                     // 1: the parts add up in sRGB-encoded values
uniform float decomposed_added_variance;            // radians^2, everywhere
uniform float decomposed_roughness_scale;           // radians^2 of added variance where the texture is 1
uniform sampler2D decomposed_low_texture;           // factors; repeated over uv
uniform sampler2D decomposed_high_texture;
uniform sampler2D decomposed_roughness_texture;
uniform sampler2D decomposed_occlusion_texture;

// mu(nu) = 1 - 0.3 nu - 1.1 nu^2, section 3.1
float decomposed_slope(float variance) {
  return clamp(1.0 - variance * (0.3 + 1.1 * variance), 0.0, 1.0);
}

// n with its angle theta to +z made (1 + mu) theta. sin(2 theta) and cos(2 theta) need no trigonometry; what remains,
// (1 - mu) theta, does. Diffuse parts have mu = 0 and stay.
vec3 decomposed_warp(vec3 n, float mu, float theta) {
  if (mu == 0.0) return n;
  float across = length(n.xy);
  vec2 azimuth = across > 1e-7 ? n.xy / across : vec2(1.0, 0.0);
  vec2 doubled = vec2(2.0 * across * n.z, n.z * n.z - across * across) / (across * across + n.z * n.z);
  float less = (1.0 - mu) * theta;
  float s = sin(less);
  float c = cos(less);
  return vec3(azimuth * (doubled.x * c - doubled.y * s), doubled.y * c + doubled.x * s);
}

// Mixing two levels mixes their variances: linear in variance.
float decomposed_level(float variance) {
  int count = int(decomposed_variances[0].y);
  float level = 0.0;
  for (int i = 1; i < DECOMPOSED_LEVELS; ++i) {
    if (i >= count) break;
    float low = decomposed_variances[i - 1].x;
    level += clamp((variance - low) / (decomposed_variances[i].x - low), 0.0, 1.0);
  }
  return level;
}

vec3 decomposed_lookup(vec3 w, float first_layer, float level) {
  vec2 st = w.xy / (2.0 * (1.0 + abs(w.z))) + 0.5;
  return textureLod(decomposed_maps, vec3(st, first_layer + (w.z < 0.0 ? 1.0 : 0.0)), level).rgb;
}

float decomposed_silhouette(vec4 s, float theta) {
  if (s.w < 0.5) return 1.0;
  float t = clamp((theta - s.x) / (1.5707963 - s.x), 0.0, 1.0);
  return max(0.0, 1.0 + t * t * ((3.0 - 2.0 * t) + (t - 1.0) * s.y) * s.z);
}

vec3 decomposed_decode(vec3 v) {
  vec3 a = abs(v);
  return sign(v) * mix(pow((a + 0.055) / 1.055, vec3(2.4)), a / 12.92, lessThanEqual(a, vec3(0.04045)));
}

vec3 matcap_decomposition(Surface s) {
  vec3 low_color = decomposed_low_color * texture(decomposed_low_texture, s.uv).rgb;
  vec3 high_color = decomposed_high_color * texture(decomposed_high_texture, s.uv).rgb;
  float added = decomposed_added_variance + decomposed_roughness_scale * texture(decomposed_roughness_texture, s.uv).r;
  float occlusion = s.occlusion * texture(decomposed_occlusion_texture, s.uv).r;
  vec3 n = vec3(s.eye_normal.xy, max(s.eye_normal.z, 0.0));
  float theta = atan(length(n.xy), n.z);
  vec3 low_way = decomposed_light_back * decomposed_warp(n, decomposed_low_slope, theta);
  vec3 high_way = decomposed_light_back * decomposed_warp(n, decomposed_slope(decomposed_high_variance + added), theta);
  vec3 sum = low_color * decomposed_lookup(low_way, 0.0, 0.0) * decomposed_silhouette(decomposed_low_silhouette, theta) +
             high_color * decomposed_lookup(high_way, 2.0, added > 0.0 ? decomposed_level(added) : 0.0) *
                 decomposed_silhouette(decomposed_high_silhouette, theta);
  return (decomposed_display != 0 ? decomposed_decode(sum) : sum) * occlusion;
}
