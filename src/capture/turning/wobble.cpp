// SPDX-License-Identifier: MIT
#include "sateen/capture/turning/wobble.h"

#include <algorithm>

#include "sateen/core/median.h"

namespace sateen::capture {

Wobble fit_wobble(const std::vector<Vec2>& centres, const std::vector<double>& angles) {
  Wobble wobble;
  std::vector<double> weights(centres.size(), 1);
  for (int round = 0; round < 4; ++round) {
    Mat3 normal = Mat3::Identity() * 1e-9;
    Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
    for (std::size_t i = 0; i < centres.size(); ++i) {
      const Vec3 row(1, std::cos(angles[i]), std::sin(angles[i]));
      normal += weights[i] * row * row.transpose();
      right += weights[i] * row * centres[i].transpose();
    }
    const Eigen::Matrix<double, 3, 2> solution = normal.inverse() * right;
    wobble.middle = solution.row(0).transpose();
    wobble.cosine = solution.row(1).transpose();
    wobble.sine = solution.row(2).transpose();
    std::vector<double> errors;
    for (std::size_t i = 0; i < centres.size(); ++i)
      errors.push_back((centres[i] - wobble.at(angles[i])).norm());
    const double scale = 3 * std::max(0.02, median(errors));
    double squares = 0;
    for (std::size_t i = 0; i < centres.size(); ++i) {
      weights[i] = errors[i] < scale ? 1 : scale / errors[i];
      squares += errors[i] * errors[i];
    }
    wobble.rms = std::sqrt(squares / static_cast<double>(centres.size()));
  }
  return wobble;
}

}  // namespace sateen::capture
