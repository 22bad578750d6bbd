// SPDX-License-Identifier: MIT
// A layered material whose fuzz uses the slides' polynomials. In front of layered.glsl.

#define LAYERED_FUZZ_SLIDES true
