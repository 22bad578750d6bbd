// SPDX-License-Identifier: MIT
#include "sateen/brdf/ggx.h"

#include <algorithm>
#include <cmath>

#include "sateen/brdf/quadrature.h"
#include "sateen/core/direction.h"

namespace sateen::brdf {

namespace {

/// The roughness ready for use: alphas clamped, directions turned into the frame of the axis.
struct Axes {
  double alpha_t, alpha_b, c, s;

  explicit Axes(const AnisotropicRoughness& roughness)
      : alpha_t(std::max(roughness.alpha_t, kMinimumAlpha)),
        alpha_b(std::max(roughness.alpha_b, kMinimumAlpha)),
        c(std::cos(roughness.azimuth)),
        s(std::sin(roughness.azimuth)) {}

  Vec3 into(const Vec3& v) const { return {c * v.x() + s * v.y(), c * v.y() - s * v.x(), v.z()}; }
  Vec3 out_of(const Vec3& v) const { return {c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()}; }

  double distribution(const Vec3& half) const {
    if (half.z() <= 0) return 0;
    const Vec3 h = into(half);
    const double x = h.x() / alpha_t;
    const double y = h.y() / alpha_b;
    const double q = x * x + y * y + h.z() * h.z();
    return 1 / (kPi * alpha_t * alpha_b * q * q);
  }

  double lambda(const Vec3& direction) const {
    const Vec3 v = into(direction);
    const double x = alpha_t * v.x();
    const double y = alpha_b * v.y();
    return (std::sqrt(1 + (x * x + y * y) / (v.z() * v.z())) - 1) / 2;
  }

