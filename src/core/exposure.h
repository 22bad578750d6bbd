// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/image.h"

namespace sateen {

/// The exposure, in stops, that shows a picture of scene light well: the smaller of two.
///   - The logarithmic mean of the covered pixels' brightest channels becomes middle grey, 0.18 (by
///     luminance, a deep red would be lifted to a pale one). Pixels more than eight stops below the
///     brightest ones count as eight below, so that black corners do not decide.
///   - The brightest ones stay within what a display shows: the brightest channel that only two in a hundred
///     covered pixels exceed becomes at most 1.
/// Covered are pixels with an alpha above 0, or all without a fourth channel; associated colour is divided by
/// it. Pixels that are not finite do not count. A picture with nothing but black gives 0. Light times 2^n
/// gives the result minus n.
double automatic_exposure(const Image& light);

}  // namespace sateen
