// SPDX-License-Identifier: MIT
#include "sateen/capture/table/fill_unseen.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "sateen/core/direction.h"
#include "sateen/core/parallel.h"

namespace sateen::capture {
namespace {

bool on_disc(std::size_t texel, int size) {
  const auto i = static_cast<int>(texel);
  return disc_of_pixel(i % size, i / size, size).norm() < 1;
}

/// A texel and those around it of which it becomes the weighted mean.
struct Mean {
  std::uint32_t texel = 0;
  std::uint32_t count = 0;
  std::array<std::uint32_t, 8> around{};
  std::array<float, 8> weight{};  // they add up to 1

  void add(std::size_t neighbour, float w) {
    around[count] = static_cast<std::uint32_t>(neighbour);
    weight[count++] = w;
  }
  void normalise() {
    float sum = 0;
    for (std::uint32_t i = 0; i < count; ++i) sum += weight[i];
    for (std::uint32_t i = 0; i < count; ++i) weight[i] /= sum;
  }
  /// 1 for `step` replaces the texel, above 1 goes beyond.
  void apply(float* rgb, float step) const {
    std::array<float, 3> mean{};
    for (std::uint32_t i = 0; i < count; ++i) {
      const float* other = rgb + std::size_t{3} * around[i];
      for (std::size_t c = 0; c < 3; ++c) mean[c] += weight[i] * other[c];
    }
    float* own = rgb + std::size_t{3} * texel;
    for (std::size_t c = 0; c < 3; ++c) own[c] += step * (mean[c] - own[c]);
  }
};

/// Calls body(index, weight) for the up to eight neighbours of a texel; those across a corner weigh less.
template <class Body>
void for_neighbours(int size, std::size_t index, const Body& body) {
  const int x = static_cast<int>(index) % size;
  const int y = static_cast<int>(index) / size;
  for (int v = std::max(0, y - 1); v <= std::min(size - 1, y + 1); ++v) {
    for (int u = std::max(0, x - 1); u <= std::min(size - 1, x + 1); ++u) {
      if (u != x || v != y) body(pixel_index(u, v, size), u != x && v != y ? 0.7f : 1.0f);
    }
  }
}

/// Grows known texels over unknown ones, ring by ring, each the mean of its known neighbours: in this order.
std::vector<Mean> growth(int size, std::vector<std::uint8_t> known) {
  constexpr std::uint8_t kWaiting = 255;  // unknown, but next in turn
  std::vector<Mean> order;
  std::vector<std::size_t> ring;
  const auto queue_unknown_around = [&](std::size_t i, std::vector<std::size_t>& queue) {
    for_neighbours(size, i, [&](std::size_t j, float) {
      if (known[j] != 0) return;
      known[j] = kWaiting;
      queue.push_back(j);
    });
  };
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i] != 0 && known[i] != kWaiting) queue_unknown_around(i, ring);
  }
  std::vector<std::size_t> next;
  while (!ring.empty()) {
    next.clear();
    for (const std::size_t i : ring) {
      Mean& mean = order.emplace_back();
      mean.texel = static_cast<std::uint32_t>(i);
      for_neighbours(size, i, [&](std::size_t j, float w) {
        if (known[j] != 0 && known[j] != kWaiting) mean.add(j, w);
      });
      mean.normalise();
    }
    for (const std::size_t i : ring) known[i] = 1;
    for (const std::size_t i : ring) queue_unknown_around(i, next);
    ring.swap(next);
  }
  return order;
}

/// How the unseen texels of all slices that were seen alike are filled.
class Filling {
 public:
  Filling(int size, std::span<const std::uint8_t> seen) {
    std::vector<std::uint8_t> known(seen.begin(), seen.end());
    inwards_ = growth(size, known);
    for (std::size_t i = 0; i < known.size(); ++i) {
      if (known[i] != 0 || !on_disc(i, size)) continue;
      Mean& mean = smooth_.emplace_back();
      mean.texel = static_cast<std::uint32_t>(i);
      for_neighbours(size, i, [&](std::size_t j, float w) {
        if (w == 1 && on_disc(j, size)) mean.add(j, w);
      });
      mean.normalise();
    }
    for (const Mean& mean : smooth_) known[mean.texel] = 1;
    outwards_ = growth(size, std::move(known));
  }

  void apply(float* rgb) const {
    for (const Mean& mean : inwards_) mean.apply(rgb, 1);
    // Each texel of the disc the mean of its neighbours there: Laplace's equation, by Gauss-Seidel with
    // over-relaxation.
    for (int round = 0; round < 60; ++round) {
      for (const Mean& mean : smooth_) mean.apply(rgb, round < 56 ? 1.6f : 1.0f);
    }
    for (const Mean& mean : outwards_) mean.apply(rgb, 1);
  }

 private:
  std::vector<Mean> inwards_;
  std::vector<Mean> smooth_;
  std::vector<Mean> outwards_;
};

}  // namespace

void fill_unseen(std::vector<Image>& slices, const std::vector<std::uint8_t>& seen) {
  constexpr int kRun = 8;  // slices one after the other, which mostly are seen alike
  const auto count = static_cast<int>(slices.size());
  parallel_for((count + kRun - 1) / kRun, [&](int run) {
    std::span<const std::uint8_t> last;
    std::optional<Filling> filling;
    for (int i = run * kRun; i < std::min(count, (run + 1) * kRun); ++i) {
      Image& slice = slices[static_cast<std::size_t>(i)];
      const std::size_t texels = slice.data.size() / 3;
      const std::span<const std::uint8_t> here(&seen[static_cast<std::size_t>(i) * texels], texels);
      const bool alike =
          std::ranges::equal(here, last, [](std::uint8_t a, std::uint8_t b) { return (a != 0) == (b != 0); });
      if (!alike) filling.emplace(slice.width, here);
      last = here;
      filling->apply(slice.data.data());
    }
  });
}

}  // namespace sateen::capture
