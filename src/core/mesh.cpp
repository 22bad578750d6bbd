// SPDX-License-Identifier: MIT
#include "sateen/core/mesh.h"

#include <algorithm>

#include <fmt/format.h>

#include "sateen/core/error.h"

namespace sateen {

void check(const Mesh& mesh) {
  const std::size_t vertices = mesh.positions.size();
  const auto along = [&](const auto& values, const char* name) {
    if (!values.empty() && values.size() != vertices)
      throw Error(fmt::format("has {} {} for {} vertices", values.size(), name, vertices));
  };
  along(mesh.normals, "normals");
  along(mesh.tangents, "tangents");
  along(mesh.uvs, "texture coordinates");
  along(mesh.occlusion, "values of occlusion");
  along(mesh.curvature, "values of curvature");
  along(mesh.curvature_forms, "curvature tensors");
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t corner : mesh.triangles[i]) {
      if (corner >= vertices)
        throw Error(fmt::format("triangle {} uses vertex {}, there are {}", i, corner, vertices));
    }
  }
  if (!mesh.material_ids.empty() && mesh.material_ids.size() != mesh.triangles.size()) {
    throw Error(
        fmt::format("has {} materials for {} triangles", mesh.material_ids.size(), mesh.triangles.size()));
  }
}

}  // namespace sateen
