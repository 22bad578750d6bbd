// SPDX-License-Identifier: MIT
// A layered material without the simplified fuzz. In front of layered.glsl.

#define LAYERED_SIMPLE_FUZZ false
