// SPDX-License-Identifier: MIT
#include "sateen/matcap/matcap.h"

#include <fmt/format.h>

#include "sateen/core/direction.h"
#include "sateen/core/disc.h"
#include "sateen/core/error.h"
#include "sateen/core/picture_texture.h"
#include "sateen/io/image.h"
#include "sateen/matcap/matcap_picture.h"

namespace sateen::matcap {
namespace {

Image without_alpha(const Image& picture) {
  Image result = with_channels(picture, 3);
  if (picture.channels != 2 && picture.channels != 4) return result;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const float alpha = picture.at(x, y, picture.channels - 1);
      if (alpha > 0) result.set_rgb(x, y, picture.rgb(x, y) / alpha);
    }
  }
  return result;
}

}  // namespace

MatCap::MatCap(Image picture) : picture_(without_alpha(picture)) {
  if (picture_.empty() || picture_.width != picture_.height) {
    throw Error(fmt::format("a MatCap is a square picture of a sphere, this one is {} x {}", picture_.width,
                            picture_.height));
  }
  fill_from_rim(picture_);
  texture_ = std::make_shared<const TextureData>(picture_texture(picture_));
}

std::unique_ptr<MatCap> MatCap::read(const std::filesystem::path& path) {
  Image picture = io::read_image(path, {.most_across = kMostAcross});
  if (picture.width != picture.height) {
    throw Error(fmt::format("{}: a MatCap is a square picture of a sphere, this one is {} x {}",
                            path.string(), picture.width, picture.height));
  }
  return std::make_unique<MatCap>(std::move(picture));
}

Vec3 MatCap::lookup(const Vec2& disc) const {
  const Vec2 pixel = pixel_of_disc(disc, picture_.width);
  Vec3 colour;
  sample_bilinear(picture_, pixel.x(), pixel.y(), {colour.data(), 3});
  return colour;
}

Vec3 MatCap::evaluate(const appearance::Surface& surface) const {
  return surface.occlusion * lookup(surface.eye_normal.head<2>());
}

appearance::ShaderModule MatCap::shader() const {
  return {.texts = {{"matcap.glsl", ""}}, .defines = {}, .entry = "matcap", .point = ""};
}

appearance::ShaderValues MatCap::values() const {
  return {.uniforms = {}, .textures = {{"matcap_table", texture_}}};
}

}  // namespace sateen::matcap
