// SPDX-License-Identifier: MIT
// A layered material whose reflection is single scattering only. In front of layered.glsl.

#define LAYERED_COMPENSATION false
