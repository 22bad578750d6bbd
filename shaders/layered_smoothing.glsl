// SPDX-License-Identifier: MIT
// A layered material whose fuzz has a smoother normal than the layers below. In front of layered.glsl.

#define LAYERED_FUZZ_SMOOTHING true
