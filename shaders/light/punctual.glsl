// SPDX-License-Identifier: MIT
// Lights without extent (src/light/punctual.h); cones as glTF KHR_lights_punctual smooths them. View space.

#define MAXIMUM_LIGHTS 8

uniform int light_count;
uniform vec4 light_position[MAXIMUM_LIGHTS];  // w = 0: unit direction towards a light infinitely far; w = 1: its place
uniform vec4 light_colour[MAXIMUM_LIGHTS];    // w: 1 / (cos inner - cos outer) of a spot, 0 for others
uniform vec4 light_axis[MAXIMUM_LIGHTS];      // of a spot, from the light; w: cos outer

// The light's irradiance on a surface that faces it, and its direction from the surface.
vec3 arriving_light(int i, vec3 position, out vec3 direction) {
  direction = light_position[i].xyz;
  if (light_position[i].w == 0.0) return light_colour[i].rgb;
  vec3 towards = light_position[i].xyz - position;
  float squared = max(dot(towards, towards), 1e-12);
  direction = towards * inversesqrt(squared);
  float factor = 1.0 / squared;
  if (light_colour[i].w > 0.0) {
    float inside = clamp((-dot(direction, light_axis[i].xyz) - light_axis[i].w) * light_colour[i].w, 0.0, 1.0);
    factor *= inside * inside;
  }
  return light_colour[i].rgb * factor;
}
