// SPDX-License-Identifier: MIT
#include "sateen/scene/registry.h"

#include <algorithm>
#include <functional>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sateen/amc/amc_file.h"
#include "sateen/amc/appearance.h"
#include "sateen/appearance/json_reader.h"
#include "sateen/brdf/research/slides.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "sateen/io/json.h"
#include "sateen/io/ktx2.h"
#include "sateen/matcap/decomposed_appearance.h"
#include "sateen/matcap/matcap.h"
#include "sateen/scene/constant.h"
#include "sateen/texture/mapped_appearance.h"

namespace sateen::scene {
namespace {

namespace fs = std::filesystem;
using Made = std::shared_ptr<appearance::Appearance>;
/// From JSON text and the path that messages call it.
using Parser = std::function<Made(const std::string&, const fs::path&)>;
using Loader = std::function<Made(const fs::path&)>;

Made load_amc(const fs::path& path) {
  return std::make_shared<amc::AmcAppearance>(amc::read_amc(path));
}

/// Values of "sateen.kind" in .ktx2 files.
const std::map<std::string, Loader>& ktx2_kinds() {
  static const std::map<std::string, Loader> loaders{
      {"amc", load_amc},
      {"matcap-decomposition", matcap::DecomposedAppearance::read},
  };
  return loaders;
}

/// Values of "model" in .json materials.
const std::map<std::string, Parser>& models() {
  static const std::map<std::string, Parser> parsers{
      {"constant", Constant::parse},
      {"layered", brdf::parse_layered},
      {"mapped", texture::MappedAppearance::parse},
      {"matcap-decomposition", matcap::DecomposedAppearance::parse},
  };
  return parsers;
}

/// What stands under `kind`. Throws Error that lists what is known.
template <class Value>
const Value& find(const std::map<std::string, Value>& known, const std::string& key, const std::string& kind,
                  const fs::path& path) {
  if (const auto found = known.find(kind); found != known.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [name, value] : known) names.push_back(name);
  throw Error(fmt::format("{}: {} \"{}\" is not known; known are {}", path.string(), key, kind,
                          fmt::join(names, ", ")));
}

Made load_ktx2(const fs::path& path) {
  const auto metadata = io::read_ktx2_info(path).metadata;
  const auto kind = metadata.find("sateen.kind");
  if (kind == metadata.end()) {
    throw Error(fmt::format("{}: is a texture but none that Sateen made; \"sateen amc build\" makes one",
                            path.string()));
  }
  return find(ktx2_kinds(), "sateen.kind", kind->second, path)(path);
}

LoadedMaterial load_json(const fs::path& path) {
  const nlohmann::json value = io::read_json(path);
  if (!value.is_object() || !value.contains("model") || !value["model"].is_string()) {
    throw Error(fmt::format("{}: is no material; a JSON object with \"model\" is needed", path.string()));
  }
  LoadedMaterial material;
  material.appearance = find(models(), "model", value["model"], path)(io::json_text(value), path);
  if (material.appearance->lit()) {
    appearance::JsonObject json(value, path.string());
    material.lighting = appearance::read_lighting_keys(json, path);
  }
  return material;
}

}  // namespace

LoadedMaterial load_material(const fs::path& path) {
  if (!fs::exists(path)) throw Error(fmt::format("{}: no such file", path.string()));
  const std::string extension = io::extension_of(path);
  if (extension == ".ktx2") return {load_ktx2(path), {}};
  if (fs::is_directory(path)) return {load_amc(path), {}};
  if (extension == ".json") return load_json(path);
  if (std::ranges::count(io::image_extensions(), extension) > 0) return {matcap::MatCap::read(path), {}};
  throw Error(fmt::format(
      "{}: is no material; a picture (MatCap), .ktx2 (AMC), a folder of AMC slices or .json is needed",
      path.string()));
}

std::shared_ptr<appearance::Appearance> load_appearance(const fs::path& path) {
  return load_material(path).appearance;
}

}  // namespace sateen::scene
