// SPDX-License-Identifier: MIT
// Light that a display shows for light of the scene; src/core/view_transform.h says what and from where.

const int VIEW_NONE = 0;  // in the order of ViewTransform
const int VIEW_SRGB = 1;
const int VIEW_NEUTRAL = 2;
const int VIEW_AGX = 3;

vec3 view_neutral(vec3 light) {
  const float fresnel = 0.04;
  const float compressed = 0.8 - fresnel;
  float least = min(light.r, min(light.g, light.b));
  vec3 colour = light - (least < 2.0 * fresnel ? least - least * least / (4.0 * fresnel) : fresnel);
  float peak = max(colour.r, max(colour.g, colour.b));
  if (peak < compressed) return colour;
  float room = 1.0 - compressed;
  float lower = 1.0 - room * room / (peak + room - compressed);
  float kept = 1.0 / (0.15 * (peak - lower) + 1.0);
  return mix(vec3(lower), colour * (lower / peak), kept);
}

vec3 view_agx(vec3 light) {
  // Column by column. Rec. 709 to Rec. 2020 and back, AgX' inset and outset for those primaries.
  const mat3 wide = mat3(0.627403896, 0.069097289, 0.016391439, 0.329283039, 0.919540395, 0.088013308, 0.043313066,
                         0.011362316, 0.895595253);
  const mat3 narrow = mat3(1.66049100, -0.12455047, -0.01815076, -0.58764114, 1.13289990, -0.10057890, -0.07284986,
                           -0.00834942, 1.11872966);
  const mat3 inset = mat3(0.856627153315983, 0.137318972929847, 0.11189821299995, 0.0951212405381588, 0.761241990602591,
                          0.0767994186031903, 0.0482516061458583, 0.101439036467562, 0.811302368396859);
  const mat3 outset = mat3(1.1271005818144368, -0.1413297634984383, -0.14132976349843826, -0.11060664309660323,
                           1.157823702216272, -0.11060664309660294, -0.016493938717834573, -0.016493938717834257,
                           1.2519364065950405);
  const float darkest = -12.47393;  // stops
  const float brightest = 4.026069;
  vec3 stops = log2(max(inset * (wide * light), vec3(1e-10)));
  vec3 x = clamp((stops - darkest) / (brightest - darkest), 0.0, 1.0);
  vec3 curve = -0.00232 + x * (0.1191 + x * (0.4298 + x * (-6.868 + x * (31.96 + x * (-40.14 + x * 15.5)))));
  return clamp(narrow * pow(max(outset * curve, vec3(0.0)), vec3(2.2)), 0.0, 1.0);
}

vec3 shown_light(int view, vec3 light) {
  vec3 possible = clamp(light, 0.0, 1e6);
  if (view == VIEW_NEUTRAL) return view_neutral(possible);
  if (view == VIEW_AGX) return view_agx(possible);
  return min(possible, vec3(1.0));
}

// What io/ encodes for the file; the view "none" takes the sRGB curve off first, so that the file holds linear values.
vec3 srgb_decoded(vec3 encoded) {
  vec3 high = pow((encoded + 0.055) / 1.055, vec3(2.4));
  return mix(high, encoded / 12.92, vec3(lessThanEqual(encoded, vec3(0.04045))));
}
