// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "sateen/core/error.h"
#include "sateen/core/parallel.h"
#include "sateen/io/file.h"
#include "sateen/io/image_rows.h"
#include "sateen/texture/block_compression.h"
#include "sateen/texture/lobe_files.h"

namespace sateen::texture {
namespace {

namespace fs = std::filesystem;

/// The three stored channels of both maps. Pictures hold the whole normal, `signed_normals` its components
/// themselves.
struct Channels {
  std::array<float, 3> normal;
  std::array<float, 3> aniso;
};

Channels channels_of(const LobeTexel& texel, const LobeOutput& output, bool signed_normals) {
  Channels c{};
  for (std::size_t i = 0; i < 3; ++i) {
    double v = texel.normal[static_cast<Eigen::Index>(i)];
    if (i == 1 && output.green_down) v = -v;
    c.normal[i] = static_cast<float>(signed_normals ? v : v / 2 + 0.5);
  }
  const Vec3 a = encode_anisotropy(texel.s, output.encoding);
  for (std::size_t i = 0; i < 3; ++i) c.aniso[i] = static_cast<float>(a[static_cast<Eigen::Index>(i)]);
  return c;
}

/// One level of one map on its way to a picture file. Rows that arrive before their turn wait, as they will
/// be stored.
class PictureLevel {
 public:
  PictureLevel(const fs::path& file, const fs::path& name, int width, int height, io::RowSamples samples)
      : writer_(file, name, width, height, 3, samples), floats_(samples == io::RowSamples::f16) {}

  /// Row y of three channels.
  void write(int y, std::span<const float> row) {
    if (y != next_) {
      std::vector<std::uint16_t>& packed = waiting_[y];
      packed.resize(row.size());
      std::ranges::transform(row, packed.begin(), [&](float v) { return pack(v); });
      return;
    }
    writer_.write(row);
    ++next_;
    std::vector<float> unpacked(row.size());
    for (auto at = waiting_.find(next_); at != waiting_.end(); at = waiting_.find(next_)) {
      std::ranges::transform(at->second, unpacked.begin(), [&](std::uint16_t v) { return unpack(v); });
      writer_.write(unpacked);
      waiting_.erase(at);
      ++next_;
    }
  }

  void close() { writer_.close(); }

 private:
  std::uint16_t pack(float v) const {
    if (floats_) return Eigen::numext::bit_cast<std::uint16_t>(Half(v));
    return static_cast<std::uint16_t>(std::clamp(v, 0.0f, 1.0f) * 65535 + 0.5f);
  }
  float unpack(std::uint16_t v) const {
    if (floats_) return static_cast<float>(Eigen::numext::bit_cast<Half>(v));
    return static_cast<float>(v) / 65535;
  }

  io::ImageRowWriter writer_;
  bool floats_;
  int next_ = 0;
  std::map<int, std::vector<std::uint16_t>> waiting_;
};

/// `files` are in the order of `names`: both maps of level 0, then of level 1, ...
class PictureSink : public LobeSink {
 public:
  PictureSink(int width, int height, const LobeOutput& output, io::RowSamples samples,
              std::span<const fs::path> files, std::span<const fs::path> names)
      : output_(output), signed_normals_(samples == io::RowSamples::f16) {
    for (std::size_t i = 0; i < files.size(); ++i) {
      const int level = static_cast<int>(i / 2);
      levels_.push_back(std::make_unique<PictureLevel>(files[i], names[i], std::max(width >> level, 1),
                                                       std::max(height >> level, 1), samples));
    }
  }

  void write(int level, std::span<const LobeRow> rows) override {
    const std::size_t row_values = rows[0].texels.size() * 3;
    std::array<std::vector<float>, 2> values;
    for (auto& v : values) v.resize(rows.size() * row_values);
    parallel_for(static_cast<int>(rows.size()), [&](int r) {
      auto at = static_cast<std::ptrdiff_t>(static_cast<std::size_t>(r) * row_values);
      for (const LobeTexel& texel : rows[static_cast<std::size_t>(r)].texels) {
        const Channels c = channels_of(texel, output_, signed_normals_);
        std::ranges::copy(c.normal, values[0].begin() + at);
        std::ranges::copy(c.aniso, values[1].begin() + at);
        at += 3;
      }
    });
    parallel_for(2, [&](int map) {
      PictureLevel& picture = *levels_[static_cast<std::size_t>(level * 2 + map)];
      const std::span<const float> all(values[static_cast<std::size_t>(map)]);
      for (std::size_t r = 0; r < rows.size(); ++r) {
        picture.write(rows[r].y, all.subspan(r * row_values, row_values));
      }
    });
  }

