// SPDX-License-Identifier: MIT
// Writes what the renderer compiles for every example, for shaders.test.mjs: write_shader_modules FOLDER
// EXAMPLES. FOLDER/modules.json lists the programs: name, the files of the two stages' texts (without
// #version and precisions, which differ between dialects), attributes, and the textures they read.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sateen/amc/amc_file.h"
#include "sateen/core/error.h"
#include "sateen/core/picture_texture.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "sateen/matcap/decomposition.h"
#include "sateen/matcap/decomposition_file.h"
#include "sateen/matcap/sphere_disc.h"
#include "sateen/render/surface_program.h"
#include "sateen/scene/registry.h"
#include "support/analytic_material.h"

namespace sateen {
namespace {

namespace fs = std::filesystem;

std::string format_name(TextureData::Format format) {
  switch (format) {
    case TextureData::Format::rgba8:
      return "rgba8";
    case TextureData::Format::srgba8:
      return "srgba8";
    case TextureData::Format::rgba16f:
      return "rgba16f";
    case TextureData::Format::rgba32f:
      return "rgba32f";
    case TextureData::Format::rg16f:
      return "rg16f";
  }
  throw Error("unknown texture format");
}

/// One set of the surface pass' switches and maps.
struct Variant {
  std::string name = {};
  scene::RenderSwitches switches = {};
  bool maps = false;
};

class Writer {
 public:
  explicit Writer(fs::path folder) : folder_(std::move(folder)) {}

  void add(const std::string& name, std::shared_ptr<appearance::Appearance> appearance,
           const Variant& variant = {}) {
    scene::Material material{.appearance = std::move(appearance)};
    if (variant.maps) {
      const auto picture = std::make_shared<const TextureData>(picture_texture(Image(1, 1, 3, 0.5f)));
      material.normal_map.texture = material.direction_map.texture = material.occlusion_map.texture = picture;
    }
    using Output = render::SurfaceProgram::Output;
    const std::string whole = name + (variant.name.empty() ? "" : ", " + variant.name);
    write(whole, material, variant.switches, Output::color);
    write(whole + ", surface", material, variant.switches, Output::surface);
  }

  void finish() const { io::write_text(folder_ / "modules.json", modules_.dump(1)); }

 private:
  void write(const std::string& name, const scene::Material& material, const scene::RenderSwitches& switches,
             render::SurfaceProgram::Output output) {
    using Stage = gpu::ProgramText::Stage;
    const render::SurfaceProgram program(material, switches, output);
    const std::string stem = fmt::format("{:03}", modules_.size());
    io::write_text(folder_ / (stem + ".vert"), program.text.stage(Stage::vertex, ""));
    io::write_text(folder_ / (stem + ".frag"), program.text.stage(Stage::fragment, ""));
    nlohmann::json textures = nlohmann::json::array();
    for (const appearance::TextureBinding& binding : material.appearance->values().textures) {
      textures.push_back({{"sampler", binding.sampler},
                          {"format", format_name(binding.texture->format)},
                          {"linear", true}});  // as gpu/texture.cpp filters all of them
    }
    modules_.push_back({{"name", name},
                        {"vertex", stem + ".vert"},
                        {"fragment", stem + ".frag"},
                        {"attributes", render::vertex_attributes()},
                        {"textures", textures}});
  }

  fs::path folder_;
  nlohmann::json modules_ = nlohmann::json::array();
};

std::vector<fs::path> files_of(const fs::path& folder, const std::string& extension) {
  std::vector<fs::path> result;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == extension) result.push_back(entry.path());
  }
  std::sort(result.begin(), result.end());
  return result;
}

void write_all(const fs::path& folder, const fs::path& examples) {
  Writer writer(folder);
  for (const fs::path& file : files_of(examples / "materials", ".json"))
    writer.add(file.stem().string(), scene::load_appearance(file));
  for (const fs::path& file : files_of(examples / "matcaps", ".exr"))
    writer.add(file.stem().string(), scene::load_appearance(file));

  amc::write_amc(folder / "silk.ktx2", test::analytic_table(16, 8, 2));
  const auto silk = scene::load_appearance(folder / "silk.ktx2");
  writer.add("AMC", silk);
  writer.add("AMC", silk, {.name = "naive angle", .switches = {.tangent_angle = scene::TangentAngle::naive}});
  writer.add("AMC", silk,
             {.name = "angle by fragment", .switches = {.tangent_angle = scene::TangentAngle::fragment}});
  writer.add("AMC", silk, {.name = "equation 4", .switches = {.perspective = scene::Perspective::equation4}});
  writer.add("AMC", silk, {.name = "maps", .maps = true});

  const Image ball = io::read_image(examples / "matcaps" / "lead.exr");
  const double half = ball.width / 2.0;
  matcap::DecomposeOptions options;
  options.map_size = 32;
  matcap::write_matcap(folder / "lead.ktx2",
                       matcap::decompose(ball, {half, half, half - 1}, options, "lead"));
  const auto lead = scene::load_appearance(folder / "lead.ktx2");
  writer.add("decomposed MatCap, being edited", lead);
  lead->settle(true);
  writer.add("decomposed MatCap", lead);
  // With textures it is looked up by its full formula.
  io::write_image(folder / "grey.png", Image(4, 4, 3, 0.5f));
  io::write_text(folder / "worn.json",
                 R"({"model": "matcap-decomposition", "matcap": "lead.ktx2", "low_color": "grey.png",
                     "high_color": "grey.png", "roughness": "grey.png", "roughness_scale": 0.05})");
  writer.add("decomposed MatCap, textured", scene::load_appearance(folder / "worn.json"));
  writer.finish();
}

}  // namespace
}  // namespace sateen

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    sateen::write_all(argv[1], argv[2]);
  } catch (const sateen::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
