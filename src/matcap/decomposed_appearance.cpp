// SPDX-License-Identifier: MIT
#include "sateen/matcap/decomposed_appearance.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sateen/appearance/json_reader.h"
#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/core/parallel.h"
#include "sateen/core/picture_texture.h"
#include "sateen/io/image.h"
#include "sateen/io/json.h"
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

std::shared_ptr<const TextureData> modulation_texture(const Image& image, float standard) {
  const Image& shown = image.empty() ? Image(1, 1, 3, standard) : image;
  return std::make_shared<const TextureData>(picture_texture(shown, TextureData::Wrap::repeat));
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
std::shared_ptr<const TextureData> normals_texture(const EditedMatcap& matcap, const Modulation& modulation) {
  const int size = std::min(4 * matcap.matcap[Part::high].map.levels.front().size(), kMostNormals);
  Image table(size, size, 3);
  parallel_for(size, [&](int y) {
    for (int x = 0; x < size; ++x) {
      const Vec3 n = direction_of_texel(x, y, size, false);
      // Filtering at the horizon reads one texel of the normals that look away.
      if (n.z() < -4.0 / size) continue;
      table.set_rgb(x, y, evaluate(matcap, facing(n), modulation).cast<float>());
    }
  });
  return std::make_shared<const TextureData>(picture_texture(table));
}

using appearance::Parameter;
using appearance::ParameterValue;
using Live = DecomposedAppearance::Live;

constexpr double kMostAddedVariance = 0.5;  // radians^2: flatter than any MatCap's highlight

std::vector<appearance::ParameterField<Live>> make_fields() {
  std::vector<appearance::ParameterField<Live>> fields;
  static constexpr std::array kAxes{"turn_x", "turn_y", "turn_z"};
  for (int axis = 0; axis < 3; ++axis) {
    fields.push_back(
        {{.name = kAxes[static_cast<std::size_t>(axis)],
          .unit = "degrees",
          .low = -180,
          .high = 180,
          .help = "turns the light, about x, then y, then z, after the edits"},
         [axis](const Live& m) { return degrees(m.turn[axis]); },
         [axis](Live& m, const ParameterValue& v) { m.turn[axis] = radians(std::get<double>(v)); }});
  }
  for (const Part part : kParts) {
    const std::string prefix = name_of(part) + std::string(".");
    fields.push_back(
        {{.name = prefix + "color",
          .kind = Parameter::Kind::color,
          .high = 100,
          .standard = Vec3(1, 1, 1),
          .help = "base colour of the part, in the space the parts add up in"},
         [part](const Live& m) { return m.matcap.look(part).base_color; },
         [part](Live& m, const ParameterValue& v) { m.matcap.look(part).base_color = std::get<Vec3>(v); }});
    fields.push_back(
        {{.name = prefix + "intensity", .high = 100, .standard = 1.0, .help = "factor on the part"},
         [part](const Live& m) { return m.matcap.look(part).intensity; },
         [part](Live& m, const ParameterValue& v) { m.matcap.look(part).intensity = std::get<double>(v); }});
  }
  fields.push_back({{.name = "high.roughness",
                     .unit = "radians^2",
                     .high = kMostAddedVariance,
                     .help = "variance added to the high part's filter"},
                    [](const Live& m) { return m.added_variance; },
                    [](Live& m, const ParameterValue& v) { m.added_variance = std::get<double>(v); }});
  return fields;
}

std::span<const appearance::ParameterField<Live>> live_fields() {
  static const auto fields = make_fields();
  return fields;
}

}  // namespace

DecomposedAppearance::DecomposedAppearance(EditedMatcap matcap, ModulationMaps maps)
    : live_{.matcap = std::move(matcap)}, maps_(std::move(maps)) {
  const MatcapDecomposition& parts = live_.matcap.matcap;
  const std::size_t low = parts[Part::low].map.levels.size();
  const std::size_t high = parts[Part::high].map.levels.size();
  const int low_size = parts[Part::low].map.levels.front().size();
  const int high_size = parts[Part::high].map.levels.front().size();
  if (low != high || low_size != high_size) {
    throw Error(fmt::format("the maps of low and high part have different sizes, {} and {} texels", low_size,
                            high_size));
  }
  sphere_maps_ = maps_texture(parts);
  modulation_ = {modulation_texture(maps_.low_color, 1), modulation_texture(maps_.high_color, 1),
                 modulation_texture(maps_.roughness, 0), modulation_texture(maps_.occlusion, 1)};
}

std::unique_ptr<DecomposedAppearance> DecomposedAppearance::read(const fs::path& path) {
  return std::make_unique<DecomposedAppearance>(unedited(read_matcap(path)));
}

