// SPDX-License-Identifier: MIT
#include "sateen/brdf/fuzz_table.h"

#include <algorithm>
#include <cmath>

#include "sateen/brdf/fuzz_approximations.h"
#include "sateen/brdf/fuzz_integrals.h"
#include "sateen/brdf/quadrature.h"

namespace sateen {

namespace {

constexpr int kOrder = 20;
// Lobes of alpha 0.1 need the fine direction; P_s changes less along it, and hardly along a cone.
constexpr int kAmbientAlong = 129;
constexpr int kAmbientAcross = 33;
constexpr int kDownAlong = 65;
constexpr int kDownAcross = 17;

std::vector<SphereNode> nodes_about(const FuzzParameters& fuzz, const Vec3& fixed) {
  const double peak = kPi - std::acos(std::clamp(fixed.dot(fuzz.fibre()), -1.0, 1.0));
  const double width = fuzz.phase == FuzzPhase::schlick ? std::sqrt(1 - std::abs(fuzz.k)) : fuzz.alpha;
  const std::array<double, 3> cones{peak, peak - 3 * width, peak + 3 * width};
  return hemisphere_nodes(fuzz.fibre(), cones, kOrder);
}

/// Bands by a product rule over the table's own P_s, which is even about the fibre's plane.
void integrate_bands(FuzzTable& table, double density) {
  table.passing_bands = {0, 0, 0};
  const GaussRule& rule = gauss_rule(24);
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    // Nodes gather where light grazes and P_p opens: cosine = s^2, and du (u.n) = cosine dcosine dphi.
    const double cosine = rule.nodes[i] * rule.nodes[i];
    const double sine = std::sqrt(1 - cosine * cosine);
    const double weight = rule.weights[i] * 2 * rule.nodes[i] * 2 * cosine;
    const std::array<double, 3> legendre{1, cosine, 1.5 * cosine * cosine - 0.5};
    const double passing = std::exp(-density / cosine);
    double down = 0;
    for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
      const double phi = kPi * rule.nodes[j];
      const Vec3 light(sine * std::cos(phi), sine * std::sin(phi), cosine);
      down += rule.weights[j] * table.scattered_down(light).x();
    }
    table.scattered_down_mean += weight * down;
    for (std::size_t l = 0; l < 3; ++l) {
      table.passing_bands[l] += weight * passing * legendre[l];
      table.scattered_bands[l] += weight * (1 - passing) * down * legendre[l];
    }
  }
}

}  // namespace

Vec3 FuzzTable::mean_direction(const Vec3& view) const {
  const Vec4 read = ambient(view);
  return {read.x(), read.y() * view.y(), read.z()};
}

FuzzTable make_fuzz_table(const FuzzParameters& parameters) {
  FuzzParameters fuzz = parameters;
  fuzz.azimuth = 0;
  fuzz.colour = Vec3::Ones();
  // At zero density response and visibility vanish together: their ratio has a limit, taken just above.
  fuzz.density = std::max(fuzz.density, 1e-4);
  const Vec3 fibre = fuzz.fibre();
  FuzzTable table;
  table.scattered_down = FibreTable(fibre, kDownAlong, kDownAcross, [&](const Vec3& light) {
    double up = 0;
    for (const SphereNode& node : nodes_about(fuzz, light)) {
      up += node.weight * fuzz_phase(fuzz, light, node.direction);
    }
    return Vec4(1 - up, 0, 0, 0);
  });
  table.ambient = FibreTable(fibre, kAmbientAlong, kAmbientAcross, [&](const Vec3& view) {
    // The response's first moment besides its total, in one pass.
    Vec4 sum = Vec4::Zero();
    for (const SphereNode& node : nodes_about(fuzz, view)) {
      const Vec3& light = node.direction;
      const double f = node.weight * fuzz_brdf(fuzz, light, view).x() * std::max(0.0, light.z());
      sum += f * Vec4(light.x(), light.y(), light.z(), 1);
    }
    const Vec3 mean = sum.head<3>() / sum.w();
    return Vec4(mean.x(), mean.y() / view.y(), mean.z(),
                sum.w() / fuzz_visibility_slides(fuzz.density, view.z()));
  });
  table.passing = fuzz_passing_albedo(parameters.density);
  integrate_bands(table, parameters.density);
  return table;
}

}  // namespace sateen
