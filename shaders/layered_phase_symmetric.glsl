// SPDX-License-Identifier: MIT
// A layered material whose fuzz scatters with the symmetric SGGX phase function. In front of layered.glsl.

#define LAYERED_FUZZ_PHASE FUZZ_SGGX_SYMMETRIC
