// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "sateen/appearance/appearance.h"
#include "sateen/brdf/layered/layered.h"

namespace sateen::brdf {

/// Layered materials in the forms that the slides print (Patry, "Samurai Shading"), for comparison with
/// LayeredAppearance.
struct SlidesMaterial {
  LayeredMaterial layers = {};
  /// The fuzz's integrals by the slides' polynomials and ambient products (fuzz_approximations.h), not by
  /// table. Not with a map of fibres.
  bool polynomials = false;
  /// Weight of the simplified fuzz for deferred shading, [0, 1]: in place of the base's diffuse light, fixed
  /// parameters, wrapped lighting. Not together with layers.fuzz.
  double simple_fuzziness = 0;
};

/// shaders/research/slides.glsl does the same. What is changed on it takes effect at once.
class SlidesAppearance final : public appearance::Reflectance {
 public:
  explicit SlidesAppearance(SlidesMaterial material);
  ~SlidesAppearance() override;

  std::unique_ptr<Point> at(const appearance::Surface& surface) const override;
  appearance::ShaderModule shader() const override;
  appearance::ShaderValues values() const override;
  appearance::Needs needs() const override { return layers_.needs(); }

  /// Those of the layers; without fuzz simple_fuzziness in place of the fuzz's.
  std::vector<appearance::Parameter> parameters() const override;
  appearance::ParameterValue get(const std::string& name) const override;
  void set(const std::string& name, const appearance::ParameterValue& value) override;

 private:
  struct Fit;
  void refit();
  void check_name(const std::string& name) const;

  LayeredAppearance layers_;
  bool polynomials_;
  double simple_fuzziness_;
  std::shared_ptr<const Fit> fit_;  ///< of the fuzz, where there is one
};

/// A material of "model": "layered": a SlidesAppearance where the file asks for one ("approximation":
/// "slides" of the fuzz, "simple_fuzziness"), else a LayeredAppearance. Throws Error naming file, key and
/// value.
std::unique_ptr<appearance::Appearance> parse_layered(const std::string& json,
                                                      const std::filesystem::path& path);

}  // namespace sateen::brdf
