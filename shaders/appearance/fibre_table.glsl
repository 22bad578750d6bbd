// SPDX-License-Identifier: MIT
// Reads tables over the upper hemisphere that are fine across a fibre (src/brdf/fibre_table.h), normal z.

// Where w lies about the fibre, along and across, both in [0, 1] but for rounding; `along`: scale and offset of the first.
vec2 fibre_place(vec3 fibre, vec2 along, vec3 w, float cosine) {
  float near = sqrt(abs(1.0 + cosine));  // abs: of two unit directions it may round to a little above 1
  float far = sqrt(abs(1.0 - cosine));
  float swing = near * far * length(fibre.xy);
  float middle = cosine * fibre.z;
  float lowest = max(middle - swing, 0.0);
  return vec2((far - near) * along.x + along.y, (w.z - lowest) / max(middle + swing - lowest, 1e-6));
}

// `texels`: the table's width and height, whose texels' middles are the nodes; `fibre`: unit, z >= 0; `cosine`:
// between w and the fibre.
vec4 fibre_table(sampler2D table, vec2 texels, vec3 fibre, vec2 along, vec3 w, float cosine) {
  vec2 at = fibre_place(fibre, along, w, cosine);
  return textureLod(table, at * (1.0 - 1.0 / texels) + 0.5 / texels, 0.0);  // clamped to the outermost middles by the sampler
}

// 2 sin(tilt / 2) of a fibre: its tilt in the tables that lie over one another (src/brdf/fuzz_tilt_table.h), from 0 to
// sqrt(2), and the end of the first coordinate.
float fibre_tilt(vec3 fibre) {
  float sine = length(fibre.xy);
  return sqrt(1.0 + sine) - sqrt(abs(1.0 - sine));
}

// The same of a volume of tables over tilt.
vec4 fibre_volume(sampler3D tables, vec3 texels, vec3 fibre, vec3 w, float cosine) {
  float tilt = fibre_tilt(fibre);
  float scale = 1.0 / (tilt + 1.4142135623730951);
  vec2 at = fibre_place(fibre, vec2(scale, 1.4142135623730951 * scale), w, cosine);
  return textureLod(tables, vec3(at, tilt * 0.7071067811865476) * (1.0 - 1.0 / texels) + 0.5 / texels, 0.0);
}
