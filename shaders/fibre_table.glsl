// SPDX-License-Identifier: MIT
// Reads tables over the upper hemisphere that are fine across a fibre (src/brdf/fibre_table.h), normal z.

// `texels`: the table's width and height, whose texels' middles are the nodes; `fibre`: unit, z >= 0; `along`: scale and
// offset of the first coordinate; `cosine`: between w and the fibre.
vec4 fibre_table(sampler2D table, vec2 texels, vec3 fibre, vec2 along, vec3 w, float cosine) {
  float near = sqrt(abs(1.0 + cosine));  // abs: of two unit directions it may round to a little above 1
  float far = sqrt(abs(1.0 - cosine));
  float swing = near * far * sqrt(abs(1.0 - fibre.z * fibre.z));
  float middle = cosine * fibre.z;
  float lowest = max(middle - swing, 0.0);
  vec2 at = vec2((far - near) * along.x + along.y, (w.z - lowest) / max(middle + swing - lowest, 1e-6));
  return textureLod(table, at * (1.0 - 1.0 / texels) + 0.5 / texels, 0.0);  // clamped to the outermost middles by the sampler
}
