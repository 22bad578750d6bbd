// SPDX-License-Identifier: MIT
#include "sateen/scene/surface_images.h"

namespace sateen::scene {

std::optional<appearance::Surface> surface_at(const SurfaceImages& images, int x, int y) {
  const int material = static_cast<int>(images.position.at(x, y, 3));
  if (material == 0) return std::nullopt;
  appearance::Surface surface;
  surface.position = xyz(images.position, x, y);
  surface.material = material - 1;
  surface.normal = xyz(images.normal, x, y);
  surface.mesh_normal = xyz(images.mesh_normal, x, y);
  surface.side = images.mesh_normal.at(x, y, 3);
  surface.occlusion = images.normal.at(x, y, 3);
  surface.tangent = xyz(images.tangent, x, y);
  surface.bitangent_sign = images.tangent.at(x, y, 3);
  surface.eye_normal = xyz(images.eye_normal, x, y);
  surface.tangent_angle = images.eye_normal.at(x, y, 3);
  surface.uv = Vec2(images.uv_and_curvature.at(x, y, 0), images.uv_and_curvature.at(x, y, 1));
  surface.curvature = images.uv_and_curvature.at(x, y, 2);
  surface.view = images.perspective ? Vec3(-surface.position.normalized()) : Vec3(0, 0, 1);
  return surface;
}

}  // namespace sateen::scene
