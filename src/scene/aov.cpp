// SPDX-License-Identifier: MIT
#include "sateen/scene/aov.h"

#include <array>

#include <fmt/format.h>

#include "sateen/core/error.h"

namespace sateen::scene {
namespace {

Image channels(const Image& image, int first, int count) {
  Image result(image.width, image.height, count);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < count; ++c) result.at(x, y, c) = image.at(x, y, first + c);
    }
  }
  return result;
}

}  // namespace

std::span<const std::string> aov_names() {
  static const std::array<std::string, 8> names{"normal", "tangent",   "k",        "mask",
                                                "uv",     "occlusion", "position", "mesh_normal"};
  return names;
}

Image aov(const SurfaceImages& surfaces, const std::string& name) {
  if (name == "normal") return channels(surfaces.normal, 0, 3);
  if (name == "mesh_normal") return channels(surfaces.mesh_normal, 0, 3);
  if (name == "tangent") return channels(surfaces.tangent, 0, 3);
  if (name == "position") return channels(surfaces.position, 0, 3);
  if (name == "k") return channels(surfaces.eye_normal, 3, 1);
  if (name == "mask") return channels(surfaces.uv_and_curvature, 3, 1);
  if (name == "uv") return channels(surfaces.uv_and_curvature, 0, 2);
  if (name == "occlusion") return channels(surfaces.normal, 3, 1);
  throw Error(fmt::format("there is no output variable {}", name));
}

}  // namespace sateen::scene
