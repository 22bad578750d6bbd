// SPDX-License-Identifier: MIT
// Fragment stage of the surface pass: builds the Surface and asks the appearance for its colour, or writes what it knows of
// the surface. Magri et al. 2016, sections 6, 6.1 and 6.2.
// needs: switches.glsl surface.glsl surface_varyings.glsl surface_packed.glsl eye_frame.glsl constant.glsl

in vec3 surface_position;
in vec3 surface_normal;
in vec4 surface_tangent;
in vec4 surface_map_tangent;
in vec2 surface_tangent_angles;
#if CURVATURE
in mat3 surface_curvature_form;
#endif

uniform bool perspective_view;
uniform float surface_front_sign;  // -1 when the mesh winds its front faces clockwise
uniform int surface_material;

uniform sampler2D surface_normal_map;  // tangent space, [0, 1], green up
uniform float surface_normal_scale;
uniform vec4 surface_normal_map_transform;  // uv * xy + zw
uniform sampler2D surface_direction_map;    // RG = 0.5 + 0.5 * direction along (tangent, bitangent)
uniform vec4 surface_direction_map_transform;
uniform sampler2D surface_occlusion_map;  // first channel
uniform vec4 surface_occlusion_map_transform;

#if WRITE_SURFACE
uniform int surface_first_target;  // of the packed surface
layout(location = 0) out vec4 out_surface_0;
layout(location = 1) out vec4 out_surface_1;
layout(location = 2) out vec4 out_surface_2;
layout(location = 3) out vec4 out_surface_3;
#else
layout(location = 0) out vec4 out_color;  // linear, associated alpha
#endif

vec3 across(vec3 direction, vec3 unit_normal) {
  vec3 projected = direction - unit_normal * dot(unit_normal, direction);
  float squared = dot(projected, projected);
  if (squared > 1e-12) return projected * inversesqrt(squared);
  // The direction stands on the surface: any one across it.
  vec3 axis = abs(unit_normal.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
  return normalize(cross(axis, unit_normal));
}

vec3 corrected(vec3 direction, vec3 view) {
  if (PERSPECTIVE == PERSPECTIVE_ROTATION) return to_eye_frame(direction, view);
  if (PERSPECTIVE == PERSPECTIVE_EQUATION4 && perspective_view) return perspective_equation4(direction, surface_position);
  return direction;
}

void main() {
  Surface s;
  take_vertex_fields(s);
  s.coverage = 1.0;
  s.position = surface_position;
  s.view = perspective_view ? normalize(-surface_position) : vec3(0.0, 0.0, 1.0);
  s.footprint = vec4(dFdx(s.uv), dFdy(s.uv));
  s.material = surface_material;

  // Cloth is seen from both sides: the back's normal is turned to the viewer, its threads stay where they are.
  float side = gl_FrontFacing == (surface_front_sign > 0.0) ? 1.0 : -1.0;
  s.side = side;
  s.normal = (RENORMALISE ? normalize(surface_normal) : surface_normal) * side;
  s.mesh_normal = s.normal;
  s.tangent = surface_tangent.xyz;
  s.bitangent_sign = (surface_tangent.w < 0.0 ? -1.0 : 1.0) * side;

  if (NORMAL_MAP || DIRECTION_MAP) {
    vec3 u_axis = across(surface_map_tangent.xyz, s.normal);
    vec3 v_axis = (surface_map_tangent.w < 0.0 ? -side : side) * cross(s.normal, u_axis);
    if (DIRECTION_MAP) {
      vec2 d = texture(surface_direction_map, s.uv * surface_direction_map_transform.xy + surface_direction_map_transform.zw).rg * 2.0 - 1.0;
      s.tangent = dot(d, d) > 1e-8 ? u_axis * d.x + v_axis * d.y : u_axis;
      s.bitangent_sign = (surface_map_tangent.w < 0.0 ? -1.0 : 1.0) * side;
    }
    if (NORMAL_MAP) {
      vec3 m = texture(surface_normal_map, s.uv * surface_normal_map_transform.xy + surface_normal_map_transform.zw).rgb * 2.0 - 1.0;
      m.xy *= surface_normal_scale * side;
      s.normal = normalize(u_axis * m.x + v_axis * m.y + s.normal * max(m.z, 1e-3));
    }
  }
  s.tangent = across(s.tangent, RENORMALISE ? s.normal : normalize(s.normal));

  s.eye_normal = corrected(s.normal, s.view);
  if (PERSPECTIVE == PERSPECTIVE_ROTATION) s.eye_normal = seen_normal(s.eye_normal);

  if (TANGENT_ANGLE == TANGENT_ANGLE_FRAGMENT) {
    s.tangent_angle = tangent_angle(corrected(s.tangent, s.view));
  } else {
    // Both are linear in the triangle; the one that does not run the long way around the cycle is the right one.
    vec2 change = abs(dFdx(surface_tangent_angles)) + abs(dFdy(surface_tangent_angles));
    s.tangent_angle = change.x <= change.y ? surface_tangent_angles.x : surface_tangent_angles.y;
  }

  if (OCCLUSION) {
    if (OCCLUSION_MAP) {
      s.occlusion *= texture(surface_occlusion_map, s.uv * surface_occlusion_map_transform.xy + surface_occlusion_map_transform.zw).r;
    }
  } else {
    s.occlusion = 1.0;
  }

  s.curvature *= side;
  s.curvature_tensor = vec3(0.0);
#if CURVATURE
  vec3 bitangent = s.bitangent_sign * cross(s.normal, s.tangent);
  vec3 bent = surface_curvature_form * s.tangent;
  s.curvature_tensor = side * vec3(dot(s.tangent, bent), dot(bitangent, bent), dot(bitangent, surface_curvature_form * bitangent));
#endif

#ifdef SURFACE_COVER
  s.coverage = SURFACE_COVER(s);
  if (s.coverage < 0.5) discard;
#endif
#if WRITE_SURFACE
  out_surface_0 = packed_surface(s, surface_first_target);
  out_surface_1 = packed_surface(s, surface_first_target + 1);
  out_surface_2 = packed_surface(s, surface_first_target + 2);
  out_surface_3 = packed_surface(s, surface_first_target + 3);
#else
  out_color = vec4(APPEARANCE(s), 1.0);
#endif
}
