// SPDX-License-Identifier: MIT
// Reads tables over the upper hemisphere (src/brdf/hemisphere_table.h): hemi-octahedral map (Cigolle et al. 2014), corner
// texels on the horizon, the middle texel along the normal.

vec4 hemisphere_table(sampler2D table, vec3 direction) {
  float z = max(direction.z, 0.0);
  vec2 p = direction.xy / (abs(direction.x) + abs(direction.y) + z);
  float size = float(textureSize(table, 0).x);
  vec2 square = vec2(p.x + p.y, p.x - p.y) * 0.5 + 0.5;
  return textureLod(table, (square * (size - 1.0) + 0.5) / size, 0.0);
}