  void close() {
    for (const auto& level : levels_) level->close();
  }

 private:
  const LobeOutput& output_;
  bool signed_normals_;
  std::vector<std::unique_ptr<PictureLevel>> levels_;
};

/// Collects all levels as the file will hold them; blocks are compressed as soon as their four rows are
/// there.
class KtxSink : public LobeSink {
 public:
  KtxSink(int width, int height, int levels, const LobeOutput& output) : output_(output) {
    const bool blocks = output.kind == LobeOutput::Kind::ktx2_blocks;
    maps[0].format = blocks ? io::VkFormat::bc5_unorm : io::VkFormat::rg8_unorm;
    maps[1].format = blocks ? io::VkFormat::bc7_unorm : io::VkFormat::rgba8_unorm;
    for (io::Ktx2& map : maps) {
      map.width = static_cast<std::uint32_t>(width);
      map.height = static_cast<std::uint32_t>(height);
      map.levels.resize(static_cast<std::size_t>(levels));
      for (std::uint32_t level = 0; level < map.levels.size(); ++level) {
        map.levels[level].resize(io::ktx2_level_bytes(map, level));
      }
    }
  }

  void write(int level, std::span<const LobeRow> rows) override {
    const std::size_t width = rows[0].texels.size();
    std::vector<std::vector<std::uint8_t>> bytes[2];
    for (auto& b : bytes) b.resize(rows.size());
    parallel_for(static_cast<int>(rows.size()), [&](int r) {
      const auto index = static_cast<std::size_t>(r);
      for (auto& b : bytes) b[index].assign(width * 4, 255);
      for (std::size_t x = 0; x < width; ++x) {
        const Channels c = channels_of(rows[index].texels[x], output_, false);
        const auto quantised = [](float v) {
          return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 1.0f) * 255 + 0.5f);
        };
        for (std::size_t i = 0; i < 3; ++i) {
          bytes[0][index][x * 4 + i] = quantised(c.normal[i]);
          bytes[1][index][x * 4 + i] = quantised(c.aniso[i]);
        }
      }
    });
    if (output_.kind == LobeOutput::Kind::ktx2) {
      for (std::size_t r = 0; r < rows.size(); ++r) store_texels(level, rows[r].y, bytes[0][r], bytes[1][r]);
    } else {
      for (std::size_t r = 0; r < rows.size(); ++r) {
        add_row(level, rows[r].y, width, std::move(bytes[0][r]), std::move(bytes[1][r]));
      }
      compress_ready();
    }
  }

  std::array<io::Ktx2, 2> maps;

 private:
  /// Four rows of both maps, RGBA.
  struct Strip {
    int level = 0;
    int by = 0;
    std::size_t width = 0;
    int missing = 4;
    std::array<std::vector<std::uint8_t>, 2> rgba;
  };

  void store_texels(int level, int y, const std::vector<std::uint8_t>& normal,
                    const std::vector<std::uint8_t>& aniso) {
    const std::size_t width = normal.size() / 4;
    std::byte* rg =
        maps[0].levels[static_cast<std::size_t>(level)].data() + static_cast<std::size_t>(y) * width * 2;
    std::byte* rgba =
        maps[1].levels[static_cast<std::size_t>(level)].data() + static_cast<std::size_t>(y) * width * 4;
    for (std::size_t x = 0; x < width; ++x) {
      for (std::size_t c = 0; c < 2; ++c) rg[x * 2 + c] = static_cast<std::byte>(normal[x * 4 + c]);
      for (std::size_t c = 0; c < 4; ++c) rgba[x * 4 + c] = static_cast<std::byte>(aniso[x * 4 + c]);
    }
  }

