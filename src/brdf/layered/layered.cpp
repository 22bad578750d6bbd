// SPDX-License-Identifier: MIT
#include "sateen/brdf/layered/layered.h"

#include <algorithm>
#include <cmath>

#include "sateen/brdf/fibre_diffuse.h"
#include "sateen/brdf/ggx_surroundings.h"
#include "sateen/core/picture_texture.h"

namespace sateen::brdf {

namespace {

constexpr int kTableSize = 33;
/// Views at and behind the rim, where interpolated normals turn away, are taken this far above the horizon.
constexpr double kLowestView = 1e-3;

/// Turns directions into a frame whose x axis lies at `azimuth`.
Vec3 turned(const Vec3& w, double azimuth) {
  const double c = std::cos(azimuth);
  const double s = std::sin(azimuth);
  return {c * w.x() + s * w.y(), c * w.y() - s * w.x(), w.z()};
}

Vec3 lifted_view(const Vec3& view) {
  return view.z() >= kLowestView ? view : Vec3(view.x(), view.y(), kLowestView).normalized();
}

/// The base layer's radiance for a lamp of unit irradiance above the horizon, per base colour; of fibres,
/// times their albedo.
double base_value(const LayeredMaterial& material, const Vec3& light) {
  if (material.base == LayeredMaterial::Base::lambert) return light.z() / kPi;
  const Vec3 local = turned(light, material.base_azimuth);
  return material.base == LayeredMaterial::Base::maximum_normal ? fibre_maximum_normal(local)
                                                                : fibre_diffuse(local);
}

// The slides' simplified version for deferred shading.
constexpr double kSimpleDensity = 0.5;
constexpr double kSimpleAlpha = 0.95;
constexpr double kSimpleColour = 5;  // times the Lambert colour

/// Wrapped lighting (McAuley 2013) with n = 2, w = 0.2, in place of u.n.
double wrapped_cosine(double cosine) {
  constexpr double kWrap = 0.2;
  const double x = std::max(cosine + kWrap, 0.0) / (1 + kWrap);
  return 3 / (2 * (1 + kWrap)) * x * x;
}

}  // namespace

void Lighting::set_environment(const Image& latitude_longitude) {
  int width = 64;
  while (width < latitude_longitude.width && width < 512) width *= 2;
  environment = std::make_shared<const light::PrefilteredEnvironment>(latitude_longitude, width);
  harmonics = light::project_environment(latitude_longitude);
}

const FibreMoments& LayeredAppearance::moments(LayeredMaterial::Base base) {
  return base == LayeredMaterial::Base::maximum_normal ? kMaximumNormalMoments : kFibreMoments;
}

Vec3 FibreMap::fibre(const Vec2& uv) const {
  std::array<double, 2> stored{};
  sample_repeating(*picture, uv.cwiseProduct(repeat), stored);
  Vec2 xy(2 * stored[0] - 1, 2 * stored[1] - 1);
  const double length = xy.norm();
  xy = length > 1e-6 ? Vec2(xy / length) : Vec2(1, 0);
  xy *= std::clamp(length, kUprightTilt, 1.0);
  return {xy.x(), xy.y(), std::sqrt(std::max(1 - xy.squaredNorm(), 0.0))};
}

LayeredAppearance::LayeredAppearance(LayeredMaterial material, Lighting lighting)
    : material_(std::move(material)), lighting_(std::move(lighting)) {
  if (material_.specular) {
    AnisotropicRoughness& roughness = material_.specular->roughness;
    if (roughness.alpha_t < roughness.alpha_b) {
      std::swap(roughness.alpha_t, roughness.alpha_b);
      roughness.azimuth += kPi / 2;
    }
    AnisotropicRoughness along = roughness;
    along.azimuth = 0;
    albedo_ = HemisphereTable(kTableSize, [&](const Vec3& w) {
      const GgxAlbedo albedo = ggx_albedo(along, lifted_view(w), 24);
      return Vec4(albedo.scale, albedo.bias, 0, 0);
    });
    if (material_.specular->energy_compensation) mean_albedo_ = ggx_mean_albedo(along);
  }
  if (material_.fuzz && std::sin(material_.fuzz->tilt) < kUprightTilt) material_.fuzz->tilt = kUprightTilt;
  if (material_.fuzz && material_.fuzz_fibres) {
    fuzz_tilts_ = std::make_shared<const FuzzTiltTable>(*material_.fuzz);
  } else if (material_.fuzz) {
    fuzz_table_ = make_fuzz_table(*material_.fuzz);
    if (material_.fuzz_slides) {
      fuzz_polynomial_ = fit_scattered_down(*material_.fuzz, ScatteredDownPolynomial::kSlidesDegree);
    }
  }
  base_bands_ = base_bands();
}

std::array<Vec3, 3> LayeredAppearance::bands_under_fuzz(const Bands& passing, const Bands& scattered) const {
  const Vec3 colour = material_.fuzz && material_.fuzz_scattered_down ? material_.fuzz->colour : Vec3::Zero();
  std::array<Vec3, 3> bands;
  for (std::size_t l = 0; l < 3; ++l) bands[l] = Vec3::Constant(passing[l]) + colour * scattered[l];
  return bands;
}

std::array<Vec3, 3> LayeredAppearance::base_bands() const {
  if (!material_.fuzz_slides) {
    return bands_under_fuzz(fuzz_table_.passing_bands, fuzz_table_.scattered_bands);
  }
  const double q = fuzz_passing_albedo_slides(material_.fuzz->density);
  Bands passing = FuzzTable().passing_bands;
  Bands scattered = passing;
  for (double& band : scattered) band *= fuzz_table_.scattered_down_mean * (1 - q);
  for (double& band : passing) band *= q;
  return bands_under_fuzz(passing, scattered);
}

LayeredAppearance::Seen LayeredAppearance::seen(const appearance::Surface& surface, const Vec3& normal) {
  const Vec3 across = surface.tangent - normal * normal.dot(surface.tangent);
  const Vec3 tangent = across / std::sqrt(std::max(across.squaredNorm(), 1e-12));
  Mat3 frame;
  frame << tangent, surface.bitangent_sign * normal.cross(tangent), normal;
  return {frame, lifted_view(frame.transpose() * surface.view)};
}

LayeredAppearance::Layer LayeredAppearance::layer(const appearance::Surface& surface,
                                                  const Seen& base) const {
  Layer layer{base, material_.fuzz.value_or(FuzzParameters{}), base_bands_};
  if (material_.fuzz_smoothing > 0) {
    const Vec3 blend =
        (1 - material_.fuzz_smoothing) * surface.normal + material_.fuzz_smoothing * surface.mesh_normal;
    if (blend.norm() > 1e-6) static_cast<Seen&>(layer) = seen(surface, blend.normalized());
  }
  if (fuzz_tilts_) {
    const Vec3 fibre = material_.fuzz_fibres->fibre(surface.uv);
    layer.fuzz.tilt = std::atan2(fibre.head<2>().norm(), fibre.z());
    layer.fuzz.azimuth = std::atan2(fibre.y(), fibre.x());
    layer.bands = bands_under_fuzz(fuzz_tilts_->passing_bands(), fuzz_tilts_->scattered_bands(fibre));
  }
  return layer;
}

int LayeredAppearance::lobe_samples() const {
  if (material_.lobe_samples > 0 || !material_.specular) return std::max(1, material_.lobe_samples);
  return material_.specular->roughness.alpha_t == material_.specular->roughness.alpha_b ? 1 : 8;
}

double LayeredAppearance::scattered_down(const FuzzParameters& fuzz, const Vec3& light) const {
  if (material_.fuzz_slides) return fuzz_polynomial_(light, fuzz);
  if (fuzz_tilts_) return fuzz_tilts_->scattered_down(fuzz.fibre(), light);
  return fuzz_table_.scattered_down(turned(light, fuzz.azimuth)).x();
}

Vec3 LayeredAppearance::simple_fuzz(const Vec3& light, const Vec3& view) const {
  FuzzParameters fuzz;
  fuzz.density = kSimpleDensity;
  fuzz.alpha = kSimpleAlpha;
  const double x = wrapped_cosine(light.z());
  if (x <= 0) return Vec3::Zero();
  const double sum = x + view.z();
  const double scattered = -std::expm1(-fuzz.density * sum / (x * view.z()));
  return material_.base_colour * (kSimpleColour * fuzz_phase(fuzz, light, view) * scattered / sum * x);
}

/// For a lamp of unit irradiance in direction `towards`, in view space.
Vec3 LayeredAppearance::direct(const Vec3& towards, const Seen& seen, const Layer& layer) const {
  const Vec3 light = seen.into(towards);
  const Vec3& view = seen.view;
  Vec3 diffuse = Vec3::Zero();
  if (light.z() > 0) {
    diffuse = material_.base_colour * base_value(material_, light);
    if (material_.base != LayeredMaterial::Base::lambert) diffuse /= moments(material_.base).one;
  }
  if (material_.simple_fuzziness > 0) {
    diffuse =
        (1 - material_.simple_fuzziness) * diffuse + material_.simple_fuzziness * simple_fuzz(light, view);
  }
  Vec3 base = diffuse;
  if (light.z() > 0 && material_.specular) {
    const GgxParameters& ggx = *material_.specular;
    Vec3 f = ggx_brdf(ggx.roughness, ggx.f0, light, view);
    if (ggx.energy_compensation) {
      const auto total = [&](const Vec3& w) {
        const Vec4 read = albedo_(turned(w, ggx.roughness.azimuth));
        return read.x() + read.y();
      };
      f += ggx_multiple_scattering(ggx.f0, total(light), total(view), mean_albedo_);
    }
    base += f * light.z();
  }
  if (!material_.fuzz) return base;
  const Vec3 crossing = layer.into(towards);
  if (crossing.z() <= 0) return Vec3::Zero();
  const FuzzParameters& fuzz = layer.fuzz;
  const double down = material_.fuzz_scattered_down ? scattered_down(fuzz, crossing) : 0;
  return base.cwiseProduct(fuzz_attenuation(fuzz, crossing, layer.view, down)) +
         fuzz_brdf(fuzz, crossing, layer.view) * crossing.z();
}

/// The light of the surroundings on a flat diffuse surface, per albedo.
Vec3 LayeredAppearance::received(const Vec3& normal, const Layer& layer) const {
  const light::SphericalHarmonics9& light = lighting_.harmonics;
  return light.c[0].cwiseProduct(layer.bands[0]) + light.linear(normal).cwiseProduct(layer.bands[1]) +
         light.quadratic(normal).cwiseProduct(layer.bands[2]);
}

Vec3 LayeredAppearance::diffuse_surroundings(const Mat3& frame, const Layer& layer) const {
  const light::SphericalHarmonics9& light = lighting_.harmonics;
  if (material_.base == LayeredMaterial::Base::lambert) {
    return material_.base_colour.cwiseProduct(received(frame.col(2), layer));
  }
  const Vec3 axis(std::cos(material_.base_azimuth), std::sin(material_.base_azimuth), 0);
  const Vec3 fibre = frame * axis;
  const Vec3 across = frame * Vec3(-axis.y(), axis.x(), 0);
  const FibreMoments& m = moments(material_.base);
  const Vec3 sum = light.c[0] * m.one + light.linear(frame.col(2)) * m.z + light.quadratic(fibre) * m.xx +
                   light.quadratic(across) * m.yy + light.quadratic(frame.col(2)) * m.zz;
  return material_.base_colour.cwiseProduct(sum / m.one).cwiseProduct(layer.bands[0]);
}

Vec3 LayeredAppearance::reflected_surroundings(const Seen& base, const Layer& layer) const {
  const GgxParameters& ggx = *material_.specular;
  const Mat3 along = base.frame * Eigen::AngleAxisd(ggx.roughness.azimuth, Vec3::UnitZ()).toRotationMatrix();
  const Vec3 view = turned(base.view, ggx.roughness.azimuth);
  const Vec4 albedo = albedo_(view);
  const Vec3 mean = ggx_surroundings(*lighting_.environment, ggx.roughness, along, view, lobe_samples());
  Vec3 reflected = mean.cwiseProduct(ggx.f0 * albedo.x() + Vec3::Constant(albedo.y()));
  // What crosses the fuzz, for probes as for harmonics.
  reflected = reflected.cwiseProduct(layer.bands[0]);
  if (ggx.energy_compensation) {
    // The compensating lobe is diffuse: integrated over lights it is (1 - E(v)) times the bounces.
    const Vec3 lobe = ggx_multiple_scattering(ggx.f0, 0, albedo.x() + albedo.y(), mean_albedo_);
    const Vec3 bounces = lobe * (kPi * (1 - mean_albedo_));
    reflected += bounces.cwiseProduct(received(base.frame.col(2), layer));
  }
  return reflected;
}

Vec3 LayeredAppearance::fuzz_surroundings(const Layer& layer) const {
  const FuzzParameters& fuzz = layer.fuzz;
  const double visibility = fuzz_visibility_slides(fuzz.density, layer.view.z());
  if (material_.fuzz_slides) {
    return fuzz.colour.cwiseProduct(lighting_.harmonics.hemisphere_mean(layer.frame.col(2))) *
           (visibility * (1 - scattered_down(fuzz, layer.view)));
  }
  const Vec3 local = turned(layer.view, fuzz.azimuth);
  const Vec4 ambient =
      fuzz_tilts_ ? fuzz_tilts_->ambient(fuzz.fibre(), layer.view) : fuzz_table_.ambient(local);
  const Vec3 gaze(ambient.x(), ambient.y() * local.y(), ambient.z());
  // The lobe p g about its mean direction, as narrow as the mean is long: a lobe whose Legendre coefficients
  // fall like those of a Gaussian on the sphere, 1, g, g^3.
  const double length = std::max(gaze.norm(), 1e-6);
  const Vec3 direction = layer.frame * turned(gaze / length, -fuzz.azimuth);
  return fuzz.colour.cwiseProduct(lighting_.harmonics.lobe(direction, {1, length, length * length * length}) *
                                  (ambient.w() * visibility));
}

Vec3 LayeredAppearance::surroundings(const Seen& seen, const Layer& layer) const {
  Vec3 base = diffuse_surroundings(seen.frame, layer);
  if (material_.simple_fuzziness > 0) {
    // The slides' ambient product for the fixed parameters; even scattering sends half down.
    const double response = fuzz_visibility_slides(kSimpleDensity, seen.view.z()) * 0.5;
    const Vec3 fuzz =
        material_.base_colour.cwiseProduct(lighting_.harmonics.hemisphere_mean(seen.frame.col(2))) *
        (kSimpleColour * response);
    base = (1 - material_.simple_fuzziness) * base + material_.simple_fuzziness * fuzz;
  }
  if (material_.specular && lighting_.environment) base += reflected_surroundings(seen, layer);
  if (!material_.fuzz) return base;
  return base * fuzz_passing(material_.fuzz->density, layer.view) + fuzz_surroundings(layer);
}

Vec3 LayeredAppearance::evaluate(const appearance::Surface& surface) const {
  const Seen base = seen(surface, surface.normal);
  const Layer above = layer(surface, base);
  Vec3 sum = surface.occlusion * surroundings(base, above);
  for (const light::PunctualLight& light : lighting_.lights) {
    const light::ArrivingLight arriving = light::arriving_light(light, surface.position);
    sum += arriving.irradiance.cwiseProduct(direct(arriving.direction, base, above));
  }
  return sum.cwiseMax(0);
}

appearance::Appearance::Needs LayeredAppearance::needs() const {
  const bool turning = material_.base != LayeredMaterial::Base::lambert ||
                       (material_.specular &&
                        material_.specular->roughness.alpha_t != material_.specular->roughness.alpha_b) ||
                       (material_.fuzz && (material_.fuzz_fibres || std::sin(material_.fuzz->tilt) > 1e-9));
  return {.tangents = turning, .uvs = material_.fuzz_fibres.has_value()};
}

bool LayeredAppearance::set_environment(const Image& latitude_longitude) {
  lighting_.set_environment(latitude_longitude);
  if (!keep_lights_) lighting_.lights.clear();
  return true;
}

}  // namespace sateen::brdf
