// SPDX-License-Identifier: MIT
#include "sateen/amc/appearance.h"

#include "sateen/amc/lookup.h"

namespace sateen::amc {

AmcAppearance::AmcAppearance(AmcTable table) : table_(std::move(table)) {
  auto texture = std::make_shared<TextureData>();
  texture->shape = TextureData::Shape::volume_3d;
  texture->format =
      table_.encoding == AmcEncoding::srgb8 ? TextureData::Format::srgba8 : TextureData::Format::rgba16f;
  texture->width = texture->height = table_.size;
  texture->depth = table_.slices;
  texture->wrap_w = TextureData::Wrap::repeat;
  texture->levels = {encoded_texels(table_)};
  texture_ = std::move(texture);
}

Vec3 AmcAppearance::evaluate(const appearance::Surface& surface) const {
  return surface.occlusion * lookup(table_, surface.eye_normal, surface.tangent_angle);
}

appearance::ShaderModule AmcAppearance::shader() const {
  return {.texts = {{"amc.glsl", ""}}, .defines = {}, .entry = "amc", .point = ""};
}

appearance::ShaderValues AmcAppearance::values() const {
  return {.uniforms = {{"amc_symmetry", static_cast<float>(table_.symmetry)},
                       {"amc_half_slice", 0.5f / static_cast<float>(table_.slices)}},
          .textures = {{"amc_table", texture_}}};
}

}  // namespace sateen::amc
