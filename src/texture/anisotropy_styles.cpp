// SPDX-License-Identifier: MIT
#include "sateen/texture/anisotropy_styles.h"

namespace sateen {
namespace {

double unit(double v) {
  return std::clamp(v, 0.0, 1.0);
}

/// The lobe with its alphas in range and the longer highlight along its axis.
AnisotropicRoughness settled(const AnisotropicRoughness& lobe) {
  AnisotropicRoughness out{std::clamp(lobe.alpha_t, kMinimumAlpha, 1.0),
                           std::clamp(lobe.alpha_b, kMinimumAlpha, 1.0), lobe.azimuth};
  if (out.alpha_t < out.alpha_b) {
    std::swap(out.alpha_t, out.alpha_b);
    out.azimuth += kPi / 2;
  }
  return out;
}

/// A line's angle as turns in [0, 1/2).
double half_turns(double angle) {
  const double turns = angle / (2 * kPi);
  const double wrapped = turns - std::floor(turns * 2) / 2;
  return wrapped < 0.5 ? wrapped : 0;
}

}  // namespace

AnisotropicRoughness lobe_of(const UvRoughness& style) {
  return {unit(style.along) * unit(style.along), unit(style.across) * unit(style.across),
          2 * kPi * style.rotation};
}

UvRoughness uv_roughness_of(const AnisotropicRoughness& lobe) {
  const AnisotropicRoughness s = settled(lobe);
  return {std::sqrt(s.alpha_t), std::sqrt(s.alpha_b), half_turns(s.azimuth)};
}

AnisotropicRoughness lobe_of(const GltfAnisotropy& style) {
  const double alpha = unit(style.roughness) * unit(style.roughness);
  const double strength = unit(style.strength) * unit(style.strength);
  return {alpha + (1 - alpha) * strength, alpha, 2 * kPi * style.rotation};
}

GltfAnisotropy gltf_of(const AnisotropicRoughness& lobe) {
  const AnisotropicRoughness s = settled(lobe);
  return {std::sqrt(s.alpha_b), s.alpha_b < 1 ? std::sqrt((s.alpha_t - s.alpha_b) / (1 - s.alpha_b)) : 0,
          half_turns(s.azimuth)};
}

AnisotropicRoughness lobe_of(const BlenderAnisotropy& style) {
  const double aspect = std::sqrt(1 - 0.9 * unit(style.anisotropic));
  const double alpha = unit(style.roughness) * unit(style.roughness);
  return {std::min(alpha / aspect, 1.0), alpha * aspect, 2 * kPi * style.rotation};
}

BlenderAnisotropy blender_of(const AnisotropicRoughness& lobe) {
  const AnisotropicRoughness s = settled(lobe);
  return {std::pow(s.alpha_t * s.alpha_b, 0.25), unit((1 - s.alpha_b / s.alpha_t) / 0.9),
          half_turns(s.azimuth)};
}

AnisotropicRoughness lobe_of(const SubstanceAnisotropy& style) {
  const double alpha = unit(style.roughness) * unit(style.roughness);
  return {alpha, std::min(alpha / std::max(1 - unit(style.level), 1e-6), 1.0), 2 * kPi * style.angle};
}

SubstanceAnisotropy substance_of(const AnisotropicRoughness& lobe) {
  const AnisotropicRoughness s = settled(lobe);
  return {std::sqrt(s.alpha_b), 1 - s.alpha_b / s.alpha_t, half_turns(s.azimuth + kPi / 2)};
}

}  // namespace sateen
