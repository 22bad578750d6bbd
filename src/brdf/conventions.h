// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/brdf/fuzz.h"
#include "sateen/brdf/ggx.h"

namespace sateen::brdf {

// How other systems write an anisotropic roughness and a sheen, in and out. Inside there are two alphas and
// an axis (AnisotropicRoughness); everywhere below
//   roughness   is perceptual, [0, 1]; alpha = roughness^2 for equal alphas
//   rotation    is the azimuth of the stretched direction, the one of the larger alpha, in radians
//   counter-clockwise from
//               the tangent (whatever unit the other system stores), in [0, pi) on the way out.
// The larger alpha lies *along* that direction: a highlight is long across the brushing of a metal, so the
// direction of brushing is the other one; only Substance's angle is its (clockwise). On the way out the axes
// are swapped where alpha_t < alpha_b. Values out of range, as maps may hold, are clamped; alphas to
// [kMinimumAlpha, 1].

/// What all of them store: a roughness, a strength and a direction.
struct AnisotropyParameters {
  double roughness = 0.5;
  double anisotropy =
      0;  ///< strength, [0, 1]; Filament's is [-1, 1], negative turns the direction by a quarter
  double rotation = 0;
};

/// Two roughnesses along and across an axis, as Patry's authoring node ("Samurai Shading", 2020) has them:
/// alpha = roughness^2. (Gloss is 1 - roughness.)
struct UvRoughness {
  double along = 0.5;
  double across = 0.5;
  double rotation = 0;  ///< of the axis
};
AnisotropicRoughness from_uv(const UvRoughness& uv);
UvRoughness to_uv(const AnisotropicRoughness& roughness);

/// glTF KHR_materials_anisotropy: alpha_b = roughness^2, alpha_t = mix(alpha_b, 1, strength^2). Exact both
/// ways, but a surface with alpha_b = 1 has no strength.
AnisotropicRoughness from_gltf(const AnisotropyParameters& gltf);
AnisotropyParameters to_gltf(const AnisotropicRoughness& roughness);

/// MaterialX roughness_anisotropy: aspect = sqrt(1 - anisotropy), alpha_t = min(roughness^2 / aspect, 1),
/// alpha_b = roughness^2 aspect; anisotropy is limited to 0.98. Where alpha_t was cut the way back finds
/// another, equal pair.
AnisotropicRoughness from_materialx(const AnisotropyParameters& materialx);
AnisotropyParameters to_materialx(const AnisotropicRoughness& roughness);

/// Blender's Principled BSDF, after Burley 2012: aspect = sqrt(1 - 0.9 anisotropic), then as MaterialX.
/// Blender stores the rotation in turns. Ratios of the alphas above 10 cannot be said in it: anisotropy ends
/// at 1.
AnisotropicRoughness from_blender(const AnisotropyParameters& blender);
AnisotropyParameters to_blender(const AnisotropicRoughness& roughness);

/// Filament: alpha_t = roughness^2 (1 + anisotropy), alpha_b = roughness^2 (1 - anisotropy), neither above 1.
AnisotropicRoughness from_filament(const AnisotropyParameters& filament);
AnisotropyParameters to_filament(const AnisotropicRoughness& roughness);

/// Substance 3D Painter's metal/rough anisotropy shader: roughness along its angle, roughness / sqrt(1 -
/// level) across it, so the highlight is long across the angle. `anisotropy` is the level, `rotation` the
/// angle: here of the *smaller* alpha and *clockwise*, as the shader turns the tangent towards minus the
/// bitangent.
AnisotropicRoughness from_substance(const AnisotropyParameters& substance);
AnisotropyParameters to_substance(const AnisotropicRoughness& roughness);

/// glTF KHR_materials_sheen: the "Charlie" distribution (Estevez and Kulla 2017) over a base.
struct SheenParameters {
  Vec3 colour{0, 0, 0};  ///< sheenColorFactor, linear; black is no sheen
  double roughness = 0;  ///< sheenRoughnessFactor, [0, 1]
};

/// Fuzz standing up (tilt 0) whose flake normals have the same mean squared cosine to the normal as Charlie's
/// microfacets, 1 / (3 + 1 / roughness^2), and which takes half the sheen's largest component from uniform
/// light (1 - Q(d)): a like look, not the same formula. Sheen knows neither tilt nor direction: to_sheen
/// drops them, and clamps spreads wider than roughness 1 and layers denser than a white sheen.
FuzzParameters from_sheen(const SheenParameters& sheen);
SheenParameters to_sheen(const FuzzParameters& fuzz);

}  // namespace sateen::brdf
