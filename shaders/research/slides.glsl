// SPDX-License-Identifier: MIT
// The fuzz of the slides as they print it (src/brdf/research/slides.h): polynomials in place of tables, and the simplified
// version for deferred shading.
// needs: layered_core.glsl

#ifndef SLIDES_SIMPLE
#define SLIDES_SIMPLE true
#endif

uniform vec3 slides_down_low;  // the six coefficients of P_s
uniform vec3 slides_down_high;
uniform float slides_simple_fuzziness;

const float SIMPLE_DENSITY = 0.5;
const float SIMPLE_ALPHA = 0.95;
const float SIMPLE_COLOR = 5.0;

float layered_scattered_down(vec3 fibre, vec3 light, float cosine) {
  return fuzz_scattered_down_fit(slides_down_low, slides_down_high, light.z, cosine);
}

vec3 slides_simple_fuzz(vec3 light, vec3 view) {
  float x = fuzz_wrapped_cosine(light.z);
  if (x <= 0.0) return vec3(0.0);
  vec3 across = light + view;
  float phase = fuzz_phase(FUZZ_SGGX, SIMPLE_ALPHA, vec2(0.0), light.z, view.z, dot(across, across));
  float scattered = 1.0 - exp(-SIMPLE_DENSITY * (x + view.z) / (x * view.z));
  return base_color * (SIMPLE_COLOR * phase * scattered * x / (x + view.z));
}

vec3 layered_base_lit(vec3 light, vec3 view) {
  vec3 base = light.z > 0.0 ? diffuse_lit(light) : vec3(0.0);
  return SLIDES_SIMPLE ? mix(base, slides_simple_fuzz(light, view), slides_simple_fuzziness) : base;
}

vec3 layered_base_surroundings(mat3 frame, vec3 view, mat3 bands) {
  vec3 base = diffuse_surroundings(frame, bands);
  if (!SLIDES_SIMPLE) return base;
  float response = fuzz_visibility_fit(SIMPLE_DENSITY, view.z) * 0.5;
  vec3 fuzz = base_color * harmonics_lobe(frame[2], vec3(1.0, 0.5, 0.0)) * (SIMPLE_COLOR * response);
  return mix(base, fuzz, slides_simple_fuzziness);
}

vec3 layered_fuzz_surroundings(Layer layer) {
  return fuzz_color * harmonics_lobe(layer.frame[2], vec3(1.0, 0.5, 0.0)) *
         (fuzz_visibility_fit(fuzz_density, layer.view.z) *
          (1.0 - layered_scattered_down(layer.fibre, layer.view, layer.cosine)));
}
