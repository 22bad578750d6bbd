// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/amc/table.h"

namespace sateen::amc {

/// A contact sheet like figures 3 and 6 of Magri et al.: `columns` x `rows` slices spread over the period,
/// each under its angle in degrees, and the two orthogonal cuts through the middle (n_x against k, n_y
/// against k). RGB, linear.
Image contact_sheet(const AmcTable& table, int columns = 4, int rows = 2);

}  // namespace sateen::amc
