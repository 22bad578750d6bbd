// SPDX-License-Identifier: MIT
// The scene's light on a reflectance: the one loop over lamps (src/appearance/appearance.cpp has the same). The renderer
// defines the names of the reflectance's struct and functions in front (src/appearance/shader_module.h).
// needs: surface.glsl environment.glsl punctual.glsl visibility.glsl

#ifndef REFLECTANCE_POINT
#define REFLECTANCE_POINT NoReflectance
#define REFLECTANCE_AT no_reflectance_at
#define REFLECTANCE_LIT no_reflectance_lit
#define REFLECTANCE_SURROUNDINGS no_reflectance_surroundings
struct NoReflectance { float nothing; };
NoReflectance no_reflectance_at(Surface s) { return NoReflectance(0.0); }
vec3 no_reflectance_lit(NoReflectance p, vec3 light) { return vec3(0.0); }
vec3 no_reflectance_surroundings(NoReflectance p) { return vec3(0.0); }
#endif

vec3 lit(Surface s) {
  REFLECTANCE_POINT point = REFLECTANCE_AT(s);
  vec3 sum = s.occlusion * REFLECTANCE_SURROUNDINGS(point);
  for (int i = 0; i < light_count; ++i) {
    vec3 direction;
    vec3 irradiance = arriving_light(i, s.position, direction) * lamp_visibility(i, s.position);
    sum += irradiance * REFLECTANCE_LIT(point, direction);
  }
  return max(sum, 0.0);
}
