// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sateen/appearance/appearance.h"
#include "sateen/brdf/fuzz.h"
#include "sateen/brdf/fuzz_approximations.h"
#include "sateen/brdf/fuzz_table.h"
#include "sateen/brdf/fuzz_tilt_table.h"
#include "sateen/brdf/ggx.h"
#include "sateen/brdf/hemisphere_table.h"
#include "sateen/light/prefiltered.h"
#include "sateen/light/punctual.h"
#include "sateen/light/spherical_harmonics.h"

namespace sateen::brdf {

struct FibreMoments;

/// Fibres that change from point to point, brushed pile: x / 2 + 1/2 and y / 2 + 1/2 of the unit fibre in the
/// shading frame, the end that points out of the surface, in the first two channels, like a normal map.
/// Repeats over the mesh's UVs, v up.
struct FibreMap {
  std::shared_ptr<const Image> picture;
  Vec2 repeat{1, 1};

  /// Read bilinearly and made unit; z >= 0, and not quite upright (kUprightTilt).
  Vec3 fibre(const Vec2& uv) const;
};

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
  std::optional<FibreMap> fuzz_fibres;  ///< in place of the fuzz's tilt and azimuth; not with fuzz_slides
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
  std::vector<light::PunctualLight> lights;
  std::shared_ptr<const light::PrefilteredEnvironment>
      environment;                       ///< may be null: no reflections of surroundings
  light::SphericalHarmonics9 harmonics;  ///< diffuse light of the surroundings

  /// Prefilters a latitude-longitude picture.
  void set_environment(const Image& latitude_longitude);
};

/// LayeredMaterial under Lighting. Punctual lights follow the models' formulas; light of the surroundings
/// comes from prefiltered tables and harmonics, the same in evaluate() and in shaders/layered.glsl.
class LayeredAppearance : public appearance::Appearance {
 public:
  LayeredAppearance(LayeredMaterial material, Lighting lighting);

  /// A material file with "model": "layered". Throws Error naming file, key and value.
  static std::unique_ptr<appearance::Appearance> read(const std::filesystem::path& path);
  /// The same from JSON text; `path` is what messages call it and where its pictures lie.
  static std::unique_ptr<LayeredAppearance> parse(const std::string& json, const std::filesystem::path& path);

  Vec3 evaluate(const appearance::Surface& surface) const override;
  appearance::ShaderBinding shader() const override;
  Needs needs() const override;
  bool set_environment(const Image& latitude_longitude) override;

  const LayeredMaterial& material() const { return material_; }
  const Lighting& lighting() const { return lighting_; }

 private:
  /// A shading frame (tangent, bitangent, normal in view space) and the view in it, never below the horizon.
  struct Seen {
    Mat3 frame;
    Vec3 view;
    Vec3 into(const Vec3& w) const { return frame.transpose() * w; }
  };
  /// The fuzz at one point: a frame of its own, whose normal may be smoother, the fibres there, and the
  /// Legendre coefficients of the light of the surroundings that a diffuse base receives, per channel.
  struct Layer : Seen {
    FuzzParameters fuzz;
    std::array<Vec3, 3> bands;
  };
  using Bands = std::array<double, 3>;

  static const FibreMoments& moments(LayeredMaterial::Base base);
  static Seen seen(const appearance::Surface& surface, const Vec3& normal);
  Layer layer(const appearance::Surface& surface, const Seen& base) const;
  std::array<Vec3, 3> bands_under_fuzz(const Bands& passing, const Bands& scattered) const;
  std::array<Vec3, 3> base_bands() const;
  double scattered_down(const FuzzParameters& fuzz, const Vec3& light) const;
  Vec3 direct(const Vec3& light, const Seen& base, const Layer& layer) const;
  Vec3 simple_fuzz(const Vec3& light, const Vec3& view) const;
  Vec3 received(const Vec3& normal, const Layer& layer) const;
  Vec3 diffuse_surroundings(const Mat3& frame, const Layer& layer) const;
  Vec3 reflected_surroundings(const Seen& base, const Layer& layer) const;
  Vec3 fuzz_surroundings(const Layer& layer) const;
  Vec3 surroundings(const Seen& base, const Layer& layer) const;
  int lobe_samples() const;
  void bind_lights(appearance::ShaderBinding& binding) const;
  void bind_base(appearance::ShaderBinding& binding) const;
  void bind_reflection(appearance::ShaderBinding& binding) const;
  void bind_fuzz(appearance::ShaderBinding& binding) const;

  LayeredMaterial material_;  ///< with alpha_t >= alpha_b
  Lighting lighting_;
  HemisphereTable albedo_;  ///< GGX: x scale, y bias of a view in the frame of the roughness' axis
  double mean_albedo_ = 1;
  bool keep_lights_ = true;  ///< off for the stand-in lamp, which goes when an environment is set
  FuzzTable fuzz_table_;     ///< of the one fibre, unless there is a map
  std::shared_ptr<const FuzzTiltTable> fuzz_tilts_;
  ScatteredDownPolynomial fuzz_polynomial_;
  std::array<Vec3, 3> base_bands_;  ///< of the one fibre
};

}  // namespace sateen::brdf
