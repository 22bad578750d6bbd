// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "sateen/core/vector.h"
#include "sateen/matcap/decomposition.h"

namespace sateen::matcap {

/// More or less light towards the rim (Zubiaga et al. 2015, Figure 2 and section 5.2): beyond theta0 the
/// filter's energy is multiplied by 1 + ((3 t^2 - 2 t^3) + (t^3 - t^2) m1) (alpha1 - mean of the base
/// colour), t from 0 at theta0 to 1 at pi/2, kept at or above 0. The spline is the one the authors use,
/// written as a factor so that it keeps the hue.
struct Silhouette {
  double theta0 = 0.785;  ///< radians, below pi/2
  double m1 = 0;          ///< slope of the spline at the rim
  double alpha1 = 1;      ///< energy at the rim
};

/// How one component is shown.
struct PartLook {
  Vec3 base_color{1, 1, 1};
  double intensity = 1;
  std::optional<Silhouette> silhouette;
};

/// What textures can change from point to point (section 6, Figures 15 and 16); factors in linear light or,
/// for the colours, in the space the parts add up in.
struct Modulation {
  Vec3 low_color{1, 1, 1};
  Vec3 high_color{1, 1, 1};
  double added_variance = 0;  ///< of the high part's filter, radians^2, >= 0
  double occlusion = 1;       ///< multiplies the result, linear
};

/// A decomposition with all edits applied: what is baked and rendered.
struct EditedMatcap {
  MatcapDecomposition matcap;     ///< maps with painted light, blur and mixing in them
  Mat3 light = Mat3::Identity();  ///< turns the light: a reflection from direction w moves to light * w
  std::array<PartLook, 2> looks;

  PartLook& look(Part part) { return looks[static_cast<std::size_t>(part)]; }
  const PartLook& look(Part part) const { return looks[static_cast<std::size_t>(part)]; }
};

/// The decomposition as it is.
EditedMatcap unedited(MatcapDecomposition matcap);

/// Factor of the filter's energy at angle theta from the view axis, see Silhouette.
double silhouette_factor(const Silhouette& silhouette, double theta, const Vec3& base_color);

/// One component in the space the parts add up in, at a point with unit eye-frame normal `n` (section 5): n
/// is warped, the light's turn is undone, the map is looked up and multiplied by the base colour. The paper
/// undoes the turn before the warp; then features keep their shape and move as fast as the light, as on a
/// picture pasted on a ball. Reflections do neither, and the warp is what makes them move as they should.
Vec3 evaluate_part(const EditedMatcap& matcap, Part part, const Vec3& n, const Modulation& modulation = {});

/// Both components, added up, as linear light.
Vec3 evaluate(const EditedMatcap& matcap, const Vec3& n, const Modulation& modulation = {});
/// The same with another turn of the light than matcap.light.
Vec3 evaluate(const EditedMatcap& matcap, const Mat3& light, const Vec3& n, const Modulation& modulation);

}  // namespace sateen::matcap
