// SPDX-License-Identifier: MIT
// Vertex stage of the surface pass: Magri et al. 2016, section 6 and 6.2. The switches are constants, so that what a
// variant does not use is compiled away.
// needs: switches.glsl eye_frame.glsl surface_attributes.glsl

in vec3 in_position;
in vec3 in_normal;
in vec4 in_tangent;           // w: sign of the bitangent
in vec4 in_map_tangent;       // along u, the frame of normal and direction maps
in vec3 in_curvature_diagonal;  // xx, yy, zz of the second fundamental form as a matrix in object space
in vec3 in_curvature_off;       // yz, xz, xy

uniform mat4 view_from_object;  // rotation and translation
uniform mat4 clip_from_view;
uniform bool perspective_view;
uniform vec2 tangent_turn;      // cosine and sine of the angle by which all tangents are turned about their normals

out vec3 surface_position;
out vec3 surface_normal;
out vec4 surface_tangent;
out vec4 surface_map_tangent;
out vec2 surface_tangent_angles;  // k and k'
#if CURVATURE
out mat3 surface_curvature_form;  // view space
#endif

void main() {
  mat3 rotation = mat3(view_from_object);
  surface_position = (view_from_object * vec4(in_position, 1.0)).xyz;
  surface_normal = rotation * in_normal;
  vec3 turned = tangent_turn.x * in_tangent.xyz + tangent_turn.y * cross(in_normal, in_tangent.xyz);
  surface_tangent = vec4(rotation * turned, in_tangent.w);
  surface_map_tangent = vec4(rotation * in_map_tangent.xyz, in_map_tangent.w);
  pass_vertex_fields();
#if CURVATURE
  vec3 d = in_curvature_diagonal;
  vec3 o = in_curvature_off;
  surface_curvature_form = rotation * mat3(d.x, o.z, o.y, o.z, d.y, o.x, o.y, o.x, d.z) * transpose(rotation);
#endif

  vec3 direction = surface_tangent.xyz;
  if (perspective_view) {
    if (PERSPECTIVE == PERSPECTIVE_ROTATION) direction = to_eye_frame(direction, normalize(-surface_position));
    if (PERSPECTIVE == PERSPECTIVE_EQUATION4) direction = perspective_equation4(direction, surface_position);
  }
  float k = tangent_angle(direction);
  if (TANGENT_ANGLE == TANGENT_ANGLE_NAIVE) {
    surface_tangent_angles = vec2(k, k);
  } else {
    // k in [0, 1/R) and its equal k' in [0.5/R, 1.5/R): of the two, at least one takes the short way around the cycle.
    float turn = fract(k * TANGENT_SYMMETRY);
    surface_tangent_angles = vec2(turn, turn - floor(turn - 0.5)) / TANGENT_SYMMETRY;
  }
  gl_Position = clip_from_view * vec4(surface_position, 1.0);
}
