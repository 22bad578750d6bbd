// SPDX-License-Identifier: MIT
// Perspective for tables looked up by view-space directions: Magri et al. 2016, section 6, corrected (docs/rendering.md).

// `direction` in the eye frame, whose z axis points from the shaded point to the eye: the smallest rotation that takes
// the unit vector `view` to z. With h = view + z and c = view.z it is d - h (h.d) / (1 + c) + 2 z (view.d).
vec3 to_eye_frame(vec3 direction, vec3 view) {
  float c = 1.0 + view.z;
  // A point straight behind the eye: every axis across will do.
  if (c < 1e-6) return vec3(direction.x, -direction.y, -direction.z);
  vec3 h = vec3(view.xy, c);
  return direction - h * (dot(h, direction) / c) + vec3(0.0, 0.0, 2.0 * dot(view, direction));
}

// Equation (4) as printed, with the view-space position: x and y apart, so not a rotation. Kept by name.
vec3 perspective_equation4(vec3 direction, vec3 position) {
  vec2 slope = position.xy / position.z;
  return vec3((direction.xy - slope * direction.z) / sqrt(1.0 + slope * slope), direction.z);
}

// A normal that interpolation or a normal map turned away from the eye has no entry in a table of seen normals: the
// nearest entry is on the rim.
vec3 seen_normal(vec3 eye_normal) {
  if (eye_normal.z >= 0.0) return eye_normal;
  float reach = length(eye_normal.xy);
  return reach > 0.0 ? vec3(eye_normal.xy / reach, 0.0) : vec3(1.0, 0.0, 0.0);
}

// Equation (3): the picture-plane angle of a direction in turns, [0, 1); 0 for one along the view axis.
float tangent_angle(vec3 direction) {
  if (direction.x == 0.0 && direction.y == 0.0) return 0.0;
  return fract(atan(direction.y, direction.x) * 0.15915494309189535);  // 1 / 2 pi
}
