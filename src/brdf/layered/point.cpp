// SPDX-License-Identifier: MIT
#include "sateen/brdf/layered/point.h"

#include <algorithm>
#include <cmath>

#include "sateen/brdf/fuzz_approximations.h"
#include "sateen/brdf/ggx_surroundings.h"
#include "sateen/core/colour.h"

namespace sateen::brdf {
namespace {

Vec3 fuzz_normal(const LayeredMaterial& material, const appearance::Surface& surface) {
  if (material.fuzz_smoothing == 0) return surface.normal;
  const Vec3 blend =
      (1 - material.fuzz_smoothing) * surface.normal + material.fuzz_smoothing * surface.mesh_normal;
  return blend.norm() > 1e-6 ? blend.normalized() : surface.normal;
}

}  // namespace

LightBands bands_of(const LayeredMaterial& material, const std::array<double, 3>& passing,
                    const std::array<double, 3>& scattered) {
  const Vec3 colour = material.fuzz && material.fuzz_scattered_down ? material.fuzz->colour : Vec3::Zero();
  LightBands bands;
  for (std::size_t l = 0; l < 3; ++l) bands[l] = Vec3::Constant(passing[l]) + colour * scattered[l];
  return bands;
}

int lobe_lookups(const LayeredMaterial& material) {
  if (material.lobe_samples > 0 || !material.specular) return std::max(1, material.lobe_samples);
  return material.specular->roughness.alpha_t == material.specular->roughness.alpha_b ? 1 : 8;
}

LightBands bands_under_fuzz(const LayeredMaterial& material, const LayeredTables& tables) {
  if (!material.fuzz || material.fuzz_fibres) return bare_bands();
  return bands_of(material, tables.fuzz->table.passing_bands, tables.fuzz->table.scattered_bands);
}

LayeredPoint::LayeredPoint(const LayeredMaterial& material, const LayeredTables& tables,
                           const appearance::Surface& surface)
    : material_(material),
      tables_(tables),
      frame_(surface, surface.normal),
      fuzz_frame_(surface, fuzz_normal(material, surface)),
      fuzz_(material.fuzz.value_or(FuzzParameters{})),
      bands_(bands_under_fuzz(material, tables)) {
  if (material.specular) view_total_ = ggx_total(frame_.view);
  if (!material.fuzz || !material.fuzz_fibres) return;
  const Vec3 fibre = material.fuzz_fibres->fibre(surface.uv);
  fuzz_.tilt = std::atan2(fibre.head<2>().norm(), fibre.z());
  fuzz_.azimuth = std::atan2(fibre.y(), fibre.x());
  const FuzzTiltTable& tilts = *tables.fuzz->tilts;
  bands_ = bands_of(material, tilts.passing_bands(), tilts.scattered_bands(fibre));
}

double LayeredPoint::ggx_total(const Vec3& direction) const {
  const Vec4 read = tables_.ggx->albedo(turned(direction, material_.specular->roughness.azimuth));
  return read.x() + read.y();
}

Vec3 LayeredPoint::base_lit(const Vec3& light) const {
  return diffuse_lit(material_.base, light);
}

Vec3 LayeredPoint::base_surroundings(const light::SphericalHarmonics9& light) const {
  return diffuse_surroundings(material_.base, light, frame_.axes, bands_);
}

double LayeredPoint::scattered_down(const Vec3& light) const {
  if (tables_.fuzz->tilts) return tables_.fuzz->tilts->scattered_down(fuzz_.fibre(), light);
  return tables_.fuzz->table.scattered_down(turned(light, fuzz_.azimuth)).x();
}

Vec3 LayeredPoint::lit(const Vec3& towards) const {
  const Vec3 light = frame_.into(towards);
  Vec3 base = base_lit(light);
  if (light.z() > 0 && material_.specular) {
    const GgxParameters& ggx = *material_.specular;
    Vec3 f = ggx_brdf(ggx.roughness, ggx.f0, light, frame_.view);
    if (ggx.energy_compensation) {
      f += ggx_multiple_scattering(ggx.f0, ggx_total(light), view_total_, tables_.ggx->mean_albedo);
    }
    base += f * light.z();
  }
  if (!material_.fuzz) return base;
  const Vec3 crossing = fuzz_frame_.into(towards);
  if (crossing.z() <= 0) return Vec3::Zero();
  const double down = material_.fuzz_scattered_down ? scattered_down(crossing) : 0;
  return base.cwiseProduct(fuzz_attenuation(fuzz_, crossing, fuzz_frame_.view, down)) +
         fuzz_brdf(fuzz_, crossing, fuzz_frame_.view) * crossing.z();
}

Vec3 LayeredPoint::reflected_surroundings(const light::Surroundings& surroundings) const {
  const GgxParameters& ggx = *material_.specular;
  const Mat3 along = frame_.axes * Eigen::AngleAxisd(ggx.roughness.azimuth, Vec3::UnitZ()).toRotationMatrix();
  const Vec3 view = turned(frame_.view, ggx.roughness.azimuth);
  const Vec4 albedo = tables_.ggx->albedo(view);
  const Vec3 mean = ggx_surroundings(surroundings, ggx.roughness, along, view, lobe_lookups(material_));
  Vec3 reflected = mean.cwiseProduct(ggx.f0 * albedo.x() + Vec3::Constant(albedo.y()));
  // What crosses the fuzz, for probes as for harmonics.
  reflected = reflected.cwiseProduct(bands_[0]);
  if (ggx.energy_compensation) {
    // The compensating lobe is diffuse: integrated over lights it is (1 - E(v)) times the bounces.
    const double mean_albedo = tables_.ggx->mean_albedo;
    const Vec3 lobe = ggx_multiple_scattering(ggx.f0, 0, view_total_, mean_albedo);
    const Vec3 bounces = lobe * (kPi * (1 - mean_albedo));
    reflected += bounces.cwiseProduct(received(surroundings.harmonics, frame_.axes.col(2), bands_));
  }
  return reflected;
}

Vec3 LayeredPoint::fuzz_surroundings(const light::SphericalHarmonics9& light) const {
  const double visibility = fuzz_visibility_slides(fuzz_.density, fuzz_frame_.view.z());
  const Vec3 local = turned(fuzz_frame_.view, fuzz_.azimuth);
  const Vec4 ambient = tables_.fuzz->tilts ? tables_.fuzz->tilts->ambient(fuzz_.fibre(), fuzz_frame_.view)
                                           : tables_.fuzz->table.ambient(local);
  const Vec3 gaze(ambient.x(), ambient.y() * local.y(), ambient.z());
  // The lobe p g about its mean direction, as narrow as the mean is long: a lobe whose Legendre coefficients
  // fall like those of a Gaussian on the sphere, 1, g, g^3.
  const double length = std::max(gaze.norm(), 1e-6);
  const Vec3 direction = fuzz_frame_.axes * turned(gaze / length, -fuzz_.azimuth);
  return fuzz_.colour.cwiseProduct(light.lobe(direction, {1, length, length * length * length}) *
                                   (ambient.w() * visibility));
}

Vec3 LayeredPoint::surroundings(const light::Surroundings& surroundings) const {
  const light::SphericalHarmonics9& light = surroundings.harmonics;
  Vec3 base = base_surroundings(light);
  if (material_.specular && surroundings.environment) base += reflected_surroundings(surroundings);
  if (!material_.fuzz) return base;
  return base * fuzz_passing(material_.fuzz->density, fuzz_frame_.view) + fuzz_surroundings(light);
}

Vec3 LayeredPoint::chances() const {
  const double crossing = material_.fuzz ? fuzz_passing(fuzz_.density, fuzz_frame_.view) : 1;
  // None is so rare that a light it alone reflects would be found too seldom.
  Vec3 weights(0.1 + crossing * luminance(material_.base.color), 0, 0);
  if (material_.specular) {
    weights.y() =
        0.1 + crossing * view_total_ * luminance(fresnel_schlick(material_.specular->f0, frame_.view.z()));
  }
  if (material_.fuzz) weights.z() = 0.1 + (1 - crossing) * luminance(fuzz_.colour);
  return weights / weights.sum();
}

appearance::Reflectance::LightSample LayeredPoint::sample(const Vec3& u) const {
  const Vec3 chance = chances();
  Vec3 light;
  if (u.z() < chance.x()) {
    const double radius = std::sqrt(u.x());
    const double angle = 2 * kPi * u.y();
    light = frame_.axes * Vec3(radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - u.x()));
  } else if (u.z() < chance.x() + chance.y()) {
    const Vec3 half = ggx_sample_visible(material_.specular->roughness, frame_.view, u.head<2>());
    light = frame_.axes * (2 * frame_.view.dot(half) * half - frame_.view);
  } else {
    FuzzParameters fuzz = fuzz_;
    fuzz.phase = FuzzPhase::sggx;
    light = fuzz_frame_.axes * fuzz_sample_view(fuzz, fuzz_frame_.view, u.head<2>());
  }
  return {light, pdf(light)};
}

double LayeredPoint::pdf(const Vec3& towards) const {
  const Vec3 chance = chances();
  const Vec3 light = frame_.into(towards);
  double density = chance.x() * std::max(light.z(), 0.0) / kPi;
  if (chance.y() > 0) {
    density += chance.y() * ggx_visible_pdf(material_.specular->roughness, light, frame_.view);
  }
  if (chance.z() > 0) {
    FuzzParameters fuzz = fuzz_;
    fuzz.phase = FuzzPhase::sggx;
    density += chance.z() * fuzz_phase(fuzz, fuzz_frame_.view, fuzz_frame_.into(towards));
  }
  return density;
}

}  // namespace sateen::brdf
