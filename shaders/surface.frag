// SPDX-License-Identifier: MIT
// Fragment stage of the surface pipeline: builds the Surface and asks the appearance for its colour. Magri et al. 2016,
// sections 6, 6.1 and 6.2.
// needs: switches.glsl surface.glsl eye_frame.glsl constant.glsl

in vec3 position;
in vec3 normal;
in vec4 tangent;
in vec4 map_tangent;
in vec2 uv;
in float occlusion;
in float curvature;
in vec2 tangent_angles;

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

layout(location = 0) out vec4 out_colour;            // linear, associated alpha
layout(location = 1) out vec4 out_position;          // and 1 + material, 0 where nothing was drawn
layout(location = 2) out vec4 out_normal;            // and occlusion
layout(location = 3) out vec4 out_tangent;           // and the sign of the bitangent
layout(location = 4) out vec4 out_eye_normal;        // and the tangent angle
layout(location = 5) out vec4 out_uv_and_curvature;  // u, v, curvature, 1
layout(location = 6) out vec4 out_mesh_normal;       // and the side

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
  if (PERSPECTIVE == PERSPECTIVE_EQUATION4 && perspective_view) return perspective_equation4(direction, position);
  return direction;
}

void main() {
  Surface s;
  s.position = position;
  s.view = perspective_view ? normalize(-position) : vec3(0.0, 0.0, 1.0);
  s.uv = uv;
  s.curvature = curvature;
  s.material = surface_material;

  // Cloth is seen from both sides: the back's normal is turned to the viewer, its threads stay where they are.
  float side = gl_FrontFacing == (surface_front_sign > 0.0) ? 1.0 : -1.0;
  s.side = side;
  s.normal = (RENORMALISE ? normalize(normal) : normal) * side;
  s.mesh_normal = s.normal;
  s.tangent = tangent.xyz;
  s.bitangent_sign = (tangent.w < 0.0 ? -1.0 : 1.0) * side;

  if (NORMAL_MAP || DIRECTION_MAP) {
    vec3 u_axis = across(map_tangent.xyz, s.normal);
    vec3 v_axis = (map_tangent.w < 0.0 ? -side : side) * cross(s.normal, u_axis);
    if (DIRECTION_MAP) {
      vec2 d = texture(surface_direction_map, uv * surface_direction_map_transform.xy + surface_direction_map_transform.zw).rg * 2.0 - 1.0;
      s.tangent = dot(d, d) > 1e-8 ? u_axis * d.x + v_axis * d.y : u_axis;
      s.bitangent_sign = (map_tangent.w < 0.0 ? -1.0 : 1.0) * side;
    }
    if (NORMAL_MAP) {
      vec3 m = texture(surface_normal_map, uv * surface_normal_map_transform.xy + surface_normal_map_transform.zw).rgb * 2.0 - 1.0;
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
    vec2 change = abs(dFdx(tangent_angles)) + abs(dFdy(tangent_angles));
    s.tangent_angle = change.x <= change.y ? tangent_angles.x : tangent_angles.y;
  }

  s.occlusion = 1.0;
  if (OCCLUSION) {
    s.occlusion = occlusion;
    if (OCCLUSION_MAP) {
      s.occlusion *= texture(surface_occlusion_map, uv * surface_occlusion_map_transform.xy + surface_occlusion_map_transform.zw).r;
    }
  }

  out_colour = vec4(APPEARANCE(s), 1.0);
  if (WRITE_SURFACE) {
    out_position = vec4(s.position, float(surface_material) + 1.0);
    out_normal = vec4(s.normal, s.occlusion);
    out_tangent = vec4(s.tangent, s.bitangent_sign);
    out_eye_normal = vec4(s.eye_normal, s.tangent_angle);
    out_uv_and_curvature = vec4(s.uv, s.curvature, 1.0);
    out_mesh_normal = vec4(s.mesh_normal, s.side);
  }
}
