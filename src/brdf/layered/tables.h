// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "sateen/brdf/fuzz_table.h"
#include "sateen/brdf/fuzz_tilt_table.h"
#include "sateen/brdf/hemisphere_table.h"
#include "sateen/brdf/layered/material.h"

namespace sateen::brdf {

/// What the reflection has in common for all directions: some 10 ms of work.
struct GgxTables {
  double alpha_t = 0;
  double alpha_b = 0;
  HemisphereTable albedo;  ///< x scale, y bias of a view in the frame of the roughness' axis
  double mean_albedo = 1;
  std::shared_ptr<const TextureData> texture;

  explicit GgxTables(const AnisotropicRoughness& roughness);
};

/// The same of the fuzz: 0.15 s, with a map of fibres 5 s.
struct FuzzTables {
  FuzzParameters fuzz;  ///< made for these; colour and azimuth play no part
  bool map = false;     ///< fibres of every tilt
  FuzzTable table;      ///< of the one fibre, unless there is a map
  std::shared_ptr<const FuzzTiltTable> tilts;
  std::shared_ptr<const TextureData> down;     ///< of `table`, or the volume over tilts
  std::shared_ptr<const TextureData> ambient;  ///< likewise
  std::shared_ptr<const TextureData> bands;    ///< of the tilts

  explicit FuzzTables(const LayeredMaterial& material);
};

/// All tables of a material; null for layers it does not have.
struct LayeredTables {
  std::shared_ptr<const GgxTables> ggx;
  std::shared_ptr<const FuzzTables> fuzz;
};

/// Whether `tables` were made for a (normalised) material of these parameters.
bool fits(const LayeredTables& tables, const LayeredMaterial& material);
/// Makes what `earlier` does not have already.
LayeredTables make_tables(const LayeredMaterial& material, const LayeredTables& earlier = {});

}  // namespace sateen::brdf
