// SPDX-License-Identifier: MIT
// The frame reflectance is written in, tangent x, bitangent y, normal z (src/brdf/shading_frame.h).
// needs: surface.glsl

// Views at and behind the rim, where interpolated normals turn away, are taken this far above the horizon.
const float LOWEST_VIEW = 1e-3;

mat3 shading_frame(Surface s, vec3 normal) {
  vec3 tangent = s.tangent - normal * dot(normal, s.tangent);
  tangent *= inversesqrt(max(dot(tangent, tangent), 1e-12));
  return mat3(tangent, s.bitangent_sign * cross(normal, tangent), normal);
}

vec3 lifted_view(vec3 view) {
  return view.z < LOWEST_VIEW ? normalize(vec3(view.xy, LOWEST_VIEW)) : view;
}

// Into a frame whose x axis lies at the azimuth of `axis` (its cosine and sine), and back out of it.
vec3 turned(vec3 w, vec2 axis) {
  return vec3(dot(w.xy, axis), axis.x * w.y - axis.y * w.x, w.z);
}
vec3 turned_back(vec3 w, vec2 axis) {
  return turned(w, vec2(axis.x, -axis.y));
}
