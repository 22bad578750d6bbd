// SPDX-License-Identifier: MIT
#include "sateen/amc/amc_file.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sateen/core/error.h"
#include "sateen/core/parallel.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "sateen/io/json.h"
#include "sateen/io/ktx2.h"

namespace sateen::amc {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kZstdLevel = 5;  // a few per cent larger than the default and several times faster
constexpr const char* kDescription = "amc.json";
constexpr const char* kProvenancePrefix = "sateen.provenance.";

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw Error(fmt::format("{}: {}", path.string(), what));
}

int metadata_number(const fs::path& path, const io::Ktx2& texture, const std::string& key) {
  const auto found = texture.metadata.find(key);
  if (found == texture.metadata.end()) fail(path, fmt::format("the metadata lack '{}'", key));
  int value = 0;
  const char* end = found->second.data() + found->second.size();
  const auto [stop, code] = std::from_chars(found->second.data(), end, value);
  if (code != std::errc() || stop != end) {
    fail(path, fmt::format("the metadata say '{}' is '{}'; a whole number is needed", key, found->second));
  }
  return value;
}

void check_version(const fs::path& path, int version) {
  if (version < 1 || version > kAmcFileVersion) {
    fail(path, fmt::format("follows version {} of the AMC conventions; this program knows up to {}", version,
                           kAmcFileVersion));
  }
}

void check_texels(const fs::path& path, const AmcTable& table) {
  for (std::size_t i = 0; i < table.texels.size(); ++i) {
    if (std::isfinite(static_cast<float>(table.texels[i]))) continue;
    const std::size_t texel = i / 4;
    const std::size_t size = static_cast<std::size_t>(table.size);
    fail(path, fmt::format("texel ({}, {}, {}) is not finite", texel % size, texel / size % size,
                           texel / (size * size)));
  }
}

void write_ktx2_table(const fs::path& path, const AmcTable& table) {
  io::Ktx2 texture;
  texture.format =
      table.encoding == AmcEncoding::srgb8 ? io::VkFormat::rgba8_srgb : io::VkFormat::rgba16_sfloat;
  texture.width = texture.height = static_cast<std::uint32_t>(table.size);
  texture.depth = static_cast<std::uint32_t>(table.slices);
  texture.levels = {encoded_texels(table)};
  texture.metadata = {{"KTXorientation", "rui"},
                      {"sateen.kind", "amc"},
                      {"sateen.version", std::to_string(kAmcFileVersion)},
                      {"sateen.symmetry", std::to_string(table.symmetry)},
                      {"sateen.isotropic", table.isotropic ? "true" : "false"}};
  for (const auto& [key, value] : table.provenance) texture.metadata[kProvenancePrefix + key] = value;
  io::write_ktx2(path, texture, kZstdLevel);
}

void check_amc(const fs::path& path, const io::Ktx2& texture) {
  const auto kind = texture.metadata.find("sateen.kind");
  if (kind == texture.metadata.end() || kind->second != "amc") {
    fail(path, "is a KTX2 texture but no Anisotropic MatCap (its metadata lack sateen.kind = amc)");
  }
  check_version(path, metadata_number(path, texture, "sateen.version"));
  if (texture.depth == 0 || texture.width != texture.height || texture.layers != 0 || texture.faces != 1) {
    fail(path, fmt::format("an AMC is a 3D texture with a square base; this is {} x {} x {}", texture.width,
                           texture.height, texture.depth));
  }
  if (texture.format != io::VkFormat::rgba8_srgb && texture.format != io::VkFormat::rgba16_sfloat) {
    fail(path, "an AMC's texels are RGBA8 sRGB or RGBA half float; this file's are neither");
  }
}

