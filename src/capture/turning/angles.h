// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

namespace sateen::capture {

/// Angles (radians) made continuous: each differs from the one before by less than half a turn.
std::vector<double> unwrapped(std::span<const double> angles);

/// Equal steps, when that is what angles are to within registration noise: theta = first + step * index.
struct EqualSteps {
  bool found = false;
  double first = 0;  ///< radians
  double step = 0;   ///< radians, exactly a whole number of turns over the sequence when it is that close
  double rms = 0;    ///< radians, of the deviations
};

/// `indices` are the frames' places in the sequence: dropped frames leave their places. A stage with equal
/// steps is far likelier than a hand that happens to make them, so `noise` (radians, rms) is generous.
EqualSteps equal_steps(std::span<const int> indices, std::span<const double> angles, int sequence,
                       double noise);

/// The widest gap between neighbouring angles on the circle of `period` radians, and the middle (median) one.
struct Coverage {
  double widest = 0;
  double median = 0;
};
Coverage coverage(std::span<const double> angles, double period);

}  // namespace sateen::capture
