// SPDX-License-Identifier: MIT
#include "sateen/scene/registry.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "sateen/amc/amc_file.h"
#include "sateen/amc/appearance.h"
#include "sateen/brdf/layered/layered.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "sateen/io/ktx2.h"
#include "sateen/matcap/decomposed_appearance.h"
#include "sateen/matcap/matcap.h"
#include "sateen/scene/constant.h"
#include "sateen/texture/mapped_appearance.h"

namespace sateen::scene {
namespace {

namespace fs = std::filesystem;
using Loader = std::function<std::unique_ptr<appearance::Appearance>(const fs::path&)>;
using Loaders = std::map<std::string, Loader>;

std::unique_ptr<appearance::Appearance> load_amc(const fs::path& path) {
  return std::make_unique<amc::AmcAppearance>(amc::read_amc(path));
}

/// Values of "sateen.kind" in .ktx2 files.
const Loaders& ktx2_kinds() {
  static const Loaders loaders{
      {"amc", load_amc},
      {"matcap-decomposition", matcap::DecomposedAppearance::read},
  };
  return loaders;
}

/// Values of "model" in .json materials.
const Loaders& models() {
  static const Loaders loaders{
      {"constant", Constant::read},
      {"layered", brdf::LayeredAppearance::read},
      {"mapped", texture::MappedAppearance::read},
      {"matcap-decomposition", matcap::DecomposedAppearance::read_material},
  };
  return loaders;
}

std::unique_ptr<appearance::Appearance> load(const Loaders& loaders, const std::string& key,
                                             const std::string& kind, const fs::path& path) {
  if (const auto found = loaders.find(kind); found != loaders.end()) return found->second(path);
  std::vector<std::string> known;
  for (const auto& [name, loader] : loaders) known.push_back(name);
  throw Error(fmt::format("{}: {} \"{}\" is not known; known are {}", path.string(), key, kind,
                          fmt::join(known, ", ")));
}

std::unique_ptr<appearance::Appearance> load_ktx2(const fs::path& path) {
  const auto metadata = io::read_ktx2_info(path).metadata;
  const auto kind = metadata.find("sateen.kind");
  if (kind == metadata.end()) {
    throw Error(fmt::format("{}: is a texture but none that Sateen made; \"sateen amc build\" makes one",
                            path.string()));
  }
  return load(ktx2_kinds(), "sateen.kind", kind->second, path);
}

std::unique_ptr<appearance::Appearance> load_json(const fs::path& path) {
  const auto json = nlohmann::json::parse(io::read_text(path), nullptr, false);
  if (!json.is_object() || !json.contains("model") || !json["model"].is_string()) {
    throw Error(fmt::format("{}: is no material; a JSON object with \"model\" is needed", path.string()));
  }
  return load(models(), "model", json["model"], path);
}

}  // namespace

std::unique_ptr<appearance::Appearance> load_appearance(const fs::path& path) {
  if (!fs::exists(path)) throw Error(fmt::format("{}: no such file", path.string()));
  const std::string extension = io::extension_of(path);
  if (extension == ".ktx2") return load_ktx2(path);
  if (fs::is_directory(path)) return load_amc(path);
  if (extension == ".json") return load_json(path);
  if (std::ranges::count(io::image_extensions(), extension) > 0) return matcap::MatCap::read(path);
  throw Error(fmt::format(
      "{}: is no material; a picture (MatCap), .ktx2 (AMC), a folder of AMC slices or .json is needed",
      path.string()));
}

std::unique_ptr<appearance::Appearance> load_appearance(const fs::path& path, const Image& environment) {
  auto appearance = load_appearance(path);
  if (!appearance->set_environment(environment)) {
    throw Error(fmt::format(
        "{}: its light is baked in; only materials of \"model\": \"layered\" or \"mapped\" take one",
        path.string()));
  }
  return appearance;
}

}  // namespace sateen::scene
