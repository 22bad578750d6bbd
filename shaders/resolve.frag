// SPDX-License-Identifier: MIT
// The mean of samples x samples texels for every pixel: a box filter in linear light with associated alpha.

uniform sampler2D supersampled;
uniform int samples;

layout(location = 0) out vec4 out_colour;

void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * samples;
  vec4 sum = vec4(0.0);
  for (int y = 0; y < samples; ++y) {
    for (int x = 0; x < samples; ++x) sum += texelFetch(supersampled, first + ivec2(x, y), 0);
  }
  out_colour = sum / float(samples * samples);
}
