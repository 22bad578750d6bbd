// SPDX-License-Identifier: MIT
// A layered material whose fibres come from a map. In front of layered.glsl.

#define LAYERED_FIBRE_MAP true
