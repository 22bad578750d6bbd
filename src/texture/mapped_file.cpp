// SPDX-License-Identifier: MIT
#include <array>

#include <fmt/format.h>

#include "sateen/appearance/json_reader.h"
#include "sateen/brdf/conventions.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/json.h"
#include "sateen/texture/lobe_files.h"
#include "sateen/texture/mapped_appearance.h"

namespace sateen::texture {
namespace {

namespace fs = std::filesystem;

/// Pictures, filtered here.
LobeMips filtered(appearance::JsonObject& json, const fs::path& normals, const fs::path& anisotropy,
                  const fs::path& folder) {
  static const std::array<std::string, 4> methods = {"sggx-variance", "sggx", "lean", "naive"};
  static const std::array<std::string, 2> kernels = {"box", "kaiser"};
  static const std::array<std::string, 2> encodings = {"root", "correlation"};
  LobeMapFiles files;
  files.normals = normals;
  files.anisotropy = anisotropy;
  files.encoding = anisotropy_encoding_from_name(json.choice("encoding", "root", encodings));
  files.normal_format.green_down = json.flag("green_down", false);
  if (json.has("roughness_map")) files.roughness = folder / json.text("roughness_map", "");
  const Vec2 roughness = json.pair("roughness", {0.5, 0.5}, {0, 1});
  files.constant = brdf::from_uv({roughness.x(), roughness.y(), 0});
  ChainOptions options;
  options.filter.method = filter_method_from_name(json.choice("method", "sggx-variance", methods));
  options.filter.encoding = files.encoding;
  options.kernel = mip_kernel_from_name(json.choice("kernel", "box", kernels));
  LobeFileSource source(files);
  return make_lobe_mips(source, options, files.encoding);
}

}  // namespace

std::unique_ptr<MappedAppearance> MappedAppearance::parse(const std::string& text, const fs::path& path) {
  const nlohmann::json value = io::parse_json(text, path.string());
  appearance::JsonObject json(value, path.string());
  json.text("model", "mapped");
  json.text("name", "");
  for (const char* key : {"specular", "fuzz", "simple_fuzziness"}) {
    if (json.has(key)) {
      throw Error(fmt::format("{}: \"{}\" does not go with maps; they hold the reflection (\"f0\")",
                              path.string(), key));
    }
  }

  const fs::path folder = path.parent_path();
  const auto file = [&](const char* key) { return json.has(key) ? folder / json.text(key, "") : fs::path(); };
  const fs::path normals = file("normals");
  const fs::path anisotropy = file("anisotropy");
  const bool stored = io::extension_of(normals) == ".ktx2";
  if (stored != (io::extension_of(anisotropy) == ".ktx2")) {
    throw Error(
        fmt::format("{}: \"normals\" and \"anisotropy\" are both .ktx2 or both pictures", path.string()));
  }
  LobeMips mips = stored ? read_lobe_mips(normals, anisotropy) : filtered(json, normals, anisotropy, folder);
  MappedMaterial material;
  if (json.has("base")) {
    appearance::JsonObject base(json.raw("base"), fmt::format("{}, base", path.string()));
    for (const auto& field : brdf::diffuse_base_parameters())
      field.set(material.base, base.read(field.parameter));
    base.finish();
  }
  for (const auto& field : mapped_parameters()) {
    const std::string& name = field.parameter.name;
    if (name == "f0" || name == "lobe_samples") field.set(material, json.read(field.parameter));
  }
  material.repeat = json.pair("repeat", {1, 1}, {1e-3, 1e4});
  json.allow({"normals", "anisotropy", "base", "lights", "environment", "ambient"});
  json.finish();
  return std::make_unique<MappedAppearance>(std::move(mips), std::move(material));
}

}  // namespace sateen::texture
