// SPDX-License-Identifier: MIT
// Anisotropic GGX, height-correlated Smith, Schlick's Fresnel: Walter et al. 2007, Heitz 2014 (src/brdf/ggx.h). Directions
// in the frame of the roughness' axis (x), normal z; both alphas in (0, 1].

float D_ggx(vec2 alpha, vec3 h) {
  vec3 scaled = vec3(h.xy / alpha, h.z);
  float q = dot(scaled, scaled);
  return 0.3183098861837907 / (alpha.x * alpha.y * q * q);  // 1 / pi
}

float lambda_ggx(vec2 alpha, vec3 w) {
  vec2 scaled = alpha * w.xy / w.z;
  return (sqrt(1.0 + dot(scaled, scaled)) - 1.0) * 0.5;
}

float F_weight_schlick(float cosine) {
  float m = clamp(1.0 - cosine, 0.0, 1.0);
  float m2 = m * m;
  return m2 * m2 * m;
}

// The BRDF without the cosine; both directions above the horizon.
vec3 ggx_brdf(vec2 alpha, vec3 f0, vec3 light, vec3 view) {
  vec3 h = normalize(light + view);
  float masking = 4.0 * light.z * view.z * (1.0 + lambda_ggx(alpha, light) + lambda_ggx(alpha, view));
  return mix(f0, vec3(1.0), F_weight_schlick(dot(light, h))) * (D_ggx(alpha, h) / masking);
}

// Kulla and Conty 2017: further bounces, by the albedos of single scattering.
vec3 ggx_multiple_scattering(vec3 f0, float albedo_light, float albedo_view, float mean_albedo) {
  float lobe = (1.0 - albedo_light) * (1.0 - albedo_view) * 0.3183098861837907 / (1.0 - mean_albedo);
  vec3 mean_fresnel = mix(f0, vec3(1.0), 1.0 / 21.0);
  return mean_fresnel * mean_fresnel * mean_albedo / (1.0 - mean_fresnel * (1.0 - mean_albedo)) * lobe;
}
