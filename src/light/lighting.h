// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "sateen/core/image.h"
#include "sateen/light/prefiltered.h"
#include "sateen/light/punctual.h"
#include "sateen/light/spherical_harmonics.h"

namespace sateen::light {

/// At most this many lamps reach the shader.
inline constexpr std::size_t kMaximumLamps = 8;

/// Light from infinitely far all around, prefiltered once for all materials. Turning it is a matrix, never a
/// resampled picture.
struct Surroundings {
  std::shared_ptr<const PrefilteredEnvironment>
      environment;                                ///< null: only the harmonics, nothing to be reflected
  Mat3 environment_from_view = Mat3::Identity();  ///< of the environment's own directions
  SphericalHarmonics9 harmonics;                  ///< view space

  /// Radiance from a unit direction in view space, blurred for a GGX alpha; black without an environment.
  Vec3 radiance(const Vec3& direction, double alpha) const;
};

/// The light of a scene, in view space: the middle column of an environment is what is behind the object.
struct Lighting {
  std::vector<PunctualLight> lamps;
  Surroundings surroundings;
};

/// Prefilters a latitude-longitude picture (environment.h), at most 512 pixels wide.
Surroundings make_surroundings(const Image& latitude_longitude);
/// The same radiance from everywhere, without anything to be reflected.
Surroundings even_surroundings(const Vec3& radiance);
/// Light from direction d then comes from rotation * d.
Surroundings turned(const Surroundings& surroundings, const Mat3& rotation);

/// The rotation about the vertical (+y) by `angle` radians, counter-clockwise seen from above: what was
/// behind the object moves to the viewer's left.
Mat3 turn_about_vertical(double angle);

}  // namespace sateen::light
