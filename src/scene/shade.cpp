// SPDX-License-Identifier: MIT
#include "sateen/scene/shade.h"

#include <atomic>

#include <fmt/format.h>

#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/core/parallel.h"

namespace sateen::scene {
namespace {

using appearance::Surface;
using appearance::SurfaceField;

std::string plain_name(SurfaceField field) {
  std::string name(appearance::surface_field(field).input);
  for (char& c : name) c = c == '-' ? ' ' : c;
  return name;
}

void check(const appearance::Appearance& appearance, const ShadeInputs& inputs) {
  const auto normals = inputs.find(SurfaceField::normal);
  if (normals == inputs.end()) throw Error("shading needs a picture of normals");
  const Image& first = normals->second;
  for (const auto& [field, image] : inputs) {
    if (image.width != first.width || image.height != first.height) {
      throw Error(
          fmt::format("the picture of {} is {} x {}, that of normals {} x {}; they must be of one size",
                      plain_name(field), image.width, image.height, first.width, first.height));
    }
    const int needed = appearance::surface_field(field).components;
    if (image.channels < needed) {
      throw Error(fmt::format("the picture of {} has {} channels, {} are needed", plain_name(field),
                              image.channels, needed));
    }
  }
  const appearance::Needs needs = appearance.needs();
  const auto demand = [&](bool needed, SurfaceField field) {
    if (needed && !inputs.contains(field)) {
      throw Error(fmt::format("the material needs a picture of {}", plain_name(field)));
    }
  };
  demand(needs.tangents, SurfaceField::tangent);
  demand(needs.uvs, SurfaceField::uv);
  demand(needs.curvature, SurfaceField::curvature);
  demand(needs.curvature, SurfaceField::curvature_tensor);
}

/// What is read from the pictures is made what Surface promises; false for an empty pixel.
bool complete(const ShadeInputs& inputs, Surface& surface) {
  if (!(surface.normal.squaredNorm() > 0)) return false;
  surface.normal.normalize();
  const bool smooth = inputs.contains(SurfaceField::mesh_normal) && surface.mesh_normal.squaredNorm() > 0;
  surface.mesh_normal = smooth ? surface.mesh_normal.normalized() : surface.normal;
  if (inputs.contains(SurfaceField::position)) {
    if (!(surface.position.squaredNorm() > 0)) return false;
    surface.view = -surface.position.normalized();
  }
  const Mat3 frame = eye_frame(surface.view);
  surface.eye_normal = seen_normal(frame * surface.normal);
  if (!inputs.contains(SurfaceField::tangent)) return true;
  const Vec3 tangent = surface.tangent;
  if (!(tangent.squaredNorm() > 0)) return false;
  surface.tangent_angle = tangent_angle(frame * tangent);
  const Vec3 across = tangent - surface.normal * surface.normal.dot(tangent);
  Vec3 other;
  if (across.norm() > 1e-6 * tangent.norm()) {
    surface.tangent = across.normalized();
  } else {
    frame_around(surface.normal, surface.tangent, other);
  }
  return true;
}

}  // namespace

Image shade(const appearance::Appearance& appearance, const ShadeInputs& inputs,
            const light::Lighting& lighting, const Progress& progress) {
  check(appearance, inputs);
  const Image& normals = inputs.at(SurfaceField::normal);
  Image result(normals.width, normals.height, 4);
  std::atomic<int> rows = 0;
  parallel_for(result.height, [&](int y) {
    for (int x = 0; x < result.width; ++x) {
      Surface surface;
      for (const auto& [field, image] : inputs) set_field(surface, field, image.pixel(x, y));
      if (!complete(inputs, surface) || appearance.cover(surface) < 0.5) continue;
      result.set_rgb(x, y, appearance.radiance(surface, lighting).cast<float>());
      result.at(x, y, 3) = 1;
    }
    report(progress, (++rows + 0.0) / result.height);
  });
  return result;
}

}  // namespace sateen::scene
