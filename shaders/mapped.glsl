// SPDX-License-Identifier: MIT
// A surface whose normal and GGX lobe come from filtered maps (src/texture/mapped_appearance.h), over the base and under
// the lights of layered.glsl.
// needs: surface.glsl punctual.glsl ggx.glsl ggx_surroundings.glsl aniso_map.glsl layered.glsl

uniform sampler2D mapped_normals;     // x and y as n / 2 + 1/2
uniform sampler2D mapped_lobes;
uniform sampler2D mapped_albedo;      // scale and bias: GgxAlbedoTable
uniform bool mapped_root;             // the encoding: root, otherwise correlation
uniform float mapped_green;           // -1 for normals with green down
uniform vec2 mapped_repeat;
uniform vec3 mapped_f0;
uniform int mapped_lobe_samples;      // 0: no environment map to reflect

const vec2 MAPPED_ALBEDO_TILE = vec2(16.0, 9.0);
const vec2 MAPPED_ALBEDO_TILES = vec2(12.0, 8.0);

// Reflectance in uniform light. `view` is in the frame of the lobe's axis, along the larger alpha.
vec3 mapped_reflectance(vec2 alpha, vec3 view) {
  float along = abs(view.x) / max(length(view.xy), 1e-6);
  vec2 tile = sqrt(vec2(alpha.x, alpha.y / alpha.x)) * (MAPPED_ALBEDO_TILES - 1.0);
  vec2 first = min(floor(tile), MAPPED_ALBEDO_TILES - 2.0);
  vec2 blend = tile - first;
  vec2 inside = vec2(sqrt(clamp(view.z, 0.0, 1.0)), along) * (MAPPED_ALBEDO_TILE - 1.0) + 0.5;
  vec2 next = 1.0 / MAPPED_ALBEDO_TILES;
  vec2 at = first * next + inside * next / MAPPED_ALBEDO_TILE;
  vec2 upper = mix(textureLod(mapped_albedo, at, 0.0).xy, textureLod(mapped_albedo, at + vec2(next.x, 0.0), 0.0).xy, blend.x);
  vec2 lower = mix(textureLod(mapped_albedo, at + vec2(0.0, next.y), 0.0).xy, textureLod(mapped_albedo, at + next, 0.0).xy, blend.x);
  vec2 albedo = mix(upper, lower, blend.y);
  return mapped_f0 * albedo.x + albedo.y;
}

vec3 mapped(Surface s) {
  vec2 uv = s.uv * mapped_repeat;
  vec2 stored = texture(mapped_normals, uv).xy;
  vec3 channels = texture(mapped_lobes, uv).rgb;
  vec3 n = decode_normal_xy(stored);
  n.xy *= vec2(s.side, s.side * mapped_green);  // from behind, bumps are dents
  AnisotropicLobe lobe = mapped_root ? decode_anisotropy_root(channels) : decode_anisotropy_correlation(channels);
  mat3 turned = mat3(s.tangent, s.bitangent_sign * cross(s.normal, s.tangent), s.normal) * normal_map_frame(n);
  Surface m = s;
  m.normal = turned[2];
  m.tangent = turned[0];
  vec3 sum = layered(m);

  vec2 alpha = vec2(lobe.alpha_t, lobe.alpha_b);
  mat3 frame = turned * mat3(vec3(lobe.axis, 0.0), vec3(-lobe.axis.y, lobe.axis.x, 0.0), vec3(0.0, 0.0, 1.0));
  vec3 view = s.view * frame;
  if (view.z < LAYERED_LOWEST_VIEW) view = normalize(vec3(view.xy, LAYERED_LOWEST_VIEW));
  if (mapped_lobe_samples > 0) {
    sum += s.occlusion * ggx_surroundings(alpha, frame, view, mapped_lobe_samples) * mapped_reflectance(alpha, view);
  }
  for (int i = 0; i < light_count; ++i) {
    vec3 direction;
    vec3 irradiance = arriving_light(i, s.position, direction);
    vec3 light = direction * frame;
    if (light.z > 0.0) sum += irradiance * ggx_brdf(alpha, mapped_f0, light, view) * light.z;
  }
  return sum;
}
