// SPDX-License-Identifier: MIT
#include "sateen/texture/mip_rows.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include "sateen/core/error.h"
#include "sateen/core/parallel.h"

namespace sateen::texture {
namespace {

int wrapped(int i, int size, MipWrap wrap) {
  switch (wrap) {
    case MipWrap::repeat:
      return ((i % size) + size) % size;
    case MipWrap::mirror: {
      const int period = 2 * size;
      const int j = ((i % period) + period) % period;
      return j < size ? j : period - 1 - j;
    }
    case MipWrap::clamp:
      break;
  }
  return std::clamp(i, 0, size - 1);
}

/// Adds the taps of a row; `Channels` is `channels`, or 0 where the compiler does not know it.
template <std::size_t Channels>
void filter_across(const std::vector<MipTaps>& across, const std::vector<float>& row, std::size_t channels,
                   std::vector<float>& narrow) {
  const std::size_t count = Channels > 0 ? Channels : channels;
  float* out = narrow.data();
  for (const MipTaps& taps : across) {
    for (const MipTap& tap : taps) {
      const float* in = row.data() + static_cast<std::size_t>(tap.source) * count;
      for (std::size_t c = 0; c < count; ++c) out[c] += tap.weight * in[c];
    }
    out += count;
  }
}

double bessel_i0(double x) {
  double sum = 1;
  double term = 1;
  for (int k = 1; k < 40; ++k) {
    term *= (x / (2 * k)) * (x / (2 * k));
    sum += term;
  }
  return sum;
}

double kaiser_sinc(double x) {
  constexpr double kHalfWidth = 3;
  constexpr double kAlpha = 4;
  if (std::abs(x) >= kHalfWidth) return 0;
  const double t = x / kHalfWidth;
  const double window = bessel_i0(kAlpha * std::sqrt(1 - t * t)) / bessel_i0(kAlpha);
  const double px = std::numbers::pi * x;
  return window * (std::abs(px) < 1e-9 ? 1 : std::sin(px) / px);
}

}  // namespace

MipKernel mip_kernel_from_name(const std::string& name) {
  if (name == "box") return MipKernel::box;
  if (name == "kaiser") return MipKernel::kaiser;
  throw Error(fmt::format("unknown kernel {}: use box or kaiser", name));
}

MipWrap mip_wrap_from_name(const std::string& name) {
  if (name == "repeat") return MipWrap::repeat;
  if (name == "clamp") return MipWrap::clamp;
  if (name == "mirror") return MipWrap::mirror;
  throw Error(fmt::format("unknown wrap mode {}: use repeat, clamp or mirror", name));
}

int mip_levels(int width, int height) {
  int levels = 1;
  for (int size = std::max(width, height); size > 1; size /= 2) ++levels;
  return levels;
}

std::vector<int> mip_sizes(int size, int levels) {
  std::vector<int> sizes;
  for (int i = 0; i < levels; ++i) sizes.push_back(std::max(size >> i, 1));
  return sizes;
}

std::vector<MipTaps> mip_taps(int in, int out, MipKernel kernel, MipWrap wrap) {
  std::vector<MipTaps> all(static_cast<std::size_t>(out));
  const double ratio = static_cast<double>(in) / out;
  for (int y = 0; y < out; ++y) {
    std::map<int, double> weights;
    double total = 0;
    const auto add = [&](int i, double weight) {
      if (std::abs(weight) < 1e-9) return;
      weights[wrapped(i, in, wrap)] += weight;
      total += weight;
    };
    if (in == out) {
      add(y, 1);
    } else if (kernel == MipKernel::box) {
      const double begin = y * ratio;
      const double end = (y + 1) * ratio;
      for (int i = static_cast<int>(begin); i < in && i < end; ++i) {
        add(i, std::min<double>(end, i + 1) - std::max<double>(begin, i));
      }
    } else {
      const double centre = (y + 0.5) * ratio;
      const int reach = static_cast<int>(std::ceil(3 * ratio));
      for (int i = static_cast<int>(centre) - reach - 1; i <= static_cast<int>(centre) + reach + 1; ++i) {
        add(i, kaiser_sinc((i + 0.5 - centre) / ratio));
      }
    }
    for (const auto& [source, weight] : weights) {
      all[static_cast<std::size_t>(y)].push_back({source, static_cast<float>(weight / total)});
    }
  }
  return all;
}

MipRowFilter::MipRowFilter(int width, int height, int channels, MipKernel kernel, MipWrap wrap_u,
                           MipWrap wrap_v)
    : channels_(channels),
      across_(mip_taps(width, std::max(width / 2, 1), kernel, wrap_u)),
      down_(mip_taps(height, std::max(height / 2, 1), kernel, wrap_v)),
      users_(static_cast<std::size_t>(height)),
      narrow_(static_cast<std::size_t>(height)) {
  for (std::size_t y = 0; y < down_.size(); ++y) {
    missing_.push_back(static_cast<int>(down_[y].size()));
    for (const MipTap& tap : down_[y])
      users_[static_cast<std::size_t>(tap.source)].push_back(static_cast<int>(y));
  }
  for (const auto& users : users_) pending_.push_back(static_cast<int>(users.size()));
}

std::size_t MipRowFilter::held_values() const {
  std::size_t sum = 0;
  for (const auto& row : narrow_) sum += row.capacity();
  return sum;
}

std::vector<MipRowFilter::Row> MipRowFilter::push(const std::vector<Row>& rows) {
  const std::size_t channels = static_cast<std::size_t>(channels_);
  parallel_for(static_cast<int>(rows.size()), [&](int r) {
    const Row& row = rows[static_cast<std::size_t>(r)];
    std::vector<float>& narrow = narrow_[static_cast<std::size_t>(row.y)];
    narrow.assign(across_.size() * channels, 0);
    // The number of moments of a lobe, known to the compiler, is worth half the time.
    if (channels == 9) {
      filter_across<9>(across_, row.values, channels, narrow);
    } else {
      filter_across<0>(across_, row.values, channels, narrow);
    }
  });

  std::vector<Row> ready;
  for (const Row& row : rows) {
    for (const int user : users_[static_cast<std::size_t>(row.y)]) {
      if (--missing_[static_cast<std::size_t>(user)] == 0) ready.push_back({user, {}});
    }
  }
  std::ranges::sort(ready, {}, &Row::y);
  parallel_for(static_cast<int>(ready.size()), [&](int r) {
    Row& row = ready[static_cast<std::size_t>(r)];
    row.values.assign(across_.size() * channels, 0);
    for (const MipTap& tap : down_[static_cast<std::size_t>(row.y)]) {
      const std::vector<float>& in = narrow_[static_cast<std::size_t>(tap.source)];
      for (std::size_t i = 0; i < row.values.size(); ++i) row.values[i] += tap.weight * in[i];
    }
  });
  for (const Row& row : ready) {
    for (const MipTap& tap : down_[static_cast<std::size_t>(row.y)]) {
      if (--pending_[static_cast<std::size_t>(tap.source)] == 0) {
        // Assigning {} would keep the memory.
        std::vector<float>().swap(narrow_[static_cast<std::size_t>(tap.source)]);
      }
    }
  }
  return ready;
}

}  // namespace sateen::texture
