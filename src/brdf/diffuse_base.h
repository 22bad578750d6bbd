// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "sateen/appearance/parameter.h"
#include "sateen/appearance/shader_module.h"
#include "sateen/light/spherical_harmonics.h"

namespace sateen::brdf {

/// The diffuse layer at the bottom of layered and mapped materials. shaders/appearance/diffuse_base.glsl does
/// the same.
struct DiffuseBase {
  enum class Model {
    lambert,
    fibre_diffuse,   ///< Hast et al. (fibre_diffuse.h), scaled to a white furnace
    maximum_normal,  ///< their comparison, scaled alike
  };
  Model model = Model::lambert;
  Vec3 color{0.5, 0.5, 0.5};  ///< albedo, linear
  double azimuth = 0;         ///< of the fibres, radians counter-clockwise from the tangent

  bool has_direction() const { return model != Model::lambert; }
  bool operator==(const DiffuseBase&) const = default;
};

/// model, color, azimuth.
std::span<const appearance::ParameterField<DiffuseBase>> diffuse_base_parameters();

/// How the light of the surroundings reaches the layer, per channel and band of the harmonics.
using LightBands = std::array<Vec3, 3>;
/// With nothing above it: the clamped cosine over pi.
LightBands bare_bands();

/// Radiance per irradiance on a surface facing the light, a unit direction in the shading frame; 0 below the
/// horizon.
Vec3 diffuse_lit(const DiffuseBase& base, const Vec3& light);
/// The light of the surroundings on a flat white Lambert surface of this normal.
Vec3 received(const light::SphericalHarmonics9& light, const Vec3& normal, const LightBands& bands);
/// The layer under the surroundings; `axes`: tangent, bitangent, normal in the harmonics' space.
Vec3 diffuse_surroundings(const DiffuseBase& base, const light::SphericalHarmonics9& light, const Mat3& axes,
                          const LightBands& bands);

/// What the shader reads, and the switch it is compiled with.
void bind_base(const DiffuseBase& base, const LightBands& bands, appearance::ShaderValues& values);
std::pair<std::string, std::string> define(const DiffuseBase& base);

}  // namespace sateen::brdf
