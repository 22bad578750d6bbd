// SPDX-License-Identifier: MIT
#include "sateen/texture/lobe_chain.h"

#include <algorithm>

#include "sateen/core/parallel.h"

namespace sateen::texture {
namespace {

using MomentRow = MipRowFilter::Row;

constexpr int kStripTexels = 1 << 18;

std::span<float, kMoments> moments_of(std::vector<float>& values, std::size_t x) {
  return std::span<float, kMoments>(values.data() + x * kMoments, kMoments);
}

MomentRow packed(const LobeRow& row, const FilterOptions& options) {
  MomentRow moments{row.y, std::vector<float>(row.texels.size() * kMoments)};
  for (std::size_t x = 0; x < row.texels.size(); ++x) {
    pack_moments(row.texels[x], options, moments_of(moments.values, x));
  }
  return moments;
}

LobeRow unpacked(const MomentRow& moments, const FilterOptions& options) {
  LobeRow row{moments.y, std::vector<LobeTexel>(moments.values.size() / kMoments)};
  for (std::size_t x = 0; x < row.texels.size(); ++x) {
    row.texels[x] = unpack_moments(
        std::span<const float, kMoments>(moments.values.data() + x * kMoments, kMoments), options);
  }
  return row;
}

/// The levels below the first: each takes moments from the one above.
class Pyramid {
 public:
  Pyramid(int width, int height, int levels, const ChainOptions& options, LobeSink& sink)
      : options_(options), sink_(sink) {
    for (int level = 1; level < levels; ++level) {
      filters_.emplace_back(width, height, kMoments, options.kernel, options.wrap_u, options.wrap_v);
      width = filters_.back().out_width();
      height = filters_.back().out_height();
    }
  }

  void push(std::vector<MomentRow> rows) {
    for (std::size_t i = 0; i < filters_.size() && !rows.empty(); ++i) {
      rows = filters_[i].push(rows);
      std::vector<LobeRow> texels(rows.size());
      parallel_for(static_cast<int>(rows.size()), [&](int r) {
        texels[static_cast<std::size_t>(r)] = unpacked(rows[static_cast<std::size_t>(r)], options_.filter);
      });
      if (!texels.empty()) sink_.write(static_cast<int>(i) + 1, texels);
    }
  }

 private:
  const ChainOptions& options_;
  LobeSink& sink_;
  std::vector<MipRowFilter> filters_;
};

}  // namespace

void filter_lobe_chain(LobeSource& source, LobeSink& sink, const ChainOptions& options,
                       const Progress& progress) {
  const int width = source.width();
  const int height = source.height();
  const int whole = mip_levels(width, height);
  Pyramid pyramid(width, height, options.levels > 0 ? std::min(options.levels, whole) : whole, options, sink);

  const int strip = std::clamp(kStripTexels / width, 8, height > 8 ? height : 8);
  std::vector<LobeTexel> next(static_cast<std::size_t>(std::min(strip, height)) *
                              static_cast<std::size_t>(width));
  source.read(next);
  for (int y = 0; y < height; y += strip) {
    const std::vector<LobeTexel> texels = std::move(next);
    const int count = std::min(strip, height - y);
    const int ahead = std::clamp(height - y - strip, 0, strip);
    next.assign(static_cast<std::size_t>(ahead) * static_cast<std::size_t>(width), {});
    // Files decode on one thread: the next strip is read while this one is filtered.
    parallel_for(2, [&](int task) {
      if (task == 0) {
        if (ahead > 0) source.read(next);
        return;
      }
      std::vector<LobeRow> rows(static_cast<std::size_t>(count));
      std::vector<MomentRow> moments(rows.size());
      parallel_for(count, [&](int r) {
        LobeRow& row = rows[static_cast<std::size_t>(r)];
        row.y = y + r;
        const auto first = texels.begin() + static_cast<std::ptrdiff_t>(r) * width;
        row.texels.assign(first, first + width);
        moments[static_cast<std::size_t>(r)] = packed(row, options.filter);
        if (options.filter.isotropic) {
          for (LobeTexel& texel : row.texels) texel.s = isotropic_matrix(texel.s);
        }
      });
      sink.write(0, rows);
      pyramid.push(std::move(moments));
    });
    report(progress, static_cast<double>(y + count) / height);
  }
}

}  // namespace sateen::texture
