// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "sateen/brdf/fuzz_table.h"

namespace sateen::brdf {

/// FuzzTable for fibres of every tilt, for fuzz whose fibres change from point to point. Tables of single
/// tilts lie one over the other, even in 2 sin(tilt / 2), and are read linearly between them, each at the
/// place the direction has about the actual fibre.
class FuzzTiltTable {
 public:
  /// Of density, spread and phase function; tilt, azimuth and colour are not used. About kTilts times the
  /// time of make_fuzz_table.
  explicit FuzzTiltTable(const FuzzParameters& fuzz);

  /// P_s of a light. `fibre` is unit, z >= 0, of any azimuth, as below.
  double scattered_down(const Vec3& fibre, const Vec3& light) const;
  /// FuzzTable::ambient of a view, in the frame of the fibre's azimuth.
  Vec4 ambient(const Vec3& fibre, const Vec3& view) const;
  /// FuzzTable::scattered_bands.
  std::array<double, 3> scattered_bands(const Vec3& fibre) const;
  /// The same for all fibres.
  const std::array<double, 3>& passing_bands() const { return tables_.front().passing_bands; }

  /// Volumes for the shader, rgba16f: along to the right, across, and tilt in depth.
  std::shared_ptr<const TextureData> down_texture() const;
  std::shared_ptr<const TextureData> ambient_texture() const;
  /// One row over tilt, rgba16f: scattered bands 0, 1, 2.
  std::shared_ptr<const TextureData> bands_texture() const;

  static constexpr int kTilts = 33;

 private:
  std::vector<FuzzTable> tables_;
};

}  // namespace sateen::brdf
