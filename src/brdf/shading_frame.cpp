// SPDX-License-Identifier: MIT
#include "sateen/brdf/shading_frame.h"

#include <algorithm>
#include <cmath>

namespace sateen::brdf {

Vec3 lifted_view(const Vec3& view) {
  return view.z() >= kLowestView ? view : Vec3(view.x(), view.y(), kLowestView).normalized();
}

Vec3 turned(const Vec3& direction, double azimuth) {
  const double c = std::cos(azimuth);
  const double s = std::sin(azimuth);
  return {c * direction.x() + s * direction.y(), c * direction.y() - s * direction.x(), direction.z()};
}

ShadingFrame::ShadingFrame(const appearance::Surface& surface, const Vec3& normal) {
  const Vec3 across = surface.tangent - normal * normal.dot(surface.tangent);
  const Vec3 tangent = across / std::sqrt(std::max(across.squaredNorm(), 1e-12));
  axes << tangent, surface.bitangent_sign * normal.cross(tangent), normal;
  view = lifted_view(axes.transpose() * surface.view);
}

}  // namespace sateen::brdf
