// SPDX-License-Identifier: MIT
#include "sateen/brdf/layered.h"

#include <algorithm>
#include <cmath>

#include "sateen/brdf/fibre_diffuse.h"

namespace sateen {

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

Vec3f narrow(const Vec3& v) {
  return v.cast<float>();
}

const FibreMoments& moments(LayeredMaterial::Base base) {
  return base == LayeredMaterial::Base::maximum_normal ? kMaximumNormalMoments : kFibreMoments;
}

/// The base layer's radiance for a lamp of unit irradiance above the horizon, per base colour.
double base_value(const LayeredMaterial& material, const Vec3& light) {
  if (material.base == LayeredMaterial::Base::lambert) return light.z() / kPi;
  const Vec3 local = turned(light, material.base_azimuth);
  const double value = material.base == LayeredMaterial::Base::maximum_normal ? fibre_maximum_normal(local)
                                                                              : fibre_diffuse(local);
  return value / moments(material.base).one;
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
  environment = std::make_shared<const PrefilteredEnvironment>(latitude_longitude, width);
  harmonics = project_environment(latitude_longitude);
}

LayeredAppearance::LayeredAppearance(LayeredMaterial material, Lighting lighting)
    : material_(std::move(material)), lighting_(std::move(lighting)) {
  if (material_.specular) {
    AnisotropicRoughness along = material_.specular->roughness;
    along.azimuth = 0;
    albedo_ = HemisphereTable(kTableSize, [&](const Vec3& w) {
      const GgxAlbedo albedo = ggx_albedo(along, lifted_view(w), 24);
      return Vec4(albedo.scale, albedo.bias, 0, 0);
    });
    if (material_.specular->energy_compensation) mean_albedo_ = ggx_mean_albedo(along);
  }
  if (material_.fuzz) {
    fuzz_table_ = make_fuzz_table(*material_.fuzz);
    if (material_.fuzz_slides) {
      fuzz_polynomial_ = fit_scattered_down(*material_.fuzz, ScatteredDownPolynomial::kSlidesDegree);
    }
  }
  base_bands_ = base_bands();
}

std::array<Vec3, 3> LayeredAppearance::base_bands() const {
  std::array<Vec3, 3> bands;
  for (std::size_t l = 0; l < 3; ++l) bands[l].setConstant(FuzzTable().passing_bands[l]);
  if (!material_.fuzz) return bands;
  const Vec3 colour = material_.fuzz_scattered_down ? material_.fuzz->colour : Vec3::Zero();
  if (material_.fuzz_slides) {
    const double q = fuzz_passing_albedo_slides(material_.fuzz->density);
    const Vec3 attenuation = Vec3::Constant(q) + colour * (fuzz_table_.scattered_down_mean * (1 - q));
    for (Vec3& band : bands) band = band.cwiseProduct(attenuation);
    return bands;
  }
  for (std::size_t l = 0; l < 3; ++l) {
    bands[l] = Vec3::Constant(fuzz_table_.passing_bands[l]) + colour * fuzz_table_.scattered_bands[l];
  }
  return bands;
}

LayeredAppearance::Seen LayeredAppearance::seen(const Surface& surface, const Vec3& normal) {
  const Vec3 across = surface.tangent - normal * normal.dot(surface.tangent);
  const Vec3 tangent = across / std::sqrt(std::max(across.squaredNorm(), 1e-12));
  const Frame frame{tangent, surface.bitangent_sign * normal.cross(tangent), normal};
  return {frame, lifted_view(frame.into(surface.view))};
}

int LayeredAppearance::lobe_samples() const {
  if (material_.lobe_samples > 0 || !material_.specular) return std::max(1, material_.lobe_samples);
  return material_.specular->roughness.alpha_t == material_.specular->roughness.alpha_b ? 1 : 8;
}

double LayeredAppearance::scattered_down(const Vec3& light) const {
  if (material_.fuzz_slides) return fuzz_polynomial_(light, *material_.fuzz);
  return fuzz_table_.scattered_down(turned(light, material_.fuzz->azimuth)).x();
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
Vec3 LayeredAppearance::direct(const Vec3& towards, const Seen& seen, const Seen& layer) const {
  const Vec3 light = seen.frame.into(towards);
  const Vec3& view = seen.view;
  Vec3 diffuse = Vec3::Zero();
  if (light.z() > 0) {
    diffuse = material_.base_colour * base_value(material_, light);
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
  const Vec3 crossing = layer.frame.into(towards);
  if (crossing.z() <= 0) return Vec3::Zero();
  const FuzzParameters& fuzz = *material_.fuzz;
  const double down = material_.fuzz_scattered_down ? scattered_down(crossing) : 0;
  return base.cwiseProduct(fuzz_attenuation(fuzz, crossing, layer.view, down)) +
         fuzz_brdf(fuzz, crossing, layer.view) * crossing.z();
}

/// The light of the surroundings on a flat diffuse surface, per albedo.
Vec3 LayeredAppearance::received(const Vec3& normal) const {
  const SphericalHarmonics9& light = lighting_.harmonics;
  return light.c[0].cwiseProduct(base_bands_[0]) + light.linear(normal).cwiseProduct(base_bands_[1]) +
         light.quadratic(normal).cwiseProduct(base_bands_[2]);
}

Vec3 LayeredAppearance::diffuse_surroundings(const Frame& frame) const {
  const SphericalHarmonics9& light = lighting_.harmonics;
  if (material_.base == LayeredMaterial::Base::lambert) {
    return material_.base_colour.cwiseProduct(received(frame.normal));
  }
  const Vec3 axis(std::cos(material_.base_azimuth), std::sin(material_.base_azimuth), 0);
  const Vec3 fibre = frame.out_of(axis);
  const Vec3 across = frame.out_of({-axis.y(), axis.x(), 0});
  const FibreMoments& m = moments(material_.base);
  const Vec3 sum = light.c[0] * m.one + light.linear(frame.normal) * m.z + light.quadratic(fibre) * m.xx +
                   light.quadratic(across) * m.yy + light.quadratic(frame.normal) * m.zz;
  return material_.base_colour.cwiseProduct(sum / m.one).cwiseProduct(base_bands_[0]);
}

Vec3 LayeredAppearance::reflected_surroundings(const Seen& base) const {
  const Frame& frame = base.frame;
  const Vec3& view = base.view;
  const GgxParameters& ggx = *material_.specular;
  const AnisotropicRoughness& roughness = ggx.roughness;
  const bool along = roughness.alpha_t >= roughness.alpha_b;
  const double major = along ? roughness.alpha_t : roughness.alpha_b;
  const double minor = along ? roughness.alpha_b : roughness.alpha_t;
  const double angle = roughness.azimuth + (along ? 0 : kPi / 2);
  const Vec2 axis(std::cos(angle), std::sin(angle));
  // Half vectors at the quantiles of the slopes that the narrow lobe lacks along the long axis (a GGX
  // marginal: slope = a c / sqrt(1 - c^2) with c even in (-1, 1)), each looked up with the narrow lobe.
  const int count = lobe_samples();
  const double extra = major * major - minor * minor;
  const double blur = std::sqrt(minor * minor + extra / (count * count));
  const double view_masking = 1 + ggx_lambda(roughness, view);
  Vec3 sum = Vec3::Zero();
  double total = 0;
  for (int i = 0; i < count; ++i) {
    const double c = (2 * i + 1.0) / count - 1;
    const double slope = std::sqrt(extra) * c / std::sqrt(1 - c * c);
    const Vec3 half = Vec3(slope * axis.x(), slope * axis.y(), 1).normalized();
    const double cosine = view.dot(half);
    const Vec3 light = 2 * cosine * half - view;
    if (cosine <= 0 || light.z() <= 1e-4) continue;
    const double weight = cosine / half.z() * view_masking / (view_masking + ggx_lambda(roughness, light));
    sum += weight * lighting_.environment->radiance(frame.out_of(light), blur);
    total += weight;
  }
  const Vec4 albedo = albedo_(turned(view, roughness.azimuth));
  Vec3 reflected = Vec3::Zero();
  if (total > 0) reflected = (sum / total).cwiseProduct(ggx.f0 * albedo.x() + Vec3::Constant(albedo.y()));
  // What crosses the fuzz, for probes as for harmonics.
  reflected = reflected.cwiseProduct(base_bands_[0]);
  if (ggx.energy_compensation) {
    // The compensating lobe is diffuse: integrated over lights it is (1 - E(v)) times the bounces.
    const Vec3 lobe = ggx_multiple_scattering(ggx.f0, 0, albedo.x() + albedo.y(), mean_albedo_);
    const Vec3 bounces = lobe * (kPi * (1 - mean_albedo_));
    reflected += bounces.cwiseProduct(received(frame.normal));
  }
  return reflected;
}

Vec3 LayeredAppearance::fuzz_surroundings(const Seen& layer) const {
  const FuzzParameters& fuzz = *material_.fuzz;
  const double visibility = fuzz_visibility_slides(fuzz.density, layer.view.z());
  if (material_.fuzz_slides) {
    return fuzz.colour.cwiseProduct(lighting_.harmonics.hemisphere_mean(layer.frame.normal)) *
           (visibility * (1 - scattered_down(layer.view)));
  }
  const Vec3 local = turned(layer.view, fuzz.azimuth);
  const Vec3 gaze = fuzz_table_.mean_direction(local);
  // The lobe p g about its mean direction, as narrow as the mean is long: a lobe whose Legendre coefficients
  // fall like those of a Gaussian on the sphere, 1, g, g^3.
  const double length = std::max(gaze.norm(), 1e-6);
  const Vec3 direction = layer.frame.out_of(turned(gaze / length, -fuzz.azimuth));
  const double response = fuzz_table_.response(local) * visibility;
  return fuzz.colour.cwiseProduct(lighting_.harmonics.lobe(direction, {1, length, length * length * length}) *
                                  response);
}

Vec3 LayeredAppearance::surroundings(const Seen& seen, const Seen& layer) const {
  Vec3 base = diffuse_surroundings(seen.frame);
  if (material_.simple_fuzziness > 0) {
    // The slides' ambient product for the fixed parameters; even scattering sends half down.
    const double response = fuzz_visibility_slides(kSimpleDensity, seen.view.z()) * 0.5;
    const Vec3 fuzz =
        material_.base_colour.cwiseProduct(lighting_.harmonics.hemisphere_mean(seen.frame.normal)) *
        (kSimpleColour * response);
    base = (1 - material_.simple_fuzziness) * base + material_.simple_fuzziness * fuzz;
  }
  if (material_.specular && lighting_.environment) base += reflected_surroundings(seen);
  if (!material_.fuzz) return base;
  return base * fuzz_passing(material_.fuzz->density, layer.view) + fuzz_surroundings(layer);
}

Vec3 LayeredAppearance::evaluate(const Surface& surface) const {
  const Seen base = seen(surface, surface.normal);
  Seen layer = base;
  if (material_.fuzz_smoothing > 0) {
    const Vec3 blend =
        (1 - material_.fuzz_smoothing) * surface.normal + material_.fuzz_smoothing * surface.mesh_normal;
    if (blend.norm() > 1e-6) layer = seen(surface, blend.normalized());
  }
  Vec3 sum = surface.occlusion * surroundings(base, layer);
  for (const PunctualLight& light : lighting_.lights) {
    const ArrivingLight arriving = arriving_light(light, surface.position);
    sum += arriving.irradiance.cwiseProduct(direct(arriving.direction, base, layer));
  }
  return sum.cwiseMax(0);
}

Appearance::Needs LayeredAppearance::needs() const {
  const bool turning = material_.base != LayeredMaterial::Base::lambert ||
                       (material_.specular &&
                        material_.specular->roughness.alpha_t != material_.specular->roughness.alpha_b) ||
                       (material_.fuzz && std::sin(material_.fuzz->tilt) > 1e-9);
  return {.tangents = turning};
}

bool LayeredAppearance::set_environment(const Image& latitude_longitude) {
  lighting_.set_environment(latitude_longitude);
  if (!keep_lights_) lighting_.lights.clear();
  return true;
}

ShaderBinding LayeredAppearance::shader() const {
  ShaderBinding binding;
  if (material_.base == LayeredMaterial::Base::lambert) binding.files.emplace_back("layered_no_fibres.glsl");
  if (!material_.specular) binding.files.emplace_back("layered_no_reflection.glsl");
  if (!material_.specular || !material_.specular->energy_compensation) {
    binding.files.emplace_back("layered_no_compensation.glsl");
  }
  if (!material_.fuzz) binding.files.emplace_back("layered_no_fuzz.glsl");
  if (material_.fuzz) {
    if (material_.fuzz->phase == FuzzPhase::schlick) {
      binding.files.emplace_back("layered_phase_schlick.glsl");
    }
    if (material_.fuzz->phase == FuzzPhase::sggx_symmetric) {
      binding.files.emplace_back("layered_phase_symmetric.glsl");
    }
    if (!material_.fuzz_scattered_down) binding.files.emplace_back("layered_no_scattered_down.glsl");
    if (material_.fuzz_smoothing > 0) binding.files.emplace_back("layered_smoothing.glsl");
    if (material_.fuzz_slides) binding.files.emplace_back("layered_slides.glsl");
  }
  if (material_.simple_fuzziness == 0) binding.files.emplace_back("layered_no_simple_fuzz.glsl");
  binding.files.emplace_back("layered.glsl");
  binding.function = "layered";
  const auto set = [&](const char* name, UniformValue value) {
    binding.uniforms.push_back({name, std::move(value)});
  };
  const auto number = [&](const char* name, double value) { set(name, static_cast<float>(value)); };
  const auto axis = [&](const char* name, double angle) {
    set(name, Vec2f(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))));
  };

  std::vector<Vec4f> positions;
  std::vector<Vec4f> colours;
  std::vector<Vec4f> axes;
  for (const PunctualLight& light : lighting_.lights) {
    const bool directional = light.kind == PunctualLight::Kind::directional;
    const bool spot = light.kind == PunctualLight::Kind::spot;
    const Vec3f at = narrow(directional ? light.direction : light.position);
    const Vec3f colour = narrow(light.colour);
    const Vec3f direction = narrow(light.direction);
    const double outer = std::cos(light.outer_cone);
    positions.emplace_back(at.x(), at.y(), at.z(), directional ? 0.0f : 1.0f);
    colours.emplace_back(
        colour.x(), colour.y(), colour.z(),
        spot ? static_cast<float>(1 / std::max(std::cos(light.inner_cone) - outer, 1e-4)) : 0.0f);
    axes.emplace_back(direction.x(), direction.y(), direction.z(), static_cast<float>(outer));
  }
  set("light_count", static_cast<int>(positions.size()));
  if (!positions.empty()) {
    set("light_position", positions);
    set("light_colour", colours);
    set("light_axis", axes);
  }
  std::vector<Vec3f> harmonics;
  for (const Vec3& c : lighting_.harmonics.c) harmonics.push_back(narrow(c));
  set("environment_harmonics", harmonics);
  if (lighting_.environment) {
    binding.textures.push_back({"environment_map", lighting_.environment->texture()});
    number("environment_last_level", lighting_.environment->levels() - 1);
  }

  set("base_colour", narrow(material_.base_colour));
  set("base_bands",
      std::vector<Vec3f>{narrow(base_bands_[0]), narrow(base_bands_[1]), narrow(base_bands_[2])});
  const FibreMoments& m = moments(material_.base);
  const bool maximum = material_.base == LayeredMaterial::Base::maximum_normal;
  // (|l across the fibre| + x n.l) y, and the moments over the zeroth.
  set("base_lobe", Vec2f(maximum ? 0.0f : 1.0f, static_cast<float>((maximum ? 1 : 1 / kPi) / m.one)));
  set("base_moments", narrow(Vec3(m.xx, m.yy, m.zz) / m.one));
  number("base_moment_z", m.z / m.one);
  axis("base_axis", material_.base_azimuth);
  number("simple_fuzziness", material_.simple_fuzziness);

  if (material_.specular) {
    const GgxParameters& ggx = *material_.specular;
    number("ggx_alpha_t", std::max(ggx.roughness.alpha_t, kMinimumAlpha));
    number("ggx_alpha_b", std::max(ggx.roughness.alpha_b, kMinimumAlpha));
    axis("ggx_axis", ggx.roughness.azimuth);
    set("ggx_f0", narrow(ggx.f0));
    set("ggx_lobe_samples", lighting_.environment ? lobe_samples() : 0);
    number("ggx_mean_albedo", ggx.energy_compensation ? mean_albedo_ : 1);
    binding.textures.push_back({"ggx_albedo_table", albedo_.texture()});
  }

  if (material_.fuzz) {
    const FuzzParameters& fuzz = *material_.fuzz;
    number("fuzz_density", fuzz.density);
    number("fuzz_alpha", fuzz.alpha);
    // Schlick: k, and everything of the lobe that does not depend on directions.
    set("fuzz_schlick",
        Vec2f(static_cast<float>(fuzz.k),
              static_cast<float>(fuzz_schlick_normalisation(fuzz.k) * (1 - fuzz.k * fuzz.k) / (4 * kPi))));
    set("fuzz_fibre", narrow(fuzz.fibre()));
    axis("fuzz_axis", fuzz.azimuth);
    set("fuzz_colour", narrow(fuzz.colour));
    number("fuzz_smoothing", material_.fuzz_smoothing);
    if (material_.fuzz_slides) {
      const std::vector<double>& c = fuzz_polynomial_.coefficients;
      set("fuzz_down_low", narrow({c[0], c[1], c[2]}));
      set("fuzz_down_high", narrow({c[3], c[4], c[5]}));
    }
    set("fuzz_table_along", Vec2f(fuzz_table_.ambient.along_coordinate().cast<float>()));
    binding.textures.push_back({"fuzz_down_table", fuzz_table_.scattered_down.texture(true)});
    binding.textures.push_back({"fuzz_ambient_table", fuzz_table_.ambient.texture()});
  }
  return binding;
}

}  // namespace sateen
