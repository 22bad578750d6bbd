// SPDX-License-Identifier: MIT
#include "sateen/capture/turning/turn.h"

#include <algorithm>

#include <fmt/format.h>

namespace sateen::capture {
namespace {

constexpr double kDoubtful = radians(0.6);  // above it is no registration noise
constexpr double kWrong = radians(10);      // above it known angles are not those of the pictures

}  // namespace

std::vector<std::string> advice(const Turn& turn) {
  std::vector<std::string> warnings;
  if (turn.widest_gap > std::max(radians(10), 2.5 * turn.even_gap)) {
    warnings.push_back(fmt::format(
        "between two frames the sphere turned by {:.0f} degrees: the material is interpolated there. Turn "
        "it more evenly",
        degrees(turn.widest_gap)));
  }
  if (turn.known_off > kWrong) {
    const bool reversed = turn.reversed_off < kWrong;
    warnings.push_back(
        reversed
            ? std::string(
                  "in the pictures the sphere turns the other way than the angles given: the table is "
                  "wrong. Swap --direction (of a live capture: --reverse), or find the angles with "
                  "--angles pictures")
            : fmt::format("the angles given are not those of the pictures, which differ from them by {:.0f} "
                          "degrees (median): the table is wrong. Check --angles, or find them with --angles "
                          "pictures",
                          degrees(turn.known_off)));
  } else if (turn.contradiction > kDoubtful) {
    warnings.push_back(fmt::format(
        "the frames' angles are doubtful: parts of the sphere contradict them by {:.1f} degrees. The axis "
        "may "
        "be tilted too far, the surface may move on the sphere or show too little detail. Point the axis at "
        "the lens, or give the stage's angles (--angles)",
        degrees(turn.contradiction)));
  }
  return warnings;
}

}  // namespace sateen::capture