  void add_row(int level, int y, std::size_t width, std::vector<std::uint8_t> normal,
               std::vector<std::uint8_t> aniso) {
    const int height = std::max(static_cast<int>(maps[0].height) >> level, 1);
    const auto [at, fresh] = open_.try_emplace({level, y / 4});
    Strip& strip = at->second;
    if (fresh) {
      strip.level = level;
      strip.by = y / 4;
      strip.width = width;
      strip.missing = std::min(4, height - strip.by * 4);
      for (auto& rgba : strip.rgba) rgba.resize(static_cast<std::size_t>(strip.missing) * width * 4);
    }
    const auto to = static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y % 4) * width * 4);
    std::ranges::copy(normal, strip.rgba[0].begin() + to);
    std::ranges::copy(aniso, strip.rgba[1].begin() + to);
    if (--strip.missing == 0) {
      ready_.push_back(std::move(strip));
      open_.erase(at);
    }
  }

  void compress_ready() {
    Bc7Options options;
    options.effort = output_.effort;
    parallel_for(static_cast<int>(ready_.size()) * 2, [&](int job) {
      const Strip& strip = ready_[static_cast<std::size_t>(job / 2)];
      const std::size_t map = static_cast<std::size_t>(job % 2);
      const int width = static_cast<int>(strip.width);
      const auto& rgba = strip.rgba[map];
      const auto blocks = compress_blocks(map == 0 ? BlockFormat::bc5 : BlockFormat::bc7, rgba, width,
                                          static_cast<int>(rgba.size() / 4 / strip.width), options);
      std::ranges::copy(blocks, maps[map].levels[static_cast<std::size_t>(strip.level)].begin() +
                                    static_cast<std::ptrdiff_t>(blocks.size()) * strip.by);
    });
    ready_.clear();
  }

  const LobeOutput& output_;
  std::map<std::pair<int, int>, Strip> open_;
  std::vector<Strip> ready_;
};

std::vector<fs::path> write_ktx(LobeSource& source, const fs::path& base, const ChainOptions& chain,
                                const LobeOutput& output, int levels, const Progress& progress) {
  const std::vector<fs::path> paths{base.string() + "_normal.ktx2", base.string() + "_aniso.ktx2"};
  io::check_writable(paths);
  KtxSink sink(source.width(), source.height(), levels, output);
  filter_lobe_chain(source, sink, chain, progress);
  for (io::Ktx2& map : sink.maps) {
    map.metadata["KTXorientation"] = "rd";
    map.metadata["sateen.version"] = std::to_string(kLobeFileVersion);
    map.metadata["SateenFilter"] =
        name_of(chain.filter.method) + (chain.filter.isotropic ? " isotropic" : "");
  }
  sink.maps[0].metadata["sateen.kind"] = kNormalMapKind;
  sink.maps[1].metadata["sateen.kind"] = kAnisotropyMapKind;
  sink.maps[0].metadata["SateenNormals"] = output.green_down ? "xy, green down" : "xy, green up";
  sink.maps[1].metadata["SateenAnisotropy"] = name_of(output.encoding);
  io::write_ktx2(paths, sink.maps, output.zstd_level);
  return paths;
}

std::vector<fs::path> write_pictures(LobeSource& source, const fs::path& base, const ChainOptions& chain,
                                     const LobeOutput& output, int levels, const Progress& progress) {
  const bool exr = output.kind == LobeOutput::Kind::exr;
  const io::RowSamples samples = exr                                     ? io::RowSamples::f16
                                 : output.kind == LobeOutput::Kind::png8 ? io::RowSamples::u8
                                                                         : io::RowSamples::u16;
  const auto path_of = [&](const char* map, int level) {
    return fs::path(fmt::format("{}_{}_{}{}", base.string(), map, level, exr ? ".exr" : ".png"));
  };
  std::vector<fs::path> paths;
  for (int level = 0; level < levels; ++level) {
    paths.push_back(path_of("normal", level));
    paths.push_back(path_of("aniso", level));
  }
  io::write_atomically(paths, [&](std::span<const fs::path> files) {
    PictureSink sink(source.width(), source.height(), output, samples, files, paths);
    filter_lobe_chain(source, sink, chain, progress);
    sink.close();
  });
  return paths;
}

}  // namespace

std::vector<fs::path> write_lobe_chain(LobeSource& source, const fs::path& base, const ChainOptions& chain,
                                       const LobeOutput& output, const Progress& progress) {
  const int whole = mip_levels(source.width(), source.height());
  const int levels = chain.levels > 0 ? std::min(chain.levels, whole) : whole;
  fs::path stem = base;
  stem.replace_extension();
  const bool ktx = output.kind == LobeOutput::Kind::ktx2 || output.kind == LobeOutput::Kind::ktx2_blocks;
  return ktx ? write_ktx(source, stem, chain, output, levels, progress)
             : write_pictures(source, stem, chain, output, levels, progress);
}

}  // namespace sateen::texture
