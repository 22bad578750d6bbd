// SPDX-License-Identifier: MIT
#include "sateen/capture/turning/dropped.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/median.h"
#include "sateen/core/vector.h"

namespace sateen::capture {

const char* words(Dropped dropped) {
  switch (dropped) {
    case Dropped::no:
      break;
    case Dropped::blurred:
      return "blurred";
    case Dropped::no_angle:
      return "its angle cannot be found";
    case Dropped::dark:
      return "much darker than the others";
    case Dropped::same_angle:
      return "shows the same angle as the frame before";
  }
  return "";
}

std::vector<std::size_t> used_frames(std::span<const Dropped> dropped) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < dropped.size(); ++i) {
    if (dropped[i] == Dropped::no) indices.push_back(i);
  }
  return indices;
}

std::vector<Dropped> blurred_or_dark(std::span<const double> sharpness, std::span<const double> light) {
  const std::size_t n = sharpness.size();
  const double bright = median(std::vector<double>(light.begin(), light.end()));
  std::vector<Dropped> dropped(n, Dropped::no);
  for (std::size_t i = 0; i < n; ++i) {
    // Shading changes the detail slowly along the turn: blur stands out against the frames around.
    const auto first = static_cast<std::ptrdiff_t>(i > 4 ? i - 4 : 0);
    const auto end = static_cast<std::ptrdiff_t>(std::min(n, i + 5));
    const std::vector<double> near(sharpness.begin() + first, sharpness.begin() + end);
    if (sharpness[i] < 0.6 * median(near)) dropped[i] = Dropped::blurred;
    if (light[i] < 0.1 * bright) dropped[i] = Dropped::dark;
  }
  return dropped;
}

std::vector<Dropped> without_repeated(std::vector<Dropped> dropped, std::span<const double> turned) {
  const std::vector<std::size_t> indices = used_frames(dropped);
  if (indices.size() < 2) return dropped;
  const auto step = [&](std::size_t from, std::size_t to) {
    return std::abs(std::remainder(turned[to] - turned[from], 2 * kPi));
  };
  std::vector<double> steps;
  for (std::size_t k = 1; k < indices.size(); ++k) steps.push_back(step(indices[k - 1], indices[k]));
  const double typical = median(steps);
  std::size_t kept = indices[0];
  for (std::size_t k = 1; k < indices.size(); ++k) {
    if (step(kept, indices[k]) < 0.1 * typical) {
      dropped[indices[k]] = Dropped::same_angle;
    } else {
      kept = indices[k];
    }
  }
  return dropped;
}

}  // namespace sateen::capture
