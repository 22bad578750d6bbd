// SPDX-License-Identifier: MIT
#include "sateen/scene/shade.h"

#include <atomic>

#include <fmt/format.h>

#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/core/parallel.h"
#include "sateen/scene/surface_images.h"

namespace sateen::scene {
namespace {

struct Plane {
  const char* name;
  const Image& image;
  int channels;  ///< needed
};

void check(const appearance::Appearance& appearance, const ShadeInputs& inputs) {
  if (inputs.normals.empty()) throw Error("shading needs a picture of normals");
  const Plane planes[] = {{"normals", inputs.normals, 3},
                          {"tangents", inputs.tangents, 3},
                          {"positions", inputs.positions, 3},
                          {"occlusion", inputs.occlusion, 1},
                          {"UVs", inputs.uvs, 2},
                          {"curvature", inputs.curvature, 1},
                          {"mesh normals", inputs.mesh_normals, 3}};
  for (const Plane& plane : planes) {
    if (plane.image.empty()) continue;
    if (plane.image.width != inputs.normals.width || plane.image.height != inputs.normals.height) {
      throw Error(fmt::format(
          "the picture of {} is {} x {}, that of normals {} x {}; they must be of one size", plane.name,
          plane.image.width, plane.image.height, inputs.normals.width, inputs.normals.height));
    }
    if (plane.image.channels < plane.channels) {
      throw Error(fmt::format("the picture of {} has {} channels, {} are needed", plane.name,
                              plane.image.channels, plane.channels));
    }
  }
  const appearance::Appearance::Needs needs = appearance.needs();
  const auto demand = [](bool needed, const Image& image, const char* name) {
    if (needed && image.empty()) throw Error(fmt::format("the material needs a picture of {}", name));
  };
  demand(needs.tangents, inputs.tangents, "tangents");
  demand(needs.uvs, inputs.uvs, "UVs");
  demand(needs.curvature, inputs.curvature, "curvature");
}

/// Fills `surface`; false for an empty pixel.
bool surface_of(const ShadeInputs& inputs, int x, int y, appearance::Surface& surface) {
  const Vec3 normal = xyz(inputs.normals, x, y);
  if (!(normal.squaredNorm() > 0)) return false;
  surface.normal = normal.normalized();
  surface.mesh_normal = surface.normal;
  if (!inputs.mesh_normals.empty()) {
    const Vec3 mesh_normal = xyz(inputs.mesh_normals, x, y);
    if (mesh_normal.squaredNorm() > 0) surface.mesh_normal = mesh_normal.normalized();
  }
  if (!inputs.positions.empty()) {
    surface.position = xyz(inputs.positions, x, y);
    if (!(surface.position.squaredNorm() > 0)) return false;
    surface.view = -surface.position.normalized();
  }
  const Mat3 frame = eye_frame(surface.view);
  surface.eye_normal = seen_normal(frame * surface.normal);
  if (!inputs.tangents.empty()) {
    const Vec3 tangent = xyz(inputs.tangents, x, y);
    if (!(tangent.squaredNorm() > 0)) return false;
    surface.tangent_angle = tangent_angle(frame * tangent);
    const Vec3 across = tangent - surface.normal * surface.normal.dot(tangent);
    Vec3 other;
    if (across.norm() > 1e-6 * tangent.norm()) {
      surface.tangent = across.normalized();
    } else {
      frame_around(surface.normal, surface.tangent, other);
    }
  }
  if (!inputs.occlusion.empty()) surface.occlusion = inputs.occlusion.at(x, y, 0);
  if (!inputs.uvs.empty()) surface.uv = Vec2(inputs.uvs.at(x, y, 0), inputs.uvs.at(x, y, 1));
  if (!inputs.curvature.empty()) surface.curvature = inputs.curvature.at(x, y, 0);
  return true;
}

}  // namespace

Image shade(const appearance::Appearance& appearance, const ShadeInputs& inputs, const Progress& progress) {
  check(appearance, inputs);
  Image result(inputs.normals.width, inputs.normals.height, 4);
  std::atomic<int> rows = 0;
  parallel_for(result.height, [&](int y) {
    for (int x = 0; x < result.width; ++x) {
      appearance::Surface surface;
      if (!surface_of(inputs, x, y, surface)) continue;
      result.set_rgb(x, y, appearance.evaluate(surface).cast<float>());
      result.at(x, y, 3) = 1;
    }
    report(progress, (++rows + 0.0) / result.height);
  });
  return result;
}

}  // namespace sateen::scene
