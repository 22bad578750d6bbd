// SPDX-License-Identifier: MIT
// How much of a lamp's light reaches a point. Shadows enter here, for every material at once.

float lamp_visibility(int lamp, vec3 position) {
  return 1.0;
}
