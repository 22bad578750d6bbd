// SPDX-License-Identifier: MIT
// Layered materials as they are meant: the integrals of layered_core.glsl from tables (src/brdf/layered/tables.h).
// needs: layered_core.glsl

// P_s of a light, by its cosine to the fibre.
float layered_scattered_down(vec3 fibre, vec3 light, float cosine) {
  if (LAYERED_FIBRE_MAP) return fibre_volume(fuzz_down_volume, vec3(FUZZ_DOWN_TEXELS, FUZZ_TILTS), fibre, light, cosine).x;
  return fibre_table(fuzz_down_table, FUZZ_DOWN_TEXELS, fibre, fuzz_table_along, light, cosine).x;
}

vec3 layered_base_lit(vec3 light, vec3 view) {
  return light.z > 0.0 ? diffuse_lit(light) : vec3(0.0);
}

vec3 layered_base_surroundings(mat3 frame, vec3 view, mat3 bands) {
  return diffuse_surroundings(frame, bands);
}

vec4 layered_ambient(Layer layer) {
  if (LAYERED_FIBRE_MAP) {
    return fibre_volume(fuzz_ambient_volume, vec3(FUZZ_AMBIENT_TEXELS, FUZZ_TILTS), layer.fibre, layer.view, layer.cosine);
  }
  return fibre_table(fuzz_ambient_table, FUZZ_AMBIENT_TEXELS, layer.fibre, fuzz_table_along, layer.view, layer.cosine);
}

vec3 layered_fuzz_surroundings(Layer layer) {
  float visibility = fuzz_visibility_fit(fuzz_density, layer.view.z);
  vec3 v = turned(layer.view, layer.axis);
  vec4 ambient = layered_ambient(layer);
  vec3 gaze = layer.frame * turned_back(vec3(ambient.x, ambient.y * v.y, ambient.z), layer.axis);
  return fuzz_color * harmonics_mean(gaze) * (ambient.w * visibility);
}
