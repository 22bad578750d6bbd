// SPDX-License-Identifier: MIT
// The display pass: samples x samples texels for every pixel, each exposed and seen through the view transform, then
// averaged (a box filter in linear light with associated alpha). Samples that the display cannot show any brighter
// would otherwise outweigh their darker neighbours, and bright outlines show stairs.
// needs: view_transform.glsl

uniform sampler2D supersampled;
uniform int samples;
uniform vec4 background;      // behind everything, as the display shows it, and 1; or four zeros
uniform int display_view;     // VIEW_*; -1 leaves the light of the scene as it is
uniform float display_gain;   // 2^exposure

layout(location = 0) out vec4 out_colour;

vec4 sample_shown(vec4 texel) {
  if (display_view >= 0 && texel.a > 0.0) {
    texel.rgb = shown_light(display_view, texel.rgb / texel.a * display_gain) * texel.a;
  }
  return texel + (1.0 - texel.a) * background;
}

void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * samples;
  vec4 sum = vec4(0.0);
  for (int y = 0; y < samples; ++y) {
    for (int x = 0; x < samples; ++x) sum += sample_shown(texelFetch(supersampled, first + ivec2(x, y), 0));
  }
  vec4 mean = sum / float(samples * samples);
  if (display_view == VIEW_NONE && mean.a > 0.0) mean.rgb = srgb_decoded(mean.rgb / mean.a) * mean.a;
  out_colour = mean;
}
