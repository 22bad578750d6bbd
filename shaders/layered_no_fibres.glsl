// SPDX-License-Identifier: MIT
// A layered material whose diffuse base is Lambert's. In front of layered.glsl.

#define LAYERED_FIBRES false
