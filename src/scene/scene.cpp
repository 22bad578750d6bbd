// SPDX-License-Identifier: MIT
#include "sateen/scene/scene.h"

#include <algorithm>

#include "sateen/core/error.h"

namespace sateen::scene {

bool Scene::lit() const {
  return std::ranges::all_of(materials,
                             [](const Material& m) { return m.appearance && m.appearance->lit(); });
}

MeshOffer offer_of(const Mesh& mesh) {
  if (mesh.triangles.empty()) throw Error("the mesh has no triangles");
  if (mesh.normals.empty()) throw Error("the mesh has no normals; compute them first");
  std::uint32_t materials = 1;
  for (const std::uint32_t id : mesh.material_ids) materials = std::max(materials, id + 1);
  return {materials, !mesh.tangents.empty(), !mesh.uvs.empty(), !mesh.curvature_forms.empty()};
}

void check_material(const MeshOffer& mesh, const Material& material) {
  if (!material.appearance) throw Error("a material has no appearance");
  const appearance::Needs needs = material.appearance->needs();
  const bool framed = material.normal_map.texture || material.direction_map.texture;
  if ((needs.tangents || framed) && !mesh.tangents) {
    throw Error("the material needs tangents and the mesh has none");
  }
  if ((needs.uvs || framed || material.occlusion_map.texture) && !mesh.uvs) {
    throw Error("the material needs texture coordinates (UVs) and the mesh has none");
  }
  if (needs.curvature && !mesh.curvature) throw Error("the material needs curvature and the mesh has none");
}

}  // namespace sateen::scene