std::unique_ptr<DecomposedAppearance> DecomposedAppearance::parse(const std::string& text,
                                                                  const fs::path& path) {
  const json value = io::parse_json(text, path.string());
  appearance::JsonObject material(value, path.string());
  material.text("model", "matcap-decomposition");
  material.text("name", "");
  if (!material.has("matcap")) material.fail("matcap", "the name of a decomposed MatCap (.ktx2)");
  const fs::path folder = path.parent_path();
  MatcapDecomposition matcap = read_matcap(folder / material.text("matcap", ""));
  const AddUpSpace space = matcap.space;
  const auto edits = material.has("edits")
                         ? parse_edits(io::json_text(material.raw("edits")), folder, path.string())
                         : std::vector<Edit>{};
  const auto picture = [&](const char* key) {
    const std::string name = material.text(key, "");
    return name.empty() ? fs::path() : folder / name;
  };
  ModulationMaps maps;
  if (const fs::path file = picture("low_color"); !file.empty())
    maps.low_color = to_add_up_space(io::read_image(file), space);
  if (const fs::path file = picture("high_color"); !file.empty())
    maps.high_color = to_add_up_space(io::read_image(file), space);
  if (const fs::path file = picture("roughness"); !file.empty()) maps.roughness = io::read_data(file);
  if (const fs::path file = picture("occlusion"); !file.empty()) maps.occlusion = io::read_data(file);
  maps.roughness_scale = material.number("roughness_scale", maps.roughness_scale, {0, kFlattest});
  material.allow({"edits"});
  material.finish();
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
  modulation.added_variance += live_.added_variance;
  return matcap::evaluate(live_.matcap, rotation_xyz(live_.turn) * live_.matcap.light,
                          facing(surface.eye_normal), modulation);
}

appearance::ShaderModule DecomposedAppearance::shader() const {
  const char* name = normals_ ? "matcap_by_normal" : "matcap_decomposition";
  return {.texts = {{std::string(name) + ".glsl", ""}}, .defines = {}, .entry = name, .point = ""};
}

appearance::ShaderValues DecomposedAppearance::values() const {
  if (normals_) return {.uniforms = {}, .textures = {{"matcap_normals", normals_}}};
  const MatcapDecomposition& matcap = live_.matcap.matcap;
  const PartLook& low = live_.matcap.look(Part::low);
  const PartLook& high = live_.matcap.look(Part::high);
  const Mat3 light = rotation_xyz(live_.turn) * live_.matcap.light;
  const std::vector<double>& levels = matcap[Part::high].map.variances;
  std::vector<Vec4f> variances(kMostLevels, Vec4f::Zero());
  const std::size_t count = std::min(levels.size(), kMostLevels);
  for (std::size_t i = 0; i < count; ++i) variances[i].x() = static_cast<float>(levels[i]);
  variances[0].y() = static_cast<float>(count);
  return {.uniforms = {{"decomposed_variances", variances},
                       {"decomposed_light_back", Eigen::Matrix3f(light.transpose().cast<float>())},
                       {"decomposed_low_slope", static_cast<float>(matcap[Part::low].slope())},
                       {"decomposed_high_variance", static_cast<float>(matcap[Part::high].variance)},
                       {"decomposed_low_color", Vec3f((low.intensity * low.base_color).cast<float>())},
                       {"decomposed_high_color", Vec3f((high.intensity * high.base_color).cast<float>())},
                       {"decomposed_low_silhouette", silhouette_uniform(low)},
                       {"decomposed_high_silhouette", silhouette_uniform(high)},
                       {"decomposed_display", matcap.space == AddUpSpace::display ? 1 : 0},
                       {"decomposed_added_variance", static_cast<float>(live_.added_variance)},
                       {"decomposed_roughness_scale", static_cast<float>(maps_.roughness_scale)}},
          .textures = {{"decomposed_maps", sphere_maps_},
                       {"decomposed_low_texture", modulation_[0]},
                       {"decomposed_high_texture", modulation_[1]},
                       {"decomposed_roughness_texture", modulation_[2]},
                       {"decomposed_occlusion_texture", modulation_[3]}}};
}

std::vector<Parameter> DecomposedAppearance::parameters() const {
  return appearance::descriptions(live_fields());
}

ParameterValue DecomposedAppearance::get(const std::string& name) const {
  return appearance::field_named(live_fields(), name).get(live_);
}

void DecomposedAppearance::set(const std::string& name, const ParameterValue& value) {
  const auto& field = appearance::field_named(live_fields(), name);
  appearance::check(field.parameter, value);
  field.set(live_, value);
  normals_ = nullptr;
  quiet_ = false;
  changed();
}

void DecomposedAppearance::settle(bool wait) {
  if (maps_.any() || normals_) return;
  const bool was_quiet = std::exchange(quiet_, true);
  if (!wait && !was_quiet) return;
  if (!baking_.valid()) {
    baking_revision_ = revision();
    baking_ = std::async(wait ? std::launch::deferred : std::launch::async, [live = live_] {
      EditedMatcap matcap = live.matcap;
      matcap.light = rotation_xyz(live.turn) * matcap.light;
      Modulation modulation;
      modulation.added_variance = live.added_variance;
      return normals_texture(matcap, modulation);
    });
  }
  if (!wait && baking_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  auto baked = baking_.get();
  if (baking_revision_ != revision()) return settle(wait);  // changed meanwhile: once more
  normals_ = std::move(baked);
  changed();
}

}  // namespace sateen::matcap
