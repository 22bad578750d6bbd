// SPDX-License-Identifier: MIT
// Reads tables over the upper hemisphere that are fine across a fibre (src/brdf/fibre_table.h), normal z.

// `fibre`: unit, z >= 0; `along`: scale and offset of the first coordinate; texels' middles are the nodes.
vec4 fibre_table(sampler2D table, vec3 fibre, vec2 along, vec3 w) {
  float cosine = clamp(dot(w, fibre), -1.0, 1.0);
  float near = sqrt(1.0 + cosine);
  float far = sqrt(1.0 - cosine);
  float swing = near * far * sqrt(max(1.0 - fibre.z * fibre.z, 0.0));
  float middle = cosine * fibre.z;
  float lowest = max(middle - swing, 0.0);
  vec2 at = vec2((far - near) * along.x + along.y, (w.z - lowest) / max(middle + swing - lowest, 1e-6));
  vec2 size = vec2(textureSize(table, 0));
  return textureLod(table, (clamp(at, 0.0, 1.0) * (size - 1.0) + 0.5) / size, 0.0);
}
