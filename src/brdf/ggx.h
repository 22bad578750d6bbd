// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/vector.h"

namespace sateen::brdf {

// Anisotropic GGX microfacet reflection: Walter et al. 2007 made anisotropic as in Burley 2012,
// height-correlated Smith masking-shadowing (Heitz 2014), Schlick's Fresnel; the matrix form is Patry,
// "Samurai Shading", after SGGX (Heitz et al. 2015). Directions are unit vectors in the shading frame
// (tangent x, bitangent y, normal z) and point away from the surface. alpha is the GGX roughness (slope
// scale), in (0, 1].

/// Two roughnesses and their axis. The axis is a line: `azimuth` and azimuth + pi are the same surface.
struct AnisotropicRoughness {
  double alpha_t = 0.3;  ///< along the axis
  double alpha_b = 0.3;  ///< across it
  double azimuth = 0;    ///< of the axis, radians counter-clockwise from the tangent
};

/// A GGX surface as parameter files describe it.
struct GgxParameters {
  AnisotropicRoughness roughness;
  Vec3 f0{0.04, 0.04, 0.04};         ///< reflectance at normal incidence
  bool energy_compensation = false;  ///< give back what single scattering loses (ggx_multiple_scattering)
};

/// The smallest alpha the evaluators use; sharper lobes are numerically mirrors.
inline constexpr double kMinimumAlpha = 1e-3;

/// The 2 x 2 matrix [[Sxx, Sxy], [Sxy, Syy]] of slope variances in the shading frame: R diag(at^2, ab^2) R^T.
Mat2 roughness_matrix(const AnisotropicRoughness& roughness);

/// Back from a symmetric matrix by its eigenvectors, alpha_t >= alpha_b, azimuth in [0, pi). Eigenvalues are
/// clamped to [kMinimumAlpha^2, 1], which also guards against matrices that interpolation made indefinite.
AnisotropicRoughness roughness_from_matrix(const Mat2& matrix);

/// D(h), normalised: the integral of D(h) (n.h) over the hemisphere is 1. 0 below the horizon.
double ggx_distribution(const AnisotropicRoughness& roughness, const Vec3& half);

/// Smith's Lambda of a direction; masking G1 = 1 / (1 + Lambda).
double ggx_lambda(const AnisotropicRoughness& roughness, const Vec3& direction);

/// Schlick's approximation with a reflectance of 1 at grazing angles.
Vec3 fresnel_schlick(const Vec3& f0, double cosine);

/// The BRDF (1/sr), without the cosine: F D / (4 (n.u)(n.v)(1 + Lambda(u) + Lambda(v))). Reciprocal. 0 when a
/// direction is at or below the horizon.
Vec3 ggx_brdf(const AnisotropicRoughness& roughness, const Vec3& f0, const Vec3& light, const Vec3& view);

/// A half vector of the distribution visible from `view` (Heitz 2018, "Sampling the GGX Distribution of
/// Visible Normals"); `sample` is uniform in [0, 1)^2.
Vec3 ggx_sample_visible(const AnisotropicRoughness& roughness, const Vec3& view, const Vec2& sample);

/// The density (1/sr) with which lights reflected about ggx_sample_visible's half vectors fall: G1(v) D(h) /
/// (4 (n.v)). Lights below the horizon have a density too: those samples are lost to masking.
double ggx_visible_pdf(const AnisotropicRoughness& roughness, const Vec3& light, const Vec3& view);

/// Directional albedo split by Fresnel's two parts: the reflectance in uniform light is f0 * scale + bias.
struct GgxAlbedo {
  double scale = 0;
  double bias = 0;
  double total() const { return scale + bias; }  ///< for f0 = 1, at most 1: single scattering loses energy
};

/// By Gauss cubature over visible normals; error below 1e-3 at the default order for alpha >= 0.05.
GgxAlbedo ggx_albedo(const AnisotropicRoughness& roughness, const Vec3& view, int order = 32);

/// Cosine-weighted mean of GgxAlbedo::total over the hemisphere.
double ggx_mean_albedo(const AnisotropicRoughness& roughness);

/// The light that single scattering loses, given back by Kulla and Conty's reciprocal lobe ("Revisiting
/// Physically Based Shading at Imageworks", 2017): added to ggx_brdf. `albedo_light`, `albedo_view` are
/// GgxAlbedo::total of the two directions, `mean_albedo` their cosine-weighted mean over the hemisphere.
Vec3 ggx_multiple_scattering(const Vec3& f0, double albedo_light, double albedo_view, double mean_albedo);

}  // namespace sateen::brdf
