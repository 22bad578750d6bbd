// SPDX-License-Identifier: MIT
#include "sateen/brdf/fuzz_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sateen/brdf/fuzz_approximations.h"
#include "sateen/brdf/fuzz_integrals.h"
#include "sateen/brdf/quadrature.h"

namespace sateen {

namespace {

constexpr int kOrder = 20;

std::vector<SphereNode> nodes_about(const FuzzParameters& fuzz, const Vec3& fixed) {
  const double peak = kPi - std::acos(std::clamp(fixed.dot(fuzz.fibre()), -1.0, 1.0));
  const double width = fuzz.phase == FuzzPhase::schlick ? std::sqrt(1 - std::abs(fuzz.k)) : fuzz.alpha;
  const std::array<double, 3> cones{peak, peak - 3 * width, peak + 3 * width};
  return hemisphere_nodes(fuzz.fibre(), cones, kOrder);
}

}  // namespace

FuzzTable make_fuzz_table(const FuzzParameters& parameters, int size) {
  FuzzParameters fuzz = parameters;
  fuzz.azimuth = 0;
  fuzz.colour = Vec3::Ones();
  // At zero density response and visibility vanish together: their ratio has a limit, taken just above.
  fuzz.density = std::max(fuzz.density, 1e-4);
  // The response's first moment besides its total, in one pass; the horizon itself is approached, not
  // reached.
  const auto lifted = [](const Vec3& w) { return Vec3(w.x(), w.y(), std::max(w.z(), 1e-4)).normalized(); };
  const auto response = [&](const Vec3& view) {
    Vec4 sum = Vec4::Zero();
    for (const SphereNode& node : nodes_about(fuzz, view)) {
      const double f =
          node.weight * fuzz_brdf(fuzz, node.direction, view).x() * std::max(0.0, node.direction.z());
      sum += f * Vec4(node.direction.x(), node.direction.y(), node.direction.z(), 1);
    }
    return sum;
  };
  FuzzTable table;
  table.scattering = HemisphereTable(size, [&](const Vec3& direction) {
    const Vec3 w = lifted(direction);
    double up = 0;
    for (const SphereNode& node : nodes_about(fuzz, w))
      up += node.weight * fuzz_phase(fuzz, w, node.direction);
    return Vec4(1 - up, response(w).w() / fuzz_visibility_slides(fuzz.density, w.z()), 0, 0);
  });
  table.gaze = HemisphereTable(size, [&](const Vec3& direction) {
    const Vec4 sum = response(lifted(direction));
    const Vec3 mean = sum.head<3>() / sum.w();
    return Vec4(mean.x(), mean.y(), mean.z(), 0);
  });
  table.passing = fuzz_passing_albedo(parameters.density);
  // R by a product rule over the table's own P_s, which is even about the fibre's plane.
  const GaussRule& rule = gauss_rule(24);
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double cosine = std::sqrt(rule.nodes[i]);
    const double sine = std::sqrt(1 - rule.nodes[i]);
    for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
      const double phi = kPi * rule.nodes[j];
      const Vec3 light(sine * std::cos(phi), sine * std::sin(phi), cosine);
      table.scattered_down += rule.weights[i] * rule.weights[j] * table.scattering(light).x();
    }
  }
  return table;
}

}  // namespace sateen
