// SPDX-License-Identifier: MIT
#include "sateen/scene/constant.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sateen/core/error.h"
#include "sateen/io/file.h"

namespace sateen::scene {

std::unique_ptr<Constant> Constant::read(const std::filesystem::path& path) {
  const auto json = nlohmann::json::parse(io::read_text(path), nullptr, false);
  const auto colour = json.is_object() ? json.find("colour") : json.end();
  const auto is_number = [](const nlohmann::json& value) { return value.is_number(); };
  if (colour == json.end() || !colour->is_array() || colour->size() != 3 ||
      !std::all_of(colour->begin(), colour->end(), is_number)) {
    throw Error(fmt::format("{}: a constant material needs \"colour\": [r, g, b], three linear numbers",
                            path.string()));
  }
  return std::make_unique<Constant>(Vec3((*colour)[0], (*colour)[1], (*colour)[2]));
}

appearance::ShaderBinding Constant::shader() const {
  return {.files = {"constant.glsl"},
          .function = "constant_appearance",
          .uniforms = {{"constant_colour", Vec3f(colour_.cast<float>())}},
          .textures = {}};
}

}  // namespace sateen::scene