AmcTable read_ktx2_table(const fs::path& path) {
  const io::Ktx2 texture = io::read_ktx2(path, [&](const io::Ktx2& info) { check_amc(path, info); });
  AmcTable table(static_cast<int>(texture.width), static_cast<int>(texture.depth),
                 metadata_number(path, texture, "sateen.symmetry"));
  table.encoding = texture.format == io::VkFormat::rgba8_srgb ? AmcEncoding::srgb8 : AmcEncoding::half;
  const auto isotropic = texture.metadata.find("sateen.isotropic");
  table.isotropic = isotropic != texture.metadata.end() && isotropic->second == "true";
  for (const auto& [key, value] : texture.metadata) {
    if (key.starts_with(kProvenancePrefix))
      table.provenance[key.substr(std::string(kProvenancePrefix).size())] = value;
  }
  set_encoded_texels(table, texture.levels[0]);
  check_texels(path, table);
  return table;
}

fs::path slice_path(const fs::path& folder, int slice, AmcEncoding encoding) {
  return folder / fmt::format("slice_{:03}.{}", slice, encoding == AmcEncoding::srgb8 ? "png" : "exr");
}

/// Whether a file is one that write_folder makes, of this table or of another.
bool is_part(const std::string& name) {
  if (name == kDescription) return true;
  const bool picture = name.ends_with(".png") || name.ends_with(".exr");
  if (!name.starts_with("slice_") || !picture) return false;
  const std::string number = name.substr(6, name.size() - 10);
  return !number.empty() && number.find_first_not_of("0123456789") == std::string::npos;
}

void write_folder(const fs::path& folder, const AmcTable& table) {
  const json description = {{"kind", "amc"},
                            {"version", kAmcFileVersion},
                            {"size", table.size},
                            {"slices", table.slices},
                            {"symmetry", table.symmetry},
                            {"isotropic", table.isotropic},
                            {"encoding", table.encoding == AmcEncoding::srgb8 ? "srgb8" : "half"},
                            {"provenance", table.provenance}};
  io::write_folder_atomically(
      folder,
      [&](const fs::path& made) {
        parallel_for(table.slices, [&](int f) {
          io::write_image(slice_path(made, f, table.encoding), slice_image(table, f));
        });
        io::write_text(made / kDescription, io::json_text(description, 2) + "\n");
      },
      is_part);
}

AmcTable read_folder(const fs::path& folder) {
  const fs::path file = folder / kDescription;
  AmcTable table;
  try {
    const json description = io::read_json(file);
    if (description.at("kind") != "amc") fail(file, "'kind' is not 'amc'");
    check_version(file, description.at("version"));
    table = AmcTable(description.at("size"), description.at("slices"), description.at("symmetry"));
    table.isotropic = description.value("isotropic", false);
    const std::string encoding = description.at("encoding");
    if (encoding != "srgb8" && encoding != "half") fail(file, "'encoding' must be srgb8 or half");
    table.encoding = encoding == "srgb8" ? AmcEncoding::srgb8 : AmcEncoding::half;
    table.provenance = description.value("provenance", table.provenance);
  } catch (const json::exception& error) {
    fail(file, std::string("is no description of an AMC: ") + error.what());
  }
  parallel_for(table.slices, [&](int f) {
    const fs::path path = slice_path(folder, f, table.encoding);
    const Image image = io::read_image(path);
    if (image.width != table.size || image.height != table.size) {
      fail(path, fmt::format("is {} x {} pixels, the AMC's slices are {} x {}", image.width, image.height,
                             table.size, table.size));
    }
    set_slice_image(table, f, image);
  });
  quantise(table);
  return table;
}

}  // namespace

void write_amc(const fs::path& path, const AmcTable& table) {
  if (io::extension_of(path) == ".ktx2") {
    write_ktx2_table(path, table);
  } else if (!path.has_extension()) {
    write_folder(path, table);
  } else {
    fail(path, "an AMC is written as .ktx2, or as a folder of slices (a name without extension)");
  }
}

AmcTable read_amc(const fs::path& path) {
  return fs::is_directory(path) ? read_folder(path) : read_ktx2_table(path);
}

}  // namespace sateen::amc