  Vec3 sample_visible(const Vec3& view, const Vec2& sample) const {
    const Vec3 v = into(view);
    const Vec3 stretched = Vec3(alpha_t * v.x(), alpha_b * v.y(), v.z()).normalized();
    const double length = std::hypot(stretched.x(), stretched.y());
    const Vec3 first =
        length > 1e-12 ? Vec3(-stretched.y() / length, stretched.x() / length, 0) : Vec3::UnitX();
    const Vec3 second = stretched.cross(first);
    const double r = std::sqrt(sample.x());
    const double p = r * std::cos(2 * kPi * sample.y());
    const double blend = (1 + stretched.z()) / 2;
    double q = r * std::sin(2 * kPi * sample.y());
    q = (1 - blend) * std::sqrt(std::max(0.0, 1 - p * p)) + blend * q;
    const Vec3 n = p * first + q * second + std::sqrt(std::max(0.0, 1 - p * p - q * q)) * stretched;
    return out_of(Vec3(alpha_t * n.x(), alpha_b * n.y(), std::max(1e-12, n.z())).normalized());
  }
};

double schlick_weight(double cosine) {
  const double m = std::clamp(1 - cosine, 0.0, 1.0);
  return m * m * m * m * m;
}

}  // namespace

Mat2 roughness_matrix(const AnisotropicRoughness& roughness) {
  const Mat2 turn = Eigen::Rotation2Dd(roughness.azimuth).toRotationMatrix();
  return turn *
         Vec2(roughness.alpha_t * roughness.alpha_t, roughness.alpha_b * roughness.alpha_b).asDiagonal() *
         turn.transpose();
}

AnisotropicRoughness roughness_from_matrix(const Mat2& matrix) {
  const double mean = (matrix(0, 0) + matrix(1, 1)) / 2;
  const double difference = (matrix(0, 0) - matrix(1, 1)) / 2;
  const double mixed = (matrix(0, 1) + matrix(1, 0)) / 2;
  const double spread = std::hypot(difference, mixed);
  const auto alpha = [](double eigenvalue) {
    return std::sqrt(std::clamp(eigenvalue, kMinimumAlpha * kMinimumAlpha, 1.0));
  };
  return {alpha(mean + spread), alpha(mean - spread), wrap(std::atan2(mixed, difference) / 2, kPi)};
}

double ggx_distribution(const AnisotropicRoughness& roughness, const Vec3& half) {
  return Axes(roughness).distribution(half);
}

double ggx_lambda(const AnisotropicRoughness& roughness, const Vec3& direction) {
  return Axes(roughness).lambda(direction);
}

Vec3 fresnel_schlick(const Vec3& f0, double cosine) {
  return f0 + (Vec3::Ones() - f0) * schlick_weight(cosine);
}

Vec3 ggx_brdf(const AnisotropicRoughness& roughness, const Vec3& f0, const Vec3& light, const Vec3& view) {
  if (light.z() <= 0 || view.z() <= 0) return Vec3::Zero();
  const Axes axes(roughness);
  const Vec3 half = (light + view).normalized();
  const double masking = 4 * light.z() * view.z() * (1 + axes.lambda(light) + axes.lambda(view));
  return fresnel_schlick(f0, light.dot(half)) * (axes.distribution(half) / masking);
}

Vec3 ggx_sample_visible(const AnisotropicRoughness& roughness, const Vec3& view, const Vec2& sample) {
  return Axes(roughness).sample_visible(view, sample);
}

double ggx_visible_pdf(const AnisotropicRoughness& roughness, const Vec3& light, const Vec3& view) {
  if (view.z() <= 0) return 0;
  const Axes axes(roughness);
  const Vec3 half = (light + view).normalized();
  return axes.distribution(half) / ((1 + axes.lambda(view)) * 4 * view.z());
}

GgxAlbedo ggx_albedo(const AnisotropicRoughness& roughness, const Vec3& view, int order) {
  if (view.z() <= 0) return {};
  const Axes axes(roughness);
  const GaussRule& rule = gauss_rule(order);
  const double masking_view = 1 + axes.lambda(view);
  GgxAlbedo albedo;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
      const Vec3 half = axes.sample_visible(view, {rule.nodes[i], rule.nodes[j]});
      const double cosine = view.dot(half);
      const Vec3 light = 2 * cosine * half - view;
      if (light.z() <= 0) continue;
      // Every sample carries G2 / G1(v) (Heitz 2018).
      const double weight =
          rule.weights[i] * rule.weights[j] * masking_view / (masking_view + axes.lambda(light));
      const double fresnel = schlick_weight(cosine);
      albedo.scale += weight * (1 - fresnel);
      albedo.bias += weight * fresnel;
    }
  }
  return albedo;
}

double ggx_mean_albedo(const AnisotropicRoughness& roughness) {
  AnisotropicRoughness along = roughness;
  along.azimuth = 0;
  const GaussRule& rule = gauss_rule(12);
  double mean = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double cosine = std::sqrt(rule.nodes[i]);  // dw (n.w) = d(cosine^2) dphi / 2
    const double sine = std::sqrt(1 - rule.nodes[i]);
    for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
      const double phi = kPi / 2 * rule.nodes[j];
      const Vec3 view(sine * std::cos(phi), sine * std::sin(phi), cosine);
      mean += rule.weights[i] * rule.weights[j] * ggx_albedo(along, view, 24).total();
    }
  }
  return mean;
}

Vec3 ggx_multiple_scattering(const Vec3& f0, double albedo_light, double albedo_view, double mean_albedo) {
  if (mean_albedo >= 1 - 1e-9) return Vec3::Zero();
  const double lobe = (1 - albedo_light) * (1 - albedo_view) / (kPi * (1 - mean_albedo));
  // Schlick's Fresnel averaged over the hemisphere with the cosine; then the geometric series of further
  // bounces.
  const Vec3 mean_fresnel = f0 + (Vec3::Ones() - f0) / 21;
  const Vec3 bounces =
      mean_fresnel.array().square() * mean_albedo / (1 - mean_fresnel.array() * (1 - mean_albedo));
  return bounces * lobe;
}

}  // namespace sateen::brdf
