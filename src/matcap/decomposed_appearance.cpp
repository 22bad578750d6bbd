// SPDX-License-Identifier: MIT
#include "sateen/matcap/decomposed_appearance.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sateen/core/error.h"
#include "sateen/core/parallel.h"
#include "sateen/core/picture_texture.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "sateen/matcap/decomposition_file.h"
#include "sateen/matcap/edits.h"
#include "sateen/matcap/half_texels.h"
#include "sateen/matcap/sphere_map.h"

namespace sateen::matcap {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kMostLevels = 12;  // DECOMPOSED_LEVELS of the shader
constexpr int kMostNormals = 2048;       // texels across the table of normals, 33 MB

double first_channel(const Image& image, const Vec2& uv) {
  double value = 0;
  sample_repeating(image, uv, {&value, 1});
  return value;
}

Vec3 colour_at(const Image& image, const Vec2& uv) {
  if (image.channels < 3) return Vec3::Constant(first_channel(image, uv));
  Vec3 colour;
  sample_repeating(image, uv, {colour.data(), 3});
  return colour;
}

/// Normals that look away, as interpolation makes them, are taken to the rim.
Vec3 facing(const Vec3& n) {
  return n.z() >= 0 ? n : Vec3(n.x(), n.y(), 0).normalized();
}

Vec4f silhouette_uniform(const PartLook& look) {
  if (!look.silhouette) return {0, 0, 0, 0};
  const Silhouette& s = *look.silhouette;
  return Vec4(s.theta0, s.m1, s.alpha1 - look.base_color.mean(), 1).cast<float>();
}

appearance::TextureBinding modulation_texture(const char* sampler, const Image& image, float standard) {
  const Image& shown = image.empty() ? Image(1, 1, 3, standard) : image;
  return {sampler, std::make_shared<const TextureData>(picture_texture(shown, TextureData::Wrap::repeat))};
}

std::shared_ptr<const TextureData> maps_texture(const MatcapDecomposition& matcap) {
  auto texture = std::make_shared<TextureData>();
  texture->shape = TextureData::Shape::array_2d;
  texture->format = TextureData::Format::rgba16f;
  texture->width = texture->height = matcap[Part::low].map.levels.front().size();
  texture->depth = 4;
  texture->levels = half_levels(matcap);
  return texture;
}

/// evaluate() over the eye-frame normals, the front half of a dual paraboloid map. The warp spreads a sphere
/// map over half the angle: at twice its size this has its density, at four times it keeps edges one texel
/// wide.
std::shared_ptr<const TextureData> normals_texture(const EditedMatcap& matcap) {
  const int size = std::min(4 * matcap.matcap[Part::high].map.levels.front().size(), kMostNormals);
  Image table(size, size, 3);
  parallel_for(size, [&](int y) {
    for (int x = 0; x < size; ++x) {
      const Vec3 n = direction_of_texel(x, y, size, false);
      // Filtering at the horizon reads one texel of the normals that look away.
      if (n.z() < -4.0 / size) continue;
      table.set_rgb(x, y, evaluate(matcap, facing(n)).cast<float>());
    }
  });
  return std::make_shared<const TextureData>(picture_texture(table));
}

}  // namespace

DecomposedAppearance::DecomposedAppearance(EditedMatcap matcap, ModulationMaps maps)
    : matcap_(std::move(matcap)), maps_(std::move(maps)) {
  const std::size_t low = matcap_.matcap[Part::low].map.levels.size();
  const std::size_t high = matcap_.matcap[Part::high].map.levels.size();
  const int low_size = matcap_.matcap[Part::low].map.levels.front().size();
  const int high_size = matcap_.matcap[Part::high].map.levels.front().size();
  if (low != high || low_size != high_size) {
    throw Error(fmt::format("the maps of low and high part have different sizes, {} and {} texels", low_size,
                            high_size));
  }
}

std::unique_ptr<appearance::Appearance> DecomposedAppearance::read(const fs::path& path) {
  return std::make_unique<DecomposedAppearance>(unedited(read_matcap(path)));
}

