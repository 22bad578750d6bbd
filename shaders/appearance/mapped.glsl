// SPDX-License-Identifier: MIT
// A surface whose normal and GGX lobe come from filtered maps, over a diffuse base (src/texture/mapped_appearance.h).
// needs: surface.glsl footprint.glsl shading_frame.glsl diffuse_base.glsl ggx.glsl ggx_surroundings.glsl aniso_map.glsl

uniform sampler2D mapped_normals;     // x and y as n / 2 + 1/2
uniform sampler2D mapped_lobes;
uniform sampler2D mapped_albedo;      // scale and bias: GgxAlbedoTable
uniform bool mapped_root;             // the encoding: root, otherwise correlation
uniform float mapped_green;           // -1 for normals with green down
uniform vec2 mapped_repeat;
uniform vec3 mapped_f0;
uniform int mapped_lobe_samples;

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

// What one point has in common for all lights.
struct MappedPoint {
  mat3 frame;       // under the normal map: tangent, bitangent, normal
  mat3 lobe_frame;  // the same, the tangent along the larger alpha
  vec3 view;        // in it
  vec2 alpha;
};

MappedPoint mapped_at(Surface s) {
  vec2 uv = s.uv * mapped_repeat;
  vec4 footprint = s.footprint * mapped_repeat.xyxy;
  vec3 n = decode_normal_xy(textureLod(mapped_normals, uv, map_level(mapped_normals, footprint)).xy);
  vec3 channels = textureLod(mapped_lobes, uv, map_level(mapped_lobes, footprint)).rgb;
  n.xy *= vec2(s.side, s.side * mapped_green);  // from behind, bumps are dents
  AnisotropicLobe lobe;
  if (mapped_root) {
    lobe = decode_anisotropy_root(channels);
  } else {
    lobe = decode_anisotropy_correlation(channels);
  }
  MappedPoint p;
  p.frame = mat3(s.tangent, s.bitangent_sign * cross(s.normal, s.tangent), s.normal) * normal_map_frame(n);
  p.lobe_frame = p.frame * mat3(vec3(lobe.axis, 0.0), vec3(-lobe.axis.y, lobe.axis.x, 0.0), vec3(0.0, 0.0, 1.0));
  p.view = lifted_view(s.view * p.lobe_frame);
  p.alpha = vec2(lobe.alpha_t, lobe.alpha_b);
  return p;
}

vec3 mapped_lit(MappedPoint p, vec3 towards) {
  vec3 light = towards * p.lobe_frame;
  if (light.z <= 0.0) return vec3(0.0);
  return diffuse_lit(towards * p.frame) + ggx_brdf(p.alpha, mapped_f0, light, p.view) * light.z;
}

vec3 mapped_surroundings(MappedPoint p) {
  vec3 sum = diffuse_surroundings(p.frame, mat3(base_bands[0], base_bands[1], base_bands[2]));
  if (!environment_present) return sum;
  return sum + ggx_surroundings(p.alpha, p.lobe_frame, p.view, mapped_lobe_samples) * mapped_reflectance(p.alpha, p.view);
}
