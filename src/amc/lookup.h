// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/amc/table.h"

namespace sateen::amc {

/// The colour for a unit normal (eye frame, z towards the eye) and a tangent angle k in turns (any real
/// number): trilinear, clamped in the normal, cyclic in k, exact at texel centres. The arithmetic is what
/// OpenGL does with a linear-filtered 3D texture at ((n_x + 1)/2, (n_y + 1)/2, R k + 0.5/S_k).
Vec3 lookup(const AmcTable& table, const Vec3& normal, double tangent_angle);

/// The same for a tangent vector of any length; its picture-plane direction counts (equation 3).
Vec3 lookup(const AmcTable& table, const Vec3& normal, const Vec3& tangent);

}  // namespace sateen::amc
