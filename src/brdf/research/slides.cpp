// SPDX-License-Identifier: MIT
#include "sateen/brdf/research/slides.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "sateen/appearance/json_reader.h"
#include "sateen/brdf/bind.h"
#include "sateen/brdf/fuzz_approximations.h"
#include "sateen/brdf/layered/point.h"
#include "sateen/brdf/research/simple_fuzz.h"
#include "sateen/io/json.h"

namespace sateen::brdf {
namespace {

using appearance::Parameter;
using appearance::ParameterValue;

const Parameter& simple_parameter() {
  static const Parameter parameter{
      .name = "simple_fuzziness",
      .help = "weight of the slides' simplified fuzz, in place of the base; not with fuzz"};
  return parameter;
}

}  // namespace

struct SlidesAppearance::Fit {
  ScatteredDownPolynomial scattered_down;
  LightBands bands;
};

namespace {

/// What of the surroundings' light a base receives, by the slides' Q~ and R.
LightBands slides_bands(const LayeredMaterial& material, const LayeredTables& tables) {
  const double q = fuzz_passing_albedo_slides(material.fuzz->density);
  std::array<double, 3> passing = FuzzTable().passing_bands;
  std::array<double, 3> scattered = passing;
  for (double& band : scattered) band *= tables.fuzz->table.scattered_down_mean * (1 - q);
  for (double& band : passing) band *= q;
  return bands_of(material, passing, scattered);
}

class SlidesPoint final : public LayeredPoint {
 public:
  SlidesPoint(const LayeredAppearance& layers, const ScatteredDownPolynomial* polynomial,
              const LightBands* bands, double simple_fuzziness, const appearance::Surface& surface)
      : LayeredPoint(layers.material(), layers.tables(), surface),
        polynomial_(polynomial),
        simple_fuzziness_(simple_fuzziness) {
    if (bands) bands_ = *bands;
  }

 protected:
  Vec3 base_lit(const Vec3& light) const override {
    const Vec3 base = LayeredPoint::base_lit(light);
    if (simple_fuzziness_ == 0) return base;
    return (1 - simple_fuzziness_) * base +
           simple_fuzziness_ * simple_fuzz_lit(material_.base.color, light, frame_.view);
  }
  Vec3 base_surroundings(const light::SphericalHarmonics9& light) const override {
    const Vec3 base = LayeredPoint::base_surroundings(light);
    if (simple_fuzziness_ == 0) return base;
    const Vec3 mean = light.hemisphere_mean(frame_.axes.col(2));
    return (1 - simple_fuzziness_) * base +
           simple_fuzziness_ * simple_fuzz_surroundings(material_.base.color, mean, frame_.view);
  }
  double scattered_down(const Vec3& light) const override {
    return polynomial_ ? (*polynomial_)(light, fuzz_) : LayeredPoint::scattered_down(light);
  }
  Vec3 fuzz_surroundings(const light::SphericalHarmonics9& light) const override {
    if (!polynomial_) return LayeredPoint::fuzz_surroundings(light);
    const double visibility = fuzz_visibility_slides(fuzz_.density, fuzz_frame_.view.z());
    return fuzz_.colour.cwiseProduct(light.hemisphere_mean(fuzz_frame_.axes.col(2))) *
           (visibility * (1 - scattered_down(fuzz_frame_.view)));
  }