std::unique_ptr<appearance::Appearance> DecomposedAppearance::read_material(const fs::path& path) {
  const json material = json::parse(io::read_text(path), nullptr, false);
  if (!material.is_object() || !material.contains("matcap") || !material["matcap"].is_string()) {
    throw Error(
        fmt::format("{}: \"matcap\" is needed, the name of a decomposed MatCap (.ktx2)", path.string()));
  }
  static const std::set<std::string> known{"model",      "matcap",    "edits",           "low_color",
                                           "high_color", "roughness", "roughness_scale", "occlusion"};
  for (const auto& [key, value] : material.items()) {
    if (!known.contains(key)) throw Error(fmt::format("{}: the key \"{}\" is unknown", path.string(), key));
  }
  const fs::path folder = path.parent_path();
  MatcapDecomposition matcap = read_matcap(folder / material["matcap"].get<std::string>());
  const AddUpSpace space = matcap.space;
  const auto edits = material.contains("edits") ? parse_edits(material["edits"].dump(), folder, path.string())
                                                : std::vector<Edit>{};
  const auto picture = [&](const char* key) -> fs::path {
    if (!material.contains(key)) return {};
    if (!material[key].is_string())
      throw Error(fmt::format("{}: \"{}\" must name a picture", path.string(), key));
    return folder / material[key].get<std::string>();
  };
  ModulationMaps maps;
  if (const fs::path file = picture("low_color"); !file.empty())
    maps.low_color = to_add_up_space(io::read_image(file), space);
  if (const fs::path file = picture("high_color"); !file.empty())
    maps.high_color = to_add_up_space(io::read_image(file), space);
  if (const fs::path file = picture("roughness"); !file.empty()) maps.roughness = io::read_data(file);
  if (const fs::path file = picture("occlusion"); !file.empty()) maps.occlusion = io::read_data(file);
  if (material.contains("roughness_scale")) {
    const json& scale = material["roughness_scale"];
    if (!scale.is_number() || !(scale.get<double>() >= 0 && scale.get<double>() <= kFlattest)) {
      throw Error(fmt::format("{}: \"roughness_scale\" must be a variance in radians^2, from 0 to {}",
                              path.string(), kFlattest));
    }
    maps.roughness_scale = scale;
  }
  return std::make_unique<DecomposedAppearance>(apply_edits(std::move(matcap), edits), std::move(maps));
}

Vec3 DecomposedAppearance::evaluate(const appearance::Surface& surface) const {
  Modulation modulation;
  modulation.occlusion = surface.occlusion;
  if (!maps_.low_color.empty()) modulation.low_color = colour_at(maps_.low_color, surface.uv);
  if (!maps_.high_color.empty()) modulation.high_color = colour_at(maps_.high_color, surface.uv);
  if (!maps_.roughness.empty()) {
    modulation.added_variance = maps_.roughness_scale * first_channel(maps_.roughness, surface.uv);
  }
  if (!maps_.occlusion.empty()) modulation.occlusion *= first_channel(maps_.occlusion, surface.uv);
  return matcap::evaluate(matcap_, facing(surface.eye_normal), modulation);
}

appearance::ShaderBinding DecomposedAppearance::shader() const {
  if (!maps_.any()) {
    return {.files = {"matcap_by_normal.glsl"},
            .function = "matcap_by_normal",
            .uniforms = {},
            .textures = {{"matcap_normals", normals_texture(matcap_)}}};
  }
  const MatcapDecomposition& matcap = matcap_.matcap;
  const PartLook& low = matcap_.look(Part::low);
  const PartLook& high = matcap_.look(Part::high);
  const std::vector<double>& levels = matcap[Part::high].map.variances;
  std::vector<Vec4f> variances(kMostLevels, Vec4f::Zero());
  const std::size_t count = std::min(levels.size(), kMostLevels);
  for (std::size_t i = 0; i < count; ++i) variances[i].x() = static_cast<float>(levels[i]);
  variances[0].y() = static_cast<float>(count);
  return {.files = {"matcap_decomposition.glsl"},
          .function = "matcap_decomposition",
          .uniforms = {{"decomposed_variances", variances},
                       {"decomposed_light_back", Eigen::Matrix3f(matcap_.light.transpose().cast<float>())},
                       {"decomposed_low_slope", static_cast<float>(matcap[Part::low].slope())},
                       {"decomposed_high_variance", static_cast<float>(matcap[Part::high].variance)},
                       {"decomposed_low_color", Vec3f((low.intensity * low.base_color).cast<float>())},
                       {"decomposed_high_color", Vec3f((high.intensity * high.base_color).cast<float>())},
                       {"decomposed_low_silhouette", silhouette_uniform(low)},
                       {"decomposed_high_silhouette", silhouette_uniform(high)},
                       {"decomposed_display", matcap.space == AddUpSpace::display ? 1 : 0},
                       {"decomposed_roughness_scale", static_cast<float>(maps_.roughness_scale)}},
          .textures = {{"decomposed_maps", maps_texture(matcap)},
                       modulation_texture("decomposed_low_texture", maps_.low_color, 1),
                       modulation_texture("decomposed_high_texture", maps_.high_color, 1),
                       modulation_texture("decomposed_roughness_texture", maps_.roughness, 0),
                       modulation_texture("decomposed_occlusion_texture", maps_.occlusion, 1)}};
}

}  // namespace sateen::matcap
