// SPDX-License-Identifier: MIT
#include "sateen/matcap/decomposition_file.h"

#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sateen/core/error.h"
#include "sateen/io/json.h"
#include "sateen/io/ktx2.h"
#include "sateen/matcap/half_texels.h"

namespace sateen::matcap {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kLayers = 4;
constexpr std::uint32_t kLargestMap = 4096;
constexpr int kZstdLevel = 3;  // half floats of level 9 are a sixth smaller and take 4 times as long

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw Error(fmt::format("{}: {}", path.string(), what));
}

json to_json(const MatcapPart& part) {
  json regions = json::array();
  for (const Region& r : part.regions) regions.push_back({r.x, r.y, r.width, r.height});
  return {{"variance", part.variance},
          {"slope", part.slope()},
          {"measured", part.measured},
          {"feature", part.feature == Feature::edge ? "edge" : "line"},
          {"regions", regions},
          {"base_color", {part.base_color.x(), part.base_color.y(), part.base_color.z()}},
          {"map_variances", part.map.variances}};
}

double finite(const fs::path& path, const json& value, const char* key, double least, double most) {
  const double number = value.at(key);
  if (!(number >= least && number <= most)) {
    fail(path,
         fmt::format("the parameters say '{}' is {}; it must be within {} and {}", key, number, least, most));
  }
  return number;
}

MatcapPart part_from_json(const fs::path& path, const json& value) {
  MatcapPart part;
  part.variance = finite(path, value, "variance", 0, kFlattest);
  part.measured = value.value("measured", false);
  part.feature = value.value("feature", "line") == "edge" ? Feature::edge : Feature::line;
  for (const json& r : value.value("regions", json::array()))
    part.regions.push_back({r.at(0), r.at(1), r.at(2), r.at(3)});
  for (int c = 0; c < 3; ++c) {
    part.base_color[c] = value.at("base_color").at(static_cast<std::size_t>(c));
    if (!(part.base_color[c] > 0 && part.base_color[c] < 1e6)) fail(path, "a base colour is not positive");
  }
  part.map.variances = value.at("map_variances").get<std::vector<double>>();
  if (part.map.variances.empty() || part.map.variances[0] != 0) {
    fail(path, "'map_variances' must have one entry for each mip level, the first 0");
  }
  for (std::size_t i = 1; i < part.map.variances.size(); ++i) {
    if (!(part.map.variances[i] > part.map.variances[i - 1])) fail(path, "'map_variances' must increase");
  }
  return part;
}

MatcapDecomposition from_json(const fs::path& path, const json& value) {
  MatcapDecomposition matcap;
  const std::string space = value.at("space");
  if (space != "display" && space != "linear") fail(path, "'space' must be display or linear");
  matcap.space = space == "display" ? AddUpSpace::display : AddUpSpace::linear;
  matcap.width = static_cast<int>(finite(path, value, "width", 1, 65536));
  matcap.height = static_cast<int>(finite(path, value, "height", 1, 65536));
  const json& disc = value.at("disc");
  matcap.disc = {disc.at("x"), disc.at("y"), disc.at("radius")};
  check_disc(matcap.disc, matcap.width, matcap.height, path.string());
  matcap[Part::low] = part_from_json(path, value.at("low"));
  matcap[Part::high] = part_from_json(path, value.at("high"));
  matcap.provenance = value.value("provenance", matcap.provenance);
  return matcap;
}

json parameters(const MatcapDecomposition& matcap) {
  return {{"space", matcap.space == AddUpSpace::display ? "display" : "linear"},
          {"width", matcap.width},
          {"height", matcap.height},
          {"disc", {{"x", matcap.disc.x}, {"y", matcap.disc.y}, {"radius", matcap.disc.radius}}},
          {"map_size", matcap[Part::low].map.levels.front().size()},
          {"low", to_json(matcap[Part::low])},
          {"high", to_json(matcap[Part::high])},
          {"provenance", matcap.provenance}};
}

