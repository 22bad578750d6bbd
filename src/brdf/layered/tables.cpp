// SPDX-License-Identifier: MIT
#include "sateen/brdf/layered/tables.h"

#include "sateen/brdf/shading_frame.h"

namespace sateen::brdf {
namespace {

constexpr int kTableSize = 33;

bool ggx_fits(const LayeredTables& tables, const LayeredMaterial& material) {
  if (!material.specular) return true;
  const AnisotropicRoughness& r = material.specular->roughness;
  return tables.ggx && tables.ggx->alpha_t == r.alpha_t && tables.ggx->alpha_b == r.alpha_b;
}

bool fuzz_fits(const LayeredTables& tables, const LayeredMaterial& material) {
  if (!material.fuzz) return true;
  if (!tables.fuzz) return false;
  const FuzzParameters& a = tables.fuzz->fuzz;
  const FuzzParameters& b = *material.fuzz;
  const bool map = material.fuzz_fibres.has_value();
  return a.density == b.density && a.alpha == b.alpha && a.k == b.k && a.phase == b.phase &&
         tables.fuzz->map == map && (map || a.tilt == b.tilt);
}

}  // namespace

GgxTables::GgxTables(const AnisotropicRoughness& roughness)
    : alpha_t(roughness.alpha_t), alpha_b(roughness.alpha_b) {
  const AnisotropicRoughness along{alpha_t, alpha_b, 0};
  albedo = HemisphereTable(kTableSize, [&](const Vec3& w) {
    const GgxAlbedo value = ggx_albedo(along, lifted_view(w), 24);
    return Vec4(value.scale, value.bias, 0, 0);
  });
  mean_albedo = ggx_mean_albedo(along);
  texture = albedo.texture();
}

FuzzTables::FuzzTables(const LayeredMaterial& material)
    : fuzz(*material.fuzz), map(material.fuzz_fibres.has_value()) {
  if (map) {
    tilts = std::make_shared<const FuzzTiltTable>(fuzz);
    down = tilts->down_texture();
    ambient = tilts->ambient_texture();
    bands = tilts->bands_texture();
    return;
  }
  table = make_fuzz_table(fuzz);
  down = table.scattered_down.texture(true);
  ambient = table.ambient.texture();
}

bool fits(const LayeredTables& tables, const LayeredMaterial& material) {
  return ggx_fits(tables, material) && fuzz_fits(tables, material);
}

LayeredTables make_tables(const LayeredMaterial& material, const LayeredTables& earlier) {
  LayeredTables tables;
  if (material.specular) {
    tables.ggx = ggx_fits(earlier, material)
                     ? earlier.ggx
                     : std::make_shared<const GgxTables>(material.specular->roughness);
  }
  if (material.fuzz) {
    tables.fuzz = fuzz_fits(earlier, material) ? earlier.fuzz : std::make_shared<const FuzzTables>(material);
  }
  return tables;
}

}  // namespace sateen::brdf
