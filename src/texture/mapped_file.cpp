// SPDX-License-Identifier: MIT
#include <array>

#include <fmt/format.h>

#include "sateen/appearance/json_reader.h"
#include "sateen/brdf/conventions.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
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

std::unique_ptr<appearance::Appearance> MappedAppearance::read(const fs::path& path) {
  static const std::array<const char*, 13> kOwn = {
      "model",  "name",   "normals", "anisotropy", "roughness_map", "roughness", "encoding", "green_down",
      "method", "kernel", "repeat",  "f0",         "lobe_samples"};
  const nlohmann::json value = appearance::read_json(path);
  if (!value.is_object()) throw Error(fmt::format("{}: is no JSON object", path.string()));
  nlohmann::json own = nlohmann::json::object();
  nlohmann::json base = value;
  for (const char* key : kOwn) {
    if (!value.contains(key)) continue;
    own[key] = value[key];
    base.erase(key);
  }
  appearance::JsonObject json(own, path.string());
  json.text("model", "mapped");
  json.text("name", "");
  for (const char* key : {"specular", "fuzz", "simple_fuzziness"}) {
    if (base.contains(key)) {
      throw Error(fmt::format("{}: \"{}\" does not go with maps; they hold the reflection (\"f0\")",
                              path.string(), key));
    }
  }

  Maps maps;
  const fs::path folder = path.parent_path();
  const auto file = [&](const char* key) { return json.has(key) ? folder / json.text(key, "") : fs::path(); };
  const fs::path normals = file("normals");
  const fs::path anisotropy = file("anisotropy");
  const bool stored = io::extension_of(normals) == ".ktx2";
  if (stored != (io::extension_of(anisotropy) == ".ktx2")) {
    throw Error(
        fmt::format("{}: \"normals\" and \"anisotropy\" are both .ktx2 or both pictures", path.string()));
  }
  maps.mips = stored ? read_lobe_mips(normals, anisotropy) : filtered(json, normals, anisotropy, folder);
  maps.repeat = json.pair("repeat", {1, 1}, {1e-3, 1e4});
  maps.f0 = json.colour("f0", maps.f0);
  maps.lobe_samples = static_cast<int>(json.number("lobe_samples", maps.lobe_samples, {1, 64}));
  json.finish();
  return std::make_unique<MappedAppearance>(std::move(maps),
                                            brdf::LayeredAppearance::parse(base.dump(), path));
}

}  // namespace sateen::texture
