// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sateen/brdf/fuzz.h"
#include "sateen/brdf/fuzz_approximations.h"
#include "sateen/brdf/fuzz_table.h"
#include "sateen/brdf/ggx.h"
#include "sateen/brdf/hemisphere_table.h"
#include "sateen/core/appearance.h"
#include "sateen/light/prefiltered.h"
#include "sateen/light/punctual.h"
#include "sateen/light/spherical_harmonics.h"

namespace sateen {

/// A material of analytic layers, from the bottom: diffuse base, GGX reflection, fuzz. docs/materials.md has
/// its file.
struct LayeredMaterial {
  enum class Base {
    lambert,
    fibre_diffuse,   ///< Hast et al. (fibre_diffuse.h), scaled to a white furnace
    maximum_normal,  ///< their comparison, scaled alike
  };
  Base base = Base::lambert;
  Vec3 base_colour{0.5, 0.5, 0.5};
  double base_azimuth = 0;  ///< of those fibres, radians counter-clockwise from the tangent

  std::optional<GgxParameters> specular;
  /// Lookups along the stretched lobe in environment light; 0: 1 for equal alphas, 8 otherwise.
  int lobe_samples = 0;

  std::optional<FuzzParameters> fuzz;
  bool fuzz_slides = false;         ///< the slides' polynomials in place of the table (fuzz_approximations.h)
  bool fuzz_scattered_down = true;  ///< off: P_s = 0 under the base layer, the slides' comparison
  /// Turns the fuzz's normal from the shading normal (0) to the mesh's without normal map (1): softer fuzz
  /// over a detailed base. The slides' "normal smoothing".
  double fuzz_smoothing = 0;

  /// Weight of the slides' simplified deferred fuzz, [0, 1]: in place of the base's diffuse light, fixed
  /// parameters, wrapped lighting. Not together with `fuzz`.
  double simple_fuzziness = 0;
};

/// At most this many lights reach the shader.
inline constexpr std::size_t kMaximumLights = 8;

/// Light around the object, in view space: what is behind the object from the viewer is an environment's
/// middle column.
struct Lighting {
  std::vector<PunctualLight> lights;
  std::shared_ptr<const PrefilteredEnvironment> environment;  ///< may be null: no reflections of surroundings
  SphericalHarmonics9 harmonics;                              ///< diffuse light of the surroundings

  /// Prefilters a latitude-longitude picture.
  void set_environment(const Image& latitude_longitude);
};

/// LayeredMaterial under Lighting. Punctual lights follow the models' formulas; light of the surroundings
/// comes from prefiltered tables and harmonics, the same in evaluate() and in shaders/layered.glsl.
class LayeredAppearance : public Appearance {
 public:
  LayeredAppearance(LayeredMaterial material, Lighting lighting);

  /// A material file with "model": "layered". Throws Error naming file, key and value.
  static std::unique_ptr<Appearance> read(const std::filesystem::path& path);
  /// The same from JSON text; `path` is what messages call it and where its pictures lie.
  static std::unique_ptr<LayeredAppearance> parse(const std::string& json, const std::filesystem::path& path);

  Vec3 evaluate(const Surface& surface) const override;
  ShaderBinding shader() const override;
  Needs needs() const override;
  bool set_environment(const Image& latitude_longitude) override;

  const LayeredMaterial& material() const { return material_; }
  const Lighting& lighting() const { return lighting_; }

 private:
  /// Axes of the shading frame in view space.
  struct Frame {
    Vec3 tangent, bitangent, normal;
    Vec3 into(const Vec3& w) const { return {w.dot(tangent), w.dot(bitangent), w.dot(normal)}; }
    Vec3 out_of(const Vec3& w) const { return w.x() * tangent + w.y() * bitangent + w.z() * normal; }
  };
  /// A shading frame and the view in it, never below the horizon. The fuzz has one of its own, whose normal
  /// may be smoother.
  struct Seen {
    Frame frame;
    Vec3 view;
  };

  static Seen seen(const Surface& surface, const Vec3& normal);
  double scattered_down(const Vec3& light) const;
  Vec3 direct(const Vec3& light, const Seen& base, const Seen& layer) const;
  Vec3 simple_fuzz(const Vec3& light, const Vec3& view) const;
  Vec3 received(const Vec3& normal) const;
  Vec3 diffuse_surroundings(const Frame& frame) const;
  Vec3 reflected_surroundings(const Seen& base) const;
  Vec3 fuzz_surroundings(const Seen& layer) const;
  Vec3 surroundings(const Seen& base, const Seen& layer) const;
  std::array<Vec3, 3> base_bands() const;
  int lobe_samples() const;

  LayeredMaterial material_;
  Lighting lighting_;
  HemisphereTable albedo_;  ///< GGX: x scale, y bias of a view in the frame of the roughness' axis
  double mean_albedo_ = 1;
  bool keep_lights_ = true;  ///< off for the stand-in lamp, which goes when an environment is set
  FuzzTable fuzz_table_;
  ScatteredDownPolynomial fuzz_polynomial_;
  /// Legendre coefficients of the light of the surroundings that a diffuse base receives, per channel.
  std::array<Vec3, 3> base_bands_;
};

}  // namespace sateen
