// SPDX-License-Identifier: MIT
// The mip level a pixel asks for (src/appearance/footprint.h): the longer of its two sides in texels, so that no detail
// shimmers. `footprint` is that of Surface, times the map's repeats. Said here and not left to the driver, so that the
// evaluator in C++ reads the same level.

float map_level(sampler2D map, vec4 footprint) {
  vec2 size = vec2(textureSize(map, 0));
  vec2 right = footprint.xy * size;
  vec2 up = footprint.zw * size;
  return 0.5 * log2(max(max(dot(right, right), dot(up, up)), 1e-12));
}
