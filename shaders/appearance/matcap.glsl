// SPDX-License-Identifier: MIT
// MatCap, one picture of a lit sphere: Sloan et al. 2001; Magri et al. 2016, section 3. Isotropic materials only.
// needs: surface.glsl

uniform sampler2D matcap_table;  // v up, pixel-centred: texel x covers n_x = 2 (x + 0.5) / size - 1

vec3 matcap(Surface s) {
  return s.occlusion * texture(matcap_table, s.eye_normal.xy * 0.5 + 0.5).rgb;
}
