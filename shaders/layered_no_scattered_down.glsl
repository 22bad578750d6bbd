// SPDX-License-Identifier: MIT
// A layered material whose fuzz scatters no light down to the base. In front of layered.glsl.

#define LAYERED_FUZZ_DOWN false
