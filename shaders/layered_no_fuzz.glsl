// SPDX-License-Identifier: MIT
// A layered material without fuzz. In front of layered.glsl.

#define LAYERED_FUZZ false
