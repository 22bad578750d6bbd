// SPDX-License-Identifier: MIT
#include "sateen/texture/lobe_filter.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "sateen/core/error.h"

namespace sateen::texture {
namespace {

constexpr std::array<std::pair<FilterMethod, const char*>, 4> kNames{
    {{FilterMethod::sggx, "sggx"},
     {FilterMethod::sggx_variance, "sggx-variance"},
     {FilterMethod::lean, "lean"},
     {FilterMethod::naive, "naive"}}};

// Steeper normals would give LEAN infinite slopes: 87 degrees.
constexpr double kMinZ = 0.05;

/// The upper triangle, row by row, of sroughness_matrix(n, s) + (times - 1) n n^T, without the zeros of its
/// product.
void store_sggx(const Vec3& n, const Mat2& s, double times, std::span<float, kMoments> out) {
  const double k = 1 / std::max(1 + n.z(), 1e-9);
  const double u[3] = {1 - n.x() * n.x() * k, -n.x() * n.y() * k, -n.x()};
  const double v[3] = {u[1], 1 - n.y() * n.y() * k, -n.y()};
  std::size_t at = 0;
  for (int i = 0; i < 3; ++i) {
    const double a = s(0, 0) * u[i] + s(0, 1) * v[i];
    const double b = s(0, 1) * u[i] + s(1, 1) * v[i];
    const double c = times * n[i];
    for (int j = i; j < 3; ++j) out[at++] = static_cast<float>(a * u[j] + b * v[j] + c * n[j]);
  }
}

Mat3 load(std::span<const float, kMoments> v) {
  Mat3 s;
  s << v[0], v[1], v[2], v[1], v[3], v[4], v[2], v[4], v[5];
  return s;
}

Vec3 upright(Vec3 n) {
  n.z() = std::max(n.z(), 0.0);
  const double length = n.norm();
  if (!(length > 1e-9)) return Vec3::UnitZ();
  n /= length;
  if (n.z() >= 1e-3) return n;
  n.z() = 1e-3;
  return n.normalized();
}

}  // namespace

FilterMethod filter_method_from_name(const std::string& name) {
  for (const auto& [method, known] : kNames) {
    if (name == known) return method;
  }
  throw Error(fmt::format("unknown filter method {}: use sggx, sggx-variance, lean or naive", name));
}

std::string name_of(FilterMethod method) {
  return std::ranges::find(kNames, method, &std::pair<FilterMethod, const char*>::first)->second;
}

Mat2 isotropic_matrix(const Mat2& s) {
  return Mat2::Identity() * (s.trace() / 2);
}

void pack_moments(const LobeTexel& texel, const FilterOptions& options, std::span<float, kMoments> out) {
  const Vec3& n = texel.normal;
  switch (options.method) {
    case FilterMethod::sggx:
    case FilterMethod::sggx_variance: {
      store_sggx(n, texel.s, options.method == FilterMethod::sggx_variance ? 2 : 1, out);
      for (int i = 0; i < 3; ++i) out[static_cast<std::size_t>(6 + i)] = static_cast<float>(n[i]);
      break;
    }
    case FilterMethod::lean: {
      const Vec2 slope = n.head<2>() / std::max(n.z(), kMinZ);
      const Mat2 second = slope * slope.transpose() + texel.s / 2;
      const double v[kMoments] = {slope.x(), slope.y(), second(0, 0), second(0, 1), second(1, 1), 0, 0, 0, 0};
      std::ranges::transform(v, out.begin(), [](double x) { return static_cast<float>(x); });
      break;
    }
    case FilterMethod::naive: {
      const Vec3 channels = encode_anisotropy(texel.s, options.encoding);
      const double v[kMoments] = {n.x(), n.y(), n.z(), channels[0], channels[1], channels[2], 0, 0, 0};
      std::ranges::transform(v, out.begin(), [](double x) { return static_cast<float>(x); });
      break;
    }
  }
}

LobeTexel unpack_moments(std::span<const float, kMoments> v, const FilterOptions& options) {
  LobeTexel texel;
  switch (options.method) {
    case FilterMethod::sggx:
    case FilterMethod::sggx_variance: {
      Mat3 s = load(v);
      const Vec3 mean(v[6], v[7], v[8]);
      if (options.method == FilterMethod::sggx_variance) s -= mean * mean.transpose();
      texel.normal = upright(options.solver == NormalSolver::eigen ? principal_axis(s, upright(mean))
                                                                   : principal_axis_by_power_iteration(s));
      texel.s = guarded(tangent_part(s, texel.normal));
      break;
    }
    case FilterMethod::lean: {
      const Vec2 slope(v[0], v[1]);
      Mat2 second;
      second << v[2], v[3], v[3], v[4];
      texel.normal = Vec3(slope.x(), slope.y(), 1).normalized();
      texel.s = guarded(2 * (second - slope * slope.transpose()));
      break;
    }
    case FilterMethod::naive: {
      texel.normal = upright({v[0], v[1], v[2]});
      texel.s = guarded(decode_anisotropy({v[3], v[4], v[5]}, options.encoding));
      break;
    }
  }
  if (options.isotropic) texel.s = isotropic_matrix(texel.s);
  return texel;
}

}  // namespace sateen::texture