 private:
  const ScatteredDownPolynomial* polynomial_;
  double simple_fuzziness_;
};

}  // namespace

SlidesAppearance::SlidesAppearance(SlidesMaterial material)
    : layers_(std::move(material.layers)),
      polynomials_(material.polynomials),
      simple_fuzziness_(material.simple_fuzziness) {
  refit();
}

SlidesAppearance::~SlidesAppearance() = default;

void SlidesAppearance::refit() {
  const LayeredMaterial& layers = layers_.material();
  if (!polynomials_ || !layers.fuzz) return;
  fit_ = std::make_shared<const Fit>(
      Fit{fit_scattered_down(*layers.fuzz, ScatteredDownPolynomial::kSlidesDegree),
          slides_bands(layers, layers_.tables())});
}

std::unique_ptr<appearance::Reflectance::Point> SlidesAppearance::at(
    const appearance::Surface& surface) const {
  return std::make_unique<SlidesPoint>(layers_, fit_ ? &fit_->scattered_down : nullptr,
                                       fit_ ? &fit_->bands : nullptr, simple_fuzziness_, surface);
}

appearance::ShaderModule SlidesAppearance::shader() const {
  appearance::ShaderModule module = layers_.shader();
  // Fuzz by table has the product's functions; without fuzz nothing asks for them.
  if (!fit_ && layers_.material().fuzz) return module;
  module.texts = {{"slides.glsl", ""}};
  module.defines.emplace_back("SLIDES_SIMPLE", simple_fuzziness_ > 0 ? "true" : "false");
  module.defines.emplace_back("LAYERED_WRAPPED", simple_fuzziness_ > 0 ? "true" : "false");
  return module;
}

appearance::ShaderValues SlidesAppearance::values() const {
  appearance::ShaderValues values = layers_.values();
  const auto optional = [&](const char* name, appearance::UniformValue value) {
    values.uniforms.push_back({name, std::move(value), true});
  };
  optional("slides_simple_fuzziness", static_cast<float>(simple_fuzziness_));
  if (!fit_) return values;
  const std::vector<double>& c = fit_->scattered_down.coefficients;
  optional("slides_down_low", narrow(Vec3(c[0], c[1], c[2])));
  optional("slides_down_high", narrow(Vec3(c[3], c[4], c[5])));
  std::vector<Vec3f> bands;
  for (const Vec3& band : fit_->bands) bands.push_back(narrow(band));
  values.uniforms.push_back({"base_bands", bands});  // after those of the layers: the last one counts
  return values;
}

std::vector<Parameter> SlidesAppearance::parameters() const {
  // The simplified fuzz takes the place of fuzz: a material has one of the two.
  const bool fuzz = layers_.material().fuzz.has_value();
  std::vector<Parameter> result = layers_.parameters();
  if (!fuzz) {
    std::erase_if(result, [](const Parameter& parameter) { return parameter.name.starts_with("fuzz."); });
    result.push_back(simple_parameter());
  }
  return result;
}

void SlidesAppearance::check_name(const std::string& name) const {
  const std::vector<Parameter> known = parameters();
  if (std::ranges::none_of(known, [&](const Parameter& parameter) { return parameter.name == name; })) {
    appearance::unknown_parameter(name, known);
  }
}

ParameterValue SlidesAppearance::get(const std::string& name) const {
  check_name(name);
  return name == simple_parameter().name ? ParameterValue(simple_fuzziness_) : layers_.get(name);
}

void SlidesAppearance::set(const std::string& name, const ParameterValue& value) {
  check_name(name);
  if (name == simple_parameter().name) {
    appearance::check(simple_parameter(), value);
    simple_fuzziness_ = std::get<double>(value);
  } else {
    layers_.set(name, value);
    layers_.settle(true);
    refit();
  }
  changed();
}

std::unique_ptr<appearance::Appearance> parse_layered(const std::string& text,
                                                      const std::filesystem::path& path) {
  static const std::array<std::string, 2> approximations{"table", "slides"};
  const nlohmann::json value = io::parse_json(text, path.string());
  std::unique_ptr<LayeredAppearance> layers = LayeredAppearance::parse(text, path);
  appearance::JsonObject json(value, path.string());
  const double simple = std::get<double>(json.read(simple_parameter()));
  bool polynomials = false;
  if (json.has("fuzz")) {
    appearance::JsonObject fuzz(json.raw("fuzz"), fmt::format("{}, fuzz", path.string()));
    polynomials = fuzz.choice("approximation", "table", approximations) == "slides";
    if (polynomials && fuzz.has("fibres")) fuzz.fail("approximation", "\"table\" where \"fibres\" is given");
    if (simple > 0) json.fail("simple_fuzziness", "left out where \"fuzz\" is given");
  }
  if (!polynomials && simple == 0) return layers;
  return std::make_unique<SlidesAppearance>(
      SlidesMaterial{.layers = layers->material(), .polynomials = polynomials, .simple_fuzziness = simple});
}

}  // namespace sateen::brdf
