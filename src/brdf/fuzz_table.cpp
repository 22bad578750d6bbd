// SPDX-License-Identifier: MIT
#include "sateen/brdf/fuzz_table.h"

#include <algorithm>
#include <cmath>

#include "sateen/brdf/fuzz_approximations.h"
#include "sateen/brdf/fuzz_integrals.h"
#include "sateen/brdf/quadrature.h"

namespace sateen::brdf {

namespace {

constexpr int kOrder = 20;
// Lobes of alpha 0.1 need the fine direction; P_s changes less along it, and hardly along a cone.
constexpr int kAmbientAlong = 129;
constexpr int kAmbientAcross = 33;
constexpr int kDownAlong = 65;
constexpr int kDownAcross = 17;

/// One light or view of the cubature, with everything that does not depend on the table's own direction.
struct Node {
  Vec3 direction;
  double weight;   ///< solid angle
  double along;    ///< cosine to the fibre
  double area;     ///< sigma
  double passing;  ///< exp(-d / z)
};

/// The nodes that serve every direction whose cosine to the fibre is `cosine`: the lobe peaks on the same
/// cones for all of them.
std::vector<Node> nodes_about(const FuzzParameters& fuzz, const Vec3& fibre, double cosine) {
  const double peak = kPi - std::acos(std::clamp(cosine, -1.0, 1.0));
  const double width = fuzz.phase == FuzzPhase::schlick ? std::sqrt(1 - std::abs(fuzz.k)) : fuzz.alpha;
  const std::array<double, 3> cones{peak, peak - 3 * width, peak + 3 * width};
  const std::vector<SphereNode> directions = hemisphere_nodes(fibre, cones, kOrder);
  std::vector<Node> nodes;
  nodes.reserve(directions.size());
  for (const SphereNode& node : directions) {
    const double along = node.direction.dot(fibre);
    nodes.push_back({node.direction, node.weight, along, fuzz_projected_area(fuzz.alpha, along),
                     fuzz_passing(fuzz.density, node.direction)});
  }
  return nodes;
}

/// fuzz_phase of two directions for which `along` and `area` are known.
class Phase {
 public:
  explicit Phase(const FuzzParameters& fuzz)
      : kind_(fuzz.phase), squared_alpha_(fuzz.alpha * fuzz.alpha), k_(fuzz.k) {
    scale_ = kind_ == FuzzPhase::schlick ? fuzz_schlick_normalisation(k_) * (1 - k_ * k_) / (4 * kPi)
                                         : squared_alpha_ * fuzz.alpha / (4 * kPi);
  }

  double operator()(const Node& light, const Node& view) const {
    // Of the sum of both: its square, and its part along the fibre.
    const double squared = std::max(2 + 2 * light.direction.dot(view.direction), 1e-24);
    const double along = light.along + view.along;
    if (kind_ == FuzzPhase::schlick) {
      const double q = 1 - k_ * std::sqrt(std::max(1 - along * along / squared, 0.0));
      return scale_ / (q * q);
    }
    const double q = along * along * (1 - squared_alpha_) + squared_alpha_ * squared;
    const double area = kind_ == FuzzPhase::sggx_symmetric ? std::max(light.area, view.area) : light.area;
    return scale_ * squared * squared / (q * q * area);
  }

 private:
  FuzzPhase kind_;
  double squared_alpha_;
  double k_;
  double scale_;
};

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

FuzzTable make_fuzz_table(const FuzzParameters& parameters) {
  FuzzParameters fuzz = parameters;
  fuzz.azimuth = 0;
  if (std::sin(fuzz.tilt) < kUprightTilt) fuzz.tilt = kUprightTilt;
  fuzz.colour = Vec3::Ones();
  // At zero density response and visibility vanish together: their ratio has a limit, taken just above.
  fuzz.density = std::max(fuzz.density, 1e-4);
  const Vec3 fibre = fuzz.fibre();
  FuzzTable table;
  const Phase phase(fuzz);
  const auto node_of = [&](const Vec3& w) {
    const double along = w.dot(fibre);
    return Node{w, 1, along, fuzz_projected_area(fuzz.alpha, along), fuzz_passing(fuzz.density, w)};
  };
  table.scattered_down = FibreTable(fibre, kDownAlong, kDownAcross, [&](double cosine) -> FibreTable::Column {
    return [&, nodes = nodes_about(fuzz, fibre, cosine)](const Vec3& w) {
      const Node light = node_of(w);
      double up = 0;
      for (const Node& view : nodes) up += view.weight * phase(light, view);
      return Vec4(1 - up, 0, 0, 0);
    };
  });
  table.ambient = FibreTable(fibre, kAmbientAlong, kAmbientAcross, [&](double cosine) -> FibreTable::Column {
    return [&, nodes = nodes_about(fuzz, fibre, cosine)](const Vec3& w) {
      // The response's first moment besides its total, in one pass.
      const Node view = node_of(w);
      Vec3 mean = Vec3::Zero();
      double total = 0;
      for (const Node& light : nodes) {
        // fuzz_brdf times the cosine; the exponential of both crossings is the product of each one's.
        const double z = light.direction.z();
        const double f = light.weight * phase(light, view) * (1 - light.passing * view.passing) * z /
                         (z + view.direction.z());
        mean += f * light.direction;
        total += f;
      }
      mean /= total;
      return Vec4(mean.x(), mean.y() / w.y(), mean.z(), total / fuzz_visibility_slides(fuzz.density, w.z()));
    };
  });
  table.passing = fuzz_passing_albedo(parameters.density);
  integrate_bands(table, parameters.density);
  return table;
}

}  // namespace sateen::brdf
