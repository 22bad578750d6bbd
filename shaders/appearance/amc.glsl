// Anisotropic MatCap (Magri, Cignoni, Tarini 2016, sections 4 and 6): one trilinear fetch.
// SPDX-License-Identifier: MIT
// needs: surface.glsl

uniform sampler3D amc_table;  // (n_x, n_y, k): clamp, clamp, repeat; linear
uniform float amc_symmetry;   // R
uniform float amc_half_slice; // 0.5 / S_k: slices are frame-centred in k

vec3 amc(Surface s) {
    vec2 ij = s.eye_normal.xy * 0.5 + 0.5;
    float k = s.tangent_angle * amc_symmetry + amc_half_slice;
    return texture(amc_table, vec3(ij, k)).rgb * s.occlusion;
}
