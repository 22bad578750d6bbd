// SPDX-License-Identifier: MIT
#include "sateen/scene/constant.h"

#include <array>

#include "sateen/appearance/json_reader.h"
#include "sateen/io/json.h"

namespace sateen::scene {
namespace {

using appearance::Parameter;
using appearance::ParameterValue;

constexpr double kBrightest = 1e6;

std::span<const appearance::ParameterField<Vec3>> fields() {
  static const std::array<appearance::ParameterField<Vec3>, 1> all{{
      {{.name = "color",
        .kind = Parameter::Kind::color,
        .high = kBrightest,
        .standard = Vec3(0.5, 0.5, 0.5),
        .help = "radiance towards every side, linear"},
       [](const Vec3& color) { return color; },
       [](Vec3& color, const ParameterValue& v) { color = std::get<Vec3>(v); }},
  }};
  return all;
}

}  // namespace

std::unique_ptr<Constant> Constant::parse(const std::string& text, const std::filesystem::path& path) {
  const nlohmann::json value = io::parse_json(text, path.string());
  appearance::JsonObject json(value, path.string());
  json.text("model", "constant");
  json.text("name", "");
  if (!json.has("color")) json.fail("color", "[r, g, b], three linear numbers");
  Vec3 color;
  for (const auto& field : fields()) field.set(color, json.read(field.parameter));
  json.finish();
  return std::make_unique<Constant>(color);
}

appearance::ShaderModule Constant::shader() const {
  return {.texts = {{"constant.glsl", ""}}, .defines = {}, .entry = "constant_appearance", .point = ""};
}

appearance::ShaderValues Constant::values() const {
  return {.uniforms = {{"constant_color", Vec3f(color_.cast<float>())}}, .textures = {}};
}

std::vector<Parameter> Constant::parameters() const {
  return appearance::descriptions(fields());
}

ParameterValue Constant::get(const std::string& name) const {
  return appearance::field_named(fields(), name).get(color_);
}

void Constant::set(const std::string& name, const ParameterValue& value) {
  const auto& field = appearance::field_named(fields(), name);
  appearance::check(field.parameter, value);
  field.set(color_, value);
  changed();
}

}  // namespace sateen::scene
