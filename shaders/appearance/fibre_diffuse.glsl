// SPDX-License-Identifier: MIT
// Hast, Wesslen, Seipel, "Improved Diffuse Anisotropic Shading", equation (10) in the form that holds for every light
// (src/brdf/fibre_diffuse.h). The fibre lies along x, the normal along z.

// Phi, the cosine included: 2 / pi for light along the normal, 0 for light along the fibre.
float fibre_diffuse(vec3 light) {
  return light.z < 0.0 ? 0.0 : (length(light.yz) + light.z) * 0.3183098861837907;  // 1 / pi
}

// The family (length across the fibre + lobe.x n.l) lobe.y: (1, 1 / pi) is Phi, (0, 1) the maximum normal alone.
float fibre_lobe(vec3 light, vec2 lobe) {
  return light.z < 0.0 ? 0.0 : (length(light.yz) + lobe.x * light.z) * lobe.y;
}
