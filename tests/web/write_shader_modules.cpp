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
#include "sateen/gpu/shaders.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "sateen/matcap/decomposition.h"
#include "sateen/matcap/decomposition_file.h"
#include "sateen/matcap/sphere_disc.h"
#include "sateen/render/geometry_buffers.h"
#include "sateen/scene/registry.h"
#include "support/analytic_material.h"

namespace sateen {
namespace {

namespace fs = std::filesystem;

std::string text_of(const std::vector<std::string>& names, const std::string& defines) {
  std::string text = defines;
  for (const gpu::ShaderFile& file : gpu::with_needed(names)) text += fmt::format("{}\n", file.text);
  return text;
}

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
    case TextureData::Format::rg32f:
      return "rg32f";
  }
  throw Error("unknown texture format");
}

/// One set of the surface pipeline's switches (render/surface_pipeline.cpp).
struct Variant {
  std::string name;
  std::string tangent_angle = "TANGENT_ANGLE_VERTEX";
  std::string perspective = "PERSPECTIVE_ROTATION";
  bool maps = false;
};

class Writer {
 public:
  explicit Writer(fs::path folder) : folder_(std::move(folder)) {}

  void add(const std::string& name, const appearance::Appearance& appearance, const Variant& variant = {}) {
    const appearance::ShaderBinding shader = appearance.shader();
    const char* maps = variant.maps ? "true" : "false";
    const std::string defines = fmt::format(
        "#define APPEARANCE {}\n#define TANGENT_ANGLE {}\n#define TANGENT_SYMMETRY {}.0\n#define PERSPECTIVE "
        "{}\n"
        "#define RENORMALISE true\n#define OCCLUSION true\n#define NORMAL_MAP {}\n#define DIRECTION_MAP {}\n"
        "#define OCCLUSION_MAP {}\n#define WRITE_SURFACE false\n",
        shader.function, variant.tangent_angle, appearance.tangent_symmetry(), variant.perspective, maps,
        maps, maps);
    std::vector<std::string> files = shader.files;
    files.emplace_back("surface.frag");
    const std::string stem = fmt::format("{:03}", modules_.size());
    io::write_text(folder_ / (stem + ".vert"), text_of({"surface.vert"}, defines));
    io::write_text(folder_ / (stem + ".frag"), text_of(files, defines));
    nlohmann::json textures = nlohmann::json::array();
    for (const appearance::TextureBinding& binding : shader.textures) {
      textures.push_back({{"sampler", binding.sampler},
                          {"format", format_name(binding.texture->format)},
                          {"linear", true}});  // as gpu/texture.cpp filters all of them
    }
    const auto attributes = render::GeometryBuffers::attributes();
    modules_.push_back({{"name", name + (variant.name.empty() ? "" : ", " + variant.name)},
                        {"vertex", stem + ".vert"},
                        {"fragment", stem + ".frag"},
                        {"attributes", std::vector<std::string>(attributes.begin(), attributes.end())},
                        {"textures", textures}});
  }

  void finish() const { io::write_text(folder_ / "modules.json", modules_.dump(1)); }

 private:
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
  const Image environment(16, 8, 3, 0.5f);
  for (const fs::path& file : files_of(examples / "materials", ".json")) {
    writer.add(file.stem().string(), *scene::load_appearance(file));
    writer.add(file.stem().string() + " under an environment", *scene::load_appearance(file, environment));
  }
  for (const fs::path& file : files_of(examples / "matcaps", ".exr"))
    writer.add(file.stem().string(), *scene::load_appearance(file));

  amc::write_amc(folder / "silk.ktx2", test::analytic_table(16, 8, 2));
  const auto silk = scene::load_appearance(folder / "silk.ktx2");
  writer.add("AMC", *silk);
  writer.add("AMC", *silk, {.name = "naive angle", .tangent_angle = "TANGENT_ANGLE_NAIVE"});
  writer.add("AMC", *silk, {.name = "angle by fragment", .tangent_angle = "TANGENT_ANGLE_FRAGMENT"});
  writer.add("AMC", *silk, {.name = "equation 4", .perspective = "PERSPECTIVE_EQUATION4"});
  writer.add("AMC", *silk, {.name = "maps", .tangent_angle = "TANGENT_ANGLE_FRAGMENT", .maps = true});

  const Image ball = io::read_image(examples / "matcaps" / "lead.exr");
  const double half = ball.width / 2.0;
  matcap::DecomposeOptions options;
  options.map_size = 32;
  matcap::write_matcap(folder / "lead.ktx2",
                       matcap::decompose(ball, {half, half, half - 1}, options, "lead"));
  writer.add("decomposed MatCap", *scene::load_appearance(folder / "lead.ktx2"));
  // With textures it is looked up by its full formula.
  io::write_image(folder / "grey.png", Image(4, 4, 3, 0.5f));
  io::write_text(folder / "worn.json",
                 R"({"model": "matcap-decomposition", "matcap": "lead.ktx2", "low_color": "grey.png",
                     "high_color": "grey.png", "roughness": "grey.png", "roughness_scale": 0.05})");
  writer.add("decomposed MatCap, textured", *scene::load_appearance(folder / "worn.json"));
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
