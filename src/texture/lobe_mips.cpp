// SPDX-License-Identifier: MIT
#include "sateen/texture/lobe_mips.h"

#include <algorithm>

#include <fmt/format.h>

#include "sateen/core/error.h"
#include "sateen/io/blocks.h"
#include "sateen/io/ktx2.h"

namespace sateen::texture {
namespace {

namespace fs = std::filesystem;

class MemorySink : public LobeSink {
 public:
  MemorySink(int width, int height, int levels, LobeMips& mips) : mips_(mips) {
    for (int level = 0; level < levels; ++level) {
      const int w = std::max(width >> level, 1);
      const int h = std::max(height >> level, 1);
      mips_.normals.emplace_back(w, h, 2);
      mips_.anisotropy.emplace_back(w, h, 3);
    }
  }

  void write(int level, std::span<const LobeRow> rows) override {
    Image& normals = mips_.normals[static_cast<std::size_t>(level)];
    Image& anisotropy = mips_.anisotropy[static_cast<std::size_t>(level)];
    for (const LobeRow& row : rows) {
      for (int x = 0; x < normals.width; ++x) {
        const LobeTexel& texel = row.texels[static_cast<std::size_t>(x)];
        const Vec3 channels = encode_anisotropy(texel.s, mips_.encoding);
        for (int c = 0; c < 2; ++c) normals.at(x, row.y, c) = static_cast<float>(texel.normal[c] / 2 + 0.5);
        for (int c = 0; c < 3; ++c) anisotropy.at(x, row.y, c) = static_cast<float>(channels[c]);
      }
    }
  }

 private:
  LobeMips& mips_;
};

std::vector<Image> levels_of(const io::Ktx2& texture, const fs::path& path) {
  std::vector<Image> levels;
  for (std::size_t i = 0; i < texture.levels.size(); ++i) {
    const int width = static_cast<int>(std::max(texture.width >> i, 1u));
    const int height = static_cast<int>(std::max(texture.height >> i, 1u));
    const std::vector<std::byte>& bytes = texture.levels[i];
    const bool two = texture.format == io::VkFormat::rg8_unorm;
    if (!two && texture.format != io::VkFormat::rgba8_unorm) {
      levels.push_back(io::decode_blocks(texture.format, bytes, width, height, path.string()));
      continue;
    }
    Image& image = levels.emplace_back(width, height, two ? 2 : 4);
    std::ranges::transform(bytes, image.data.begin(),
                           [](std::byte b) { return static_cast<float>(std::to_integer<int>(b)) / 255; });
  }
  return levels;
}

/// The value of a key that write_lobe_chain sets.
std::string note(const io::Ktx2& texture, const std::string& key, const fs::path& path) {
  const auto found = texture.metadata.find(key);
  if (found == texture.metadata.end() || texture.depth > 0 || texture.layers > 0 || texture.faces != 1) {
    throw Error(fmt::format("{}: is no such map ({} is not in it); \"sateen maps aniso filter\" makes one",
                            path.string(), key));
  }
  return found->second;
}

}  // namespace

LobeMips make_lobe_mips(LobeSource& source, const ChainOptions& options, AnisotropyEncoding encoding) {
  LobeMips mips;
  mips.encoding = encoding;
  const int whole = mip_levels(source.width(), source.height());
  MemorySink sink(source.width(), source.height(),
                  options.levels > 0 ? std::min(options.levels, whole) : whole, mips);
  filter_lobe_chain(source, sink, options);
  return mips;
}

LobeMips read_lobe_mips(const fs::path& normals, const fs::path& anisotropy) {
  const auto read = [](const fs::path& path, const char* key) {
    return io::read_ktx2(path, [&](const io::Ktx2& texture) { note(texture, key, path); });
  };
  const io::Ktx2 n = read(normals, "SateenNormals");
  const io::Ktx2 a = read(anisotropy, "SateenAnisotropy");
  LobeMips mips;
  mips.green_down = note(n, "SateenNormals", normals) == "xy, green down";
  mips.encoding = anisotropy_encoding_from_name(note(a, "SateenAnisotropy", anisotropy));
  if (n.width != a.width || n.height != a.height || n.levels.size() != a.levels.size()) {
    throw Error(fmt::format("{}: is {} x {} with {} levels but {} is {} x {} with {}; filter them together",
                            anisotropy.string(), a.width, a.height, a.levels.size(), normals.string(),
                            n.width, n.height, n.levels.size()));
  }
  mips.normals = levels_of(n, normals);
  mips.anisotropy = levels_of(a, anisotropy);
  return mips;
}

}  // namespace sateen::texture
