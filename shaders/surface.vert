// SPDX-License-Identifier: MIT
// Vertex stage of the surface pipeline: Magri et al. 2016, section 6 and 6.2. The switches are constants, so that what a
// variant does not use is compiled away.
// needs: switches.glsl eye_frame.glsl

in vec3 in_position;
in vec3 in_normal;
in vec4 in_tangent;      // w: sign of the bitangent
in vec4 in_map_tangent;  // along u, the frame of normal and direction maps
in vec2 in_uv;
in float in_occlusion;
in float in_curvature;

uniform mat4 view_from_object;  // rotation and translation
uniform mat4 clip_from_view;
uniform bool perspective_view;

out vec3 position;
out vec3 normal;
out vec4 tangent;
out vec4 map_tangent;
out vec2 uv;
out float occlusion;
out float curvature;
out vec2 tangent_angles;  // k and k'

void main() {
  mat3 rotation = mat3(view_from_object);
  position = (view_from_object * vec4(in_position, 1.0)).xyz;
  normal = rotation * in_normal;
  tangent = vec4(rotation * in_tangent.xyz, in_tangent.w);
  map_tangent = vec4(rotation * in_map_tangent.xyz, in_map_tangent.w);
  uv = in_uv;
  occlusion = in_occlusion;
  curvature = in_curvature;

  vec3 direction = tangent.xyz;
  if (perspective_view) {
    if (PERSPECTIVE == PERSPECTIVE_ROTATION) direction = to_eye_frame(direction, normalize(-position));
    if (PERSPECTIVE == PERSPECTIVE_EQUATION4) direction = perspective_equation4(direction, position);
  }
  float k = tangent_angle(direction);
  if (TANGENT_ANGLE == TANGENT_ANGLE_NAIVE) {
    tangent_angles = vec2(k, k);
  } else {
    // k in [0, 1/R) and its equal k' in [0.5/R, 1.5/R): of the two, at least one takes the short way around the cycle.
    float turn = fract(k * TANGENT_SYMMETRY);
    tangent_angles = vec2(turn, turn - floor(turn - 0.5)) / TANGENT_SYMMETRY;
  }
  gl_Position = clip_from_view * vec4(position, 1.0);
}
