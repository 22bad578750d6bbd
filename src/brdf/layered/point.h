// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/appearance/appearance.h"
#include "sateen/brdf/layered/tables.h"
#include "sateen/brdf/shading_frame.h"

namespace sateen::brdf {

/// Lookups along the stretched lobe of a material.
int lobe_lookups(const LayeredMaterial& material);

/// What of the light of the surroundings a diffuse base receives, by bands, under fuzz that lets `passing`
/// through and scatters `scattered` down.
LightBands bands_of(const LayeredMaterial& material, const std::array<double, 3>& passing,
                    const std::array<double, 3>& scattered);
/// The fuzz's bands of the light that a diffuse base receives, of the one fibre; without fuzz the bare ones.
LightBands bands_under_fuzz(const LayeredMaterial& material, const LayeredTables& tables);

/// One point of a layered material (normalised, with its tables). shaders/appearance/layered.glsl follows it
/// line by line.
class LayeredPoint : public appearance::Reflectance::Point {
 public:
  LayeredPoint(const LayeredMaterial& material, const LayeredTables& tables,
               const appearance::Surface& surface);

  Vec3 lit(const Vec3& light) const override;
  Vec3 surroundings(const light::Surroundings& surroundings) const override;
  /// Chooses among the layers, about as much light as each reflects: visible normals for the reflection, the
  /// fibres' phase function for fuzz, the cosine for the base.
  appearance::Reflectance::LightSample sample(const Vec3& u) const override;
  double pdf(const Vec3& light) const override;

 protected:
  // What the forms of src/brdf/research put others in place of.
  virtual Vec3 base_lit(const Vec3& light) const;
  virtual Vec3 base_surroundings(const light::SphericalHarmonics9& light) const;
  virtual double scattered_down(const Vec3& light) const;
  virtual Vec3 fuzz_surroundings(const light::SphericalHarmonics9& light) const;

  const LayeredMaterial& material_;
  const LayeredTables& tables_;
  ShadingFrame frame_;
  double view_total_ = 0;  ///< the reflection's albedo for this view
  // The fuzz: a frame of its own, whose normal may be smoother, the fibres here, and what passes it.
  ShadingFrame fuzz_frame_;
  FuzzParameters fuzz_;
  LightBands bands_;

 private:
  double ggx_total(const Vec3& direction) const;
  Vec3 reflected_surroundings(const light::Surroundings& surroundings) const;
  /// The chances of base, reflection and fuzz in sample().
  Vec3 chances() const;
};

}  // namespace sateen::brdf
