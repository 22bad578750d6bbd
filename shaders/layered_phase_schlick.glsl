// SPDX-License-Identifier: MIT
// A layered material whose fuzz scatters with Schlick's phase function. In front of layered.glsl.

#define LAYERED_FUZZ_PHASE FUZZ_SCHLICK
