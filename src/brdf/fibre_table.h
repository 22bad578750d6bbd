// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "sateen/core/texture_data.h"
#include "sateen/core/vector.h"

namespace sateen::brdf {

/// Fibres of tables lean at least this far, in radians: nothing to the eye, and every direction has a place.
inline constexpr double kUprightTilt = 1e-3;

/// Four values for every direction w of the upper hemisphere that are the same on both sides of the plane of
/// fibre and normal: light scattered by a fibre changes fast with the angle between w and the fibre and
/// slowly along the cone of equal angles, so the table is fine along the first and coarse along the second.
/// Read bilinearly at
///   along:  sqrt(1 - w.t) - sqrt(1 + w.t), nearly even in the angle, without trigonometry in the shader;
///   across: w.n between its least (at the horizon at least) and greatest value on that cone.
/// shaders/appearance/fibre_table.glsl reads the same texels.
class FibreTable {
 public:
  FibreTable() = default;
  /// The values of directions on one cone.
  using Column = std::function<Vec4(const Vec3&)>;
  /// `fibre` is unit, in the x-z plane, z >= 0, and not quite upright (kUprightTilt): where a direction lies
  /// on its cone must mean something. Calls `column` once for each cone, given its cosine to the fibre, in
  /// parallel, and what it returns once a texel, for directions on the side of positive y, a little inside
  /// the hemisphere and off the plane.
  FibreTable(const Vec3& fibre, int along, int across, const std::function<Column(double)>& column);

  /// Directions below the horizon read the horizon. The GPU holds halves.
  Vec4 operator()(const Vec3& direction) const { return read(place(fibre_, direction)); }
  /// Where a direction lies over the texels' middles about any unit fibre, z >= 0, of any azimuth: along and
  /// across, both in [0, 1].
  static Vec2 place(const Vec3& fibre, const Vec3& direction);
  Vec4 read(const Vec2& place) const;
  /// rgba16f, or rg16f with the first two values only; `along` to the right.
  std::shared_ptr<const TextureData> texture(bool two_values = false) const;
  /// What takes the first coordinate to [0, 1] over the texels' middles: scale and offset.
  Vec2 along_coordinate() const;

 private:
  std::size_t texel_index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(along_) + static_cast<std::size_t>(i);
  }
  double cosine_at(double along) const;
  Vec3 direction(double along, double across) const;

  Vec3 fibre_{0, 0, 1};
  int along_ = 0;
  int across_ = 0;
  std::vector<Vec4f> texels_;
};

}  // namespace sateen::brdf
