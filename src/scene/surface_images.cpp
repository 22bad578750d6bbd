// SPDX-License-Identifier: MIT
#include "sateen/scene/surface_images.h"

#include <algorithm>

#include <fmt/format.h>

#include "sateen/core/error.h"

namespace sateen::scene {
namespace {

constexpr int kChannels = 4;

float component(const SurfaceImages& images, int x, int y, int index) {
  return images.packed[static_cast<std::size_t>(index / kChannels)].at(x, y, index % kChannels);
}

}  // namespace

int packed_pictures() {
  return (appearance::packed_components() + kChannels - 1) / kChannels;
}

std::optional<appearance::Surface> surface_at(const SurfaceImages& images, int x, int y) {
  std::vector<float> packed(static_cast<std::size_t>(appearance::packed_components()));
  for (std::size_t i = 0; i < packed.size(); ++i) packed[i] = component(images, x, y, static_cast<int>(i));
  const appearance::Surface surface = appearance::unpacked(packed);
  if (surface.coverage <= 0) return std::nullopt;
  return surface;
}

std::span<const std::string> aov_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const appearance::SurfaceFieldInfo& field : appearance::surface_fields()) {
      if (!field.aov.empty()) result.emplace_back(field.aov);
    }
    return result;
  }();
  return names;
}

Image aov(const SurfaceImages& images, const std::string& name) {
  const auto fields = appearance::surface_fields();
  const auto field =
      std::ranges::find_if(fields, [&](const auto& f) { return !name.empty() && f.aov == name; });
  if (field == fields.end()) throw Error(fmt::format("there is no output variable {}", name));
  const Image& first = images.packed.front();
  Image result(first.width, first.height, field->components);
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x) {
      for (int c = 0; c < result.channels; ++c)
        result.at(x, y, c) = component(images, x, y, field->first + c);
    }
  }
  return result;
}

}  // namespace sateen::scene
