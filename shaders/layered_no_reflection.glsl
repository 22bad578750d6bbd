// SPDX-License-Identifier: MIT
// A layered material without a GGX reflection. In front of layered.glsl.

#define LAYERED_REFLECTION false
