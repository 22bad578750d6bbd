// SPDX-License-Identifier: MIT
#include "sateen/matcap/blind_spot.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <vector>

namespace sateen::matcap {
namespace {

constexpr int kSpokes = 192;
constexpr int kRings = 40;                // the last one is the boundary
constexpr double kGuideFade = 6;          // the guiding gradient falls like (r / radius)^6
constexpr double kSlopeSpan = 0.1;        // radians over which the slope at the boundary is measured
constexpr double kSlopeSmoothing = 0.35;  // radians of azimuth

using Matrix = Eigen::SparseMatrix<double>;

Eigen::Index at(int ring, int spoke) {  // ring 1 .. kRings
  return 1 + static_cast<Eigen::Index>(ring - 1) * kSpokes + (spoke + kSpokes) % kSpokes;
}

/// Slopes of the colours towards the centre, per unit of ring distance, smoothed along the boundary.
Eigen::MatrixXd boundary_slopes(const Eigen::MatrixXd& edge, const Eigen::MatrixXd& outside,
                                double rings_between) {
  const Eigen::MatrixXd raw = (outside - edge) / rings_between;
  Eigen::MatrixXd smooth = Eigen::MatrixXd::Zero(3, kSpokes);
  const double sigma = kSlopeSmoothing * kSpokes / (2 * kPi);
  const int reach = static_cast<int>(3 * sigma);
  for (int i = 0; i < kSpokes; ++i) {
    double total = 0;
    for (int d = -reach; d <= reach; ++d) {
      const double weight = std::exp(-0.5 * d * d / (sigma * sigma));
      smooth.col(i) += weight * raw.col((i + d + 2 * kSpokes) % kSpokes);
      total += weight;
    }
    smooth.col(i) /= total;
  }
  return smooth;
}

/// Finite volumes on rings of spacing 1 and a round cell at the centre: the negated Laplacian of the inner
/// unknowns.
Matrix laplacian() {
  std::vector<Eigen::Triplet<double>> entries;
  const double turn = 2 * kPi / kSpokes;
  const Eigen::Index unknowns = at(kRings, 0);
  const auto connect = [&](Eigen::Index a, Eigen::Index b, double conductance) {
    entries.emplace_back(a, a, conductance);
    if (b >= unknowns) return;  // the boundary: a known value
    entries.emplace_back(b, b, conductance);
    entries.emplace_back(a, b, -conductance);
    entries.emplace_back(b, a, -conductance);
  };
  for (int spoke = 0; spoke < kSpokes; ++spoke) {
    connect(at(1, spoke), 0, 0.5 * turn);  // face at radius 1/2, nodes 1 apart
    for (int ring = 1; ring < kRings; ++ring) {
      connect(at(ring, spoke), at(ring + 1, spoke), (ring + 0.5) * turn);
      connect(at(ring, spoke), at(ring, spoke + 1), 1 / (ring * turn));
    }
  }
  Matrix matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

BlindSpot::BlindSpot(double angle, const std::function<Vec3(double, double)>& colour)
    : radius_(std::tan(angle / 2)), colours_(3, at(kRings, kSpokes - 1) + 1) {
  const double turn = 2 * kPi / kSpokes;
  Eigen::MatrixXd edge(3, kSpokes);
  Eigen::MatrixXd outside(3, kSpokes);
  for (int i = 0; i < kSpokes; ++i) {
    edge.col(i) = colour(0, i * turn);
    outside.col(i) = colour(kSlopeSpan, i * turn);
  }
  const double rings_between =
      radius_ > 0 ? (std::tan((angle + kSlopeSpan) / 2) - radius_) / radius_ * kRings : 1e9;
  const Eigen::MatrixXd slopes = boundary_slopes(edge, outside, rings_between);

  const Eigen::Index unknowns = at(kRings, 0);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(unknowns, 3);
  const auto guide = [&](double radius) { return std::pow(radius / kRings, kGuideFade); };
  for (int spoke = 0; spoke < kSpokes; ++spoke) {
    for (int ring = 0; ring < kRings; ++ring) {
      // The flux of the guiding gradient through the face between this ring and the next.
      const Vec3 flux = slopes.col(spoke) * (guide(ring + 0.5) * (ring + 0.5) * turn);
      const Eigen::Index inner = ring == 0 ? 0 : at(ring, spoke);
      right.row(inner) -= flux.transpose();
      if (ring + 1 < kRings) right.row(at(ring + 1, spoke)) += flux.transpose();
    }
    right.row(at(kRings - 1, spoke)) += (kRings - 0.5) * turn * edge.col(spoke).transpose();
  }
  // The same for every blind spot: factored once.
  static const Eigen::SimplicialLDLT<Matrix> solver(laplacian());
  colours_.leftCols(unknowns) = solver.solve(right).transpose().cwiseMax(0.0);
  colours_.rightCols(kSpokes) = edge;
}

Vec3 BlindSpot::operator()(const Vec3& direction) const {
  // The point of the back map, also of directions before the equator: large blind spots reach there.
  const Vec2 t = direction.head<2>() / (1 - direction.z());
  const double ring = radius_ > 0 ? std::min(t.norm() / radius_, 1.0) * kRings : kRings;
  const double spoke = std::atan2(t.y(), t.x()) / (2 * kPi) * kSpokes + kSpokes;
  const int i = std::min(static_cast<int>(ring), kRings - 1);
  const int j = static_cast<int>(spoke);
  const double fi = ring - i;
  const double fj = spoke - j;
  const auto on_ring = [&](int k) -> Vec3 {
    if (k == 0) return colours_.col(0);
    return (1 - fj) * colours_.col(at(k, j)) + fj * colours_.col(at(k, j + 1));
  };
  return (1 - fi) * on_ring(i) + fi * on_ring(i + 1);
}

}  // namespace sateen::matcap
