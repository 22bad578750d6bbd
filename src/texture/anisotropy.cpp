// SPDX-License-Identifier: MIT
#include "sateen/texture/anisotropy.h"

#include <fmt/format.h>

#include "sateen/core/error.h"

namespace sateen::texture {
namespace {

constexpr double kMinEigenvalue = brdf::kMinimumAlpha * brdf::kMinimumAlpha;

struct Eigen2 {
  double large;
  double small;
  double angle;  ///< of the large one's axis, (-pi/2, pi/2]
};

Eigen2 eigenvalues(const Mat2& s) {
  const double mean = (s(0, 0) + s(1, 1)) / 2;
  const double half = (s(0, 0) - s(1, 1)) / 2;
  const double radius = std::hypot(half, s(0, 1));
  return {mean + radius, mean - radius, radius > 0 ? std::atan2(s(0, 1), half) / 2 : 0};
}

Mat2 symmetric(double large, double small, double angle) {
  const double mean = (large + small) / 2;
  const double c = (large - small) / 2 * std::cos(2 * angle);
  const double d = (large - small) / 2 * std::sin(2 * angle);
  Mat2 m;
  m << mean + c, d, d, mean - c;
  return m;
}

}  // namespace

Mat2 guarded(const Mat2& s) {
  // Most matrices are well inside; the bounds are checked without a square root.
  const double trace = s(0, 0) + s(1, 1);
  const double det = s.determinant();
  const bool below =
      det - kMinEigenvalue * trace + kMinEigenvalue * kMinEigenvalue < 0 || trace < 2 * kMinEigenvalue;
  const bool above = 1 - trace + det < 0 || trace > 2;
  if (!below && !above) return s;
  const Eigen2 e = eigenvalues(s);
  return symmetric(std::clamp(e.large, kMinEigenvalue, 1.0), std::clamp(e.small, kMinEigenvalue, 1.0),
                   e.angle);
}

AnisotropyEncoding anisotropy_encoding_from_name(const std::string& name) {
  if (name == "root") return AnisotropyEncoding::root;
  if (name == "correlation") return AnisotropyEncoding::correlation;
  throw Error(fmt::format("unknown encoding {}: use root or correlation", name));
}

std::string name_of(AnisotropyEncoding encoding) {
  return encoding == AnisotropyEncoding::root ? "root" : "correlation";
}

Vec3 encode_anisotropy(const Mat2& s, AnisotropyEncoding encoding) {
  const Mat2 g = guarded(s);
  if (encoding == AnisotropyEncoding::correlation) {
    const double x = std::sqrt(g(0, 0));
    const double y = std::sqrt(g(1, 1));
    return {x, std::clamp(g(0, 1) / (2 * x * y) + 0.5, 0.0, 1.0), y};
  }
  // Square root of a 2 x 2 positive matrix by Cayley-Hamilton.
  const double root_det = std::sqrt(std::max(g.determinant(), 0.0));
  const double root_trace = std::sqrt(g(0, 0) + g(1, 1) + 2 * root_det);
  return {(g(0, 0) + root_det) / root_trace, g(0, 1) / root_trace + 0.5, (g(1, 1) + root_det) / root_trace};
}

Mat2 decode_anisotropy(const Vec3& channels, AnisotropyEncoding encoding) {
  Mat2 s;
  if (encoding == AnisotropyEncoding::correlation) {
    const double xy = channels[0] * (2 * channels[1] - 1) * channels[2];
    s << channels[0] * channels[0], xy, xy, channels[2] * channels[2];
  } else {
    const double x = channels[0];
    const double y = channels[2];
    const double q = channels[1] - 0.5;
    s << x * x + q * q, q * (x + y), q * (x + y), y * y + q * q;
  }
  return s;
}

Mat3 sroughness_matrix(const Vec3& normal, const Mat2& s) {
  Mat3 inner = Mat3::Zero();
  inner.topLeftCorner<2, 2>() = s;
  inner(2, 2) = 1;
  const Mat3 m = normal_frame(normal);
  return m * inner * m.transpose();
}

Vec3 principal_axis(const Mat3& s, const Vec3& fallback) {
  constexpr double kUncertain = 0.2;
  constexpr double kCertain = 0.4;
  // Largest eigenvalue by the trigonometric solution of the characteristic polynomial.
  const double mean = s.trace() / 3;
  const Mat3 d = s - mean * Mat3::Identity();
  const double spread = std::sqrt(d.squaredNorm() / 6);
  if (!(spread > 1e-12 * std::abs(mean))) return fallback;
  const double r = std::clamp(d.determinant() / (2 * spread * spread * spread), -1.0, 1.0);
  const double angle = std::acos(r) / 3;
  const double largest = mean + 2 * spread * std::cos(angle);
  const double middle = mean + 2 * spread * std::cos(angle - 2 * kPi / 3);
  const double gap = (largest - middle) / largest;
  if (!(gap > kUncertain)) return fallback;
  // adj(S - lambda I) = (difference of eigenvalues)^2 v v^T: any column of it is v; the longest is the
  // safest.
  const Mat3 a = s - largest * Mat3::Identity();
  const Vec3 columns[3] = {a.col(1).cross(a.col(2)), a.col(2).cross(a.col(0)), a.col(0).cross(a.col(1))};
  const Vec3* best = &columns[0];
  for (const Vec3& column : columns) {
    if (column.squaredNorm() > best->squaredNorm()) best = &column;
  }
  const double length = best->norm();
  if (!(length > 0)) return fallback;
  Vec3 axis = *best / length;
  if (axis.dot(fallback) < 0) axis = -axis;
  if (gap >= kCertain) return axis;
  const double x = (gap - kUncertain) / (kCertain - kUncertain);
  return (fallback + x * x * (3 - 2 * x) * (axis - fallback)).normalized();
}

Vec3 principal_axis_by_power_iteration(const Mat3& s, int steps) {
  Vec3 n = Vec3::UnitZ();
  for (int i = 0; i < steps; ++i) {
    const Vec3 next = s * n;
    const double length = next.norm();
    if (!(length > 0)) break;
    n = next / length;
  }
  return n;
}

Mat2 tangent_part(const Mat3& s, const Vec3& normal) {
  const Mat3 m = normal_frame(normal);
  const Mat3 local = m.transpose() * s * m;
  const double scale = 1 / std::max(local(2, 2), 1e-12);
  return local.topLeftCorner<2, 2>() * scale;
}

}  // namespace sateen::texture