std::string entry(const io::Ktx2& texture, const char* key) {
  const auto found = texture.metadata.find(key);
  return found == texture.metadata.end() ? std::string() : found->second;
}

void check_kind(const fs::path& path, const io::Ktx2& texture) {
  if (entry(texture, "sateen.kind") != kMatcapKind) {
    fail(path, "is a KTX2 texture but no decomposed MatCap; \"sateen matcap decompose\" makes one");
  }
  if (entry(texture, "sateen.version") != std::to_string(kMatcapFileVersion)) {
    fail(path, fmt::format("follows version '{}' of the file's conventions; this program knows {}",
                           entry(texture, "sateen.version"), kMatcapFileVersion));
  }
}

MatcapDecomposition parameters_in(const fs::path& path, const io::Ktx2& texture) {
  check_kind(path, texture);
  if (texture.layers != kLayers || texture.depth != 0 || texture.faces != 1 ||
      texture.width != texture.height || texture.width < 2 || texture.format != io::VkFormat::rgba16_sfloat) {
    fail(path, "a decomposed MatCap has four square layers of half floats; this texture has not");
  }
  if (texture.width > kLargestMap) {
    fail(path, fmt::format("has maps of {} texels across; {} are the most", texture.width, kLargestMap));
  }
  try {
    return from_json(path, io::parse_json(entry(texture, "sateen.matcap"), path.string()));
  } catch (const json::exception& error) {
    fail(path, std::string("the parameters cannot be read: ") + error.what());
  }
}

}  // namespace

std::string matcap_json(const MatcapDecomposition& matcap) {
  return io::json_text(parameters(matcap));
}

void write_matcap(const fs::path& path, const MatcapDecomposition& matcap) {
  io::Ktx2 texture;
  texture.format = io::VkFormat::rgba16_sfloat;
  texture.width = texture.height = static_cast<std::uint32_t>(matcap[Part::low].map.levels.front().size());
  texture.layers = kLayers;
  texture.levels = half_levels(matcap);
  texture.metadata = {{"KTXorientation", "ru"},
                      {"sateen.kind", kMatcapKind},
                      {"sateen.version", std::to_string(kMatcapFileVersion)},
                      {"sateen.matcap", matcap_json(matcap)}};
  if (!matcap.kept.pixels.empty()) texture.metadata["sateen.kept"] = text_of_pixels(matcap.kept.pixels);
  io::write_ktx2(path, texture, kZstdLevel);
}

MatcapDecomposition read_matcap_parameters(const fs::path& path) {
  return parameters_in(path, io::read_ktx2_info(path));
}

MatcapDecomposition read_matcap(const fs::path& path) {
  MatcapDecomposition matcap;
  const io::Ktx2 texture =
      io::read_ktx2(path, [&](const io::Ktx2& info) { matcap = parameters_in(path, info); });
  for (const MatcapPart& part : matcap.parts) {
    if (part.map.variances.size() != texture.levels.size()) {
      fail(path, fmt::format("'map_variances' must have one entry for each of the {} mip levels, the first 0",
                             texture.levels.size()));
    }
  }
  try {
    const auto pixels = static_cast<std::size_t>(matcap.width) * static_cast<std::size_t>(matcap.height);
    matcap.kept = {matcap.width, matcap.height, matcap.disc,
                   pixels_of_text(entry(texture, "sateen.kept"), pixels)};
  } catch (const Error& error) {
    fail(path, fmt::format("'sateen.kept': {}", error.what()));
  }
  set_half_levels(matcap, static_cast<int>(texture.width), texture.levels);
  for (const MatcapPart& part : matcap.parts) {
    for (const SphereMap& level : part.map.levels) {
      for (const Image* image : {&level.front, &level.back}) {
        for (const float v : image->data) {
          if (!std::isfinite(v)) fail(path, "has a texel that is not finite");
        }
      }
    }
  }
  return matcap;
}

}  // namespace sateen::matcap
