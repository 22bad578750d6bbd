// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "sateen/core/error.h"
#include "sateen/core/parallel.h"
#include "sateen/io/file.h"
#include "sateen/io/image_rows.h"
#include "sateen/texture/block_compression.h"
#include "sateen/texture/lobe_files.h"

namespace sateen {
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

/// Level 0 goes straight to its files; the others are kept in half the size of floats until their last row is
/// there.
class PictureSink : public LobeSink {
 public:
  PictureSink(int width, int height, int levels, const LobeOutput& output, ImageRowWriter& normal,
              ImageRowWriter& aniso)
      : output_(output), exr_(output.kind == LobeOutput::Kind::exr), first_{&normal, &aniso} {
    for (int level = 1; level < levels; ++level) {
      const int w = std::max(width >> level, 1);
      const int h = std::max(height >> level, 1);
      const std::size_t values = static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * 3;
      levels_.push_back({w, h, {std::vector<std::uint16_t>(values), std::vector<std::uint16_t>(values)}});
    }
  }

  void write(int level, std::span<const LobeRow> rows) override {
    const std::size_t width = rows[0].texels.size();
    std::array<std::vector<float>, 2> values;
    for (auto& v : values) v.resize(rows.size() * width * 3);
    parallel_for(static_cast<int>(rows.size()), [&](int r) {
      const LobeRow& row = rows[static_cast<std::size_t>(r)];
      for (std::size_t x = 0; x < width; ++x) {
        const Channels c = channels_of(row.texels[x], output_, exr_);
        const auto at = static_cast<std::ptrdiff_t>((static_cast<std::size_t>(r) * width + x) * 3);
        std::ranges::copy(c.normal, values[0].begin() + at);
        std::ranges::copy(c.aniso, values[1].begin() + at);
      }
    });
    if (level == 0) {
      parallel_for(2, [&](int map) {
        first_[static_cast<std::size_t>(map)]->write(values[static_cast<std::size_t>(map)]);
      });
      return;
    }
    Level& kept = levels_[static_cast<std::size_t>(level - 1)];
    for (std::size_t map = 0; map < 2; ++map) {
      for (std::size_t r = 0; r < rows.size(); ++r) {
        const std::size_t to = static_cast<std::size_t>(rows[r].y) * width * 3;
        for (std::size_t i = 0; i < width * 3; ++i)
          kept.maps[map][to + i] = pack(values[map][r * width * 3 + i]);
      }
    }
  }

  void write_level(int level, std::size_t map, const fs::path& path, RowSamples samples) const {
    const Level& kept = levels_[static_cast<std::size_t>(level - 1)];
    write_atomically(path, [&](const fs::path& temporary) {
      ImageRowWriter writer(temporary, path, kept.width, kept.height, 3, samples);
      std::vector<float> rows(static_cast<std::size_t>(kept.width) * 3);
      for (int y = 0; y < kept.height; ++y) {
        const std::size_t from = static_cast<std::size_t>(y) * rows.size();
        for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = unpack(kept.maps[map][from + i]);
        writer.write(rows);
      }
      writer.close();
    });
  }

 private:
  struct Level {
    int width;
    int height;
    std::array<std::vector<std::uint16_t>, 2> maps;
  };

  std::uint16_t pack(float v) const {
    if (exr_) return Eigen::numext::bit_cast<std::uint16_t>(Half(v));
    return static_cast<std::uint16_t>(std::clamp(v, 0.0f, 1.0f) * 65535 + 0.5f);
  }
  float unpack(std::uint16_t v) const {
    if (exr_) return static_cast<float>(Eigen::numext::bit_cast<Half>(v));
    return static_cast<float>(v) / 65535;
  }

  const LobeOutput& output_;
  bool exr_;
  std::array<ImageRowWriter*, 2> first_;
  std::vector<Level> levels_;
};

/// Collects all levels as the file will hold them; blocks are compressed as soon as their four rows are
/// there.
class KtxSink : public LobeSink {
 public:
  KtxSink(int width, int height, int levels, const LobeOutput& output) : output_(output) {
    const bool blocks = output.kind == LobeOutput::Kind::ktx2_blocks;
    maps[0].format = blocks ? VkFormat::bc5_unorm : VkFormat::rg8_unorm;
    maps[1].format = blocks ? VkFormat::bc7_unorm : VkFormat::rgba8_unorm;
    for (Ktx2& map : maps) {
      map.width = static_cast<std::uint32_t>(width);
      map.height = static_cast<std::uint32_t>(height);
      map.levels.resize(static_cast<std::size_t>(levels));
      for (std::uint32_t level = 0; level < map.levels.size(); ++level) {
        map.levels[level].resize(ktx2_level_bytes(map, level));
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

  std::array<Ktx2, 2> maps;

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
  KtxSink sink(source.width(), source.height(), levels, output);
  filter_lobe_chain(source, sink, chain, progress);
  for (Ktx2& map : sink.maps) {
    map.metadata["KTXorientation"] = "rd";
    map.metadata["SateenFilter"] =
        name_of(chain.filter.method) + (chain.filter.isotropic ? " isotropic" : "");
  }
  sink.maps[0].metadata["SateenNormals"] = output.green_down ? "xy, green down" : "xy, green up";
  sink.maps[1].metadata["SateenAnisotropy"] = name_of(output.encoding);
  const std::vector<fs::path> paths{base.string() + "_normal.ktx2", base.string() + "_aniso.ktx2"};
  for (std::size_t map = 0; map < 2; ++map) write_ktx2(paths[map], sink.maps[map], output.zstd_level);
  return paths;
}

std::vector<fs::path> write_pictures(LobeSource& source, const fs::path& base, const ChainOptions& chain,
                                     const LobeOutput& output, int levels, const Progress& progress) {
  const bool exr = output.kind == LobeOutput::Kind::exr;
  const RowSamples samples = exr                                     ? RowSamples::f16
                             : output.kind == LobeOutput::Kind::png8 ? RowSamples::u8
                                                                     : RowSamples::u16;
  const auto path_of = [&](const char* map, int level) {
    return fs::path(fmt::format("{}_{}_{}{}", base.string(), map, level, exr ? ".exr" : ".png"));
  };
  std::vector<fs::path> paths;
  for (int level = 0; level < levels; ++level) {
    paths.push_back(path_of("normal", level));
    paths.push_back(path_of("aniso", level));
  }
  // The first level's files take their names last, so that a failure leaves nothing that looks whole.
  write_atomically(paths[0], [&](const fs::path& normal_file) {
    write_atomically(paths[1], [&](const fs::path& aniso_file) {
      ImageRowWriter normal(normal_file, paths[0], source.width(), source.height(), 3, samples);
      ImageRowWriter aniso(aniso_file, paths[1], source.width(), source.height(), 3, samples);
      PictureSink sink(source.width(), source.height(), levels, output, normal, aniso);
      filter_lobe_chain(source, sink, chain, progress);
      normal.close();
      aniso.close();
      std::vector<fs::path> written;
      std::mutex mutex;
      try {
        parallel_for((levels - 1) * 2, [&](int job) {
          const fs::path& path = paths[static_cast<std::size_t>(job + 2)];
          sink.write_level(1 + job / 2, static_cast<std::size_t>(job % 2), path, samples);
          const std::lock_guard lock(mutex);
          written.push_back(path);
        });
      } catch (...) {
        std::error_code ignored;
        for (const fs::path& path : written) fs::remove(path, ignored);
        throw;
      }
    });
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

}  // namespace sateen
