// SPDX-License-Identifier: MIT
#include "sateen/capture/table/make_table.h"

#include <algorithm>
#include <utility>

#include "sateen/capture/table/assemble.h"
#include "sateen/core/parallel.h"

namespace sateen::capture {
namespace {

constexpr int kSymmetrySlices = 48;  // divisible by 2, 3 and 4
constexpr int kSymmetrySize = 64;    // texels across that tell symmetry as well as more would

/// What a seam hid says nothing about symmetry: there the slice half a turn on stands in, which for R = 2
/// and 4 is as good as leaving it out.
void take_unseen_from_opposite(AssembledSlices& whole, int size) {
  const auto texels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  const std::vector<Image> original = whole.slices;
  for (std::size_t k = 0; k < original.size(); ++k) {
    const std::size_t opposite = (k + original.size() / 2) % original.size();
    for (std::size_t i = 0; i < texels; ++i) {
      if (whole.seen[k * texels + i] == 1 || whole.seen[opposite * texels + i] != 1) continue;
      const int x = static_cast<int>(i) % size;
      const int y = static_cast<int>(i) / size;
      whole.slices[k].set_rgb(x, y, original[opposite].rgb(x, y));
    }
  }
}

/// Every `step`-th texel of every `step`-th row: each still has its own point and samples.
RectifiedStack thinned(const RectifiedStack& stack, int step) {
  RectifiedStack thin{stack.size / step, stack.axis, stack.frame, {}, {}, stack.angles};
  std::vector<std::size_t> kept;
  for (int y = 0; y < thin.size; ++y) {
    for (int x = 0; x < thin.size; ++x) kept.push_back(static_cast<std::size_t>((y * stack.size + x) * step));
  }
  for (const std::size_t i : kept) thin.points.push_back(stack.points[i]);
  for (const RectifiedFrame& frame : stack.frames) {
    RectifiedFrame& copy = thin.frames.emplace_back();
    copy.size = thin.size;
    for (const std::size_t i : kept) {
      copy.rgb.insert(copy.rgb.end(), frame.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i),
                      frame.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
      copy.weight.push_back(frame.weight[i]);
    }
  }
  return thin;
}

amc::SymmetryReport symmetry_of(const RectifiedStack& all, const SurfaceMask& mask, double first_angle,
                                double threshold) {
  const RectifiedStack stack = thinned(all, std::max(1, all.size / kSymmetrySize));
  AssembledSlices whole = assemble(stack, mask, first_angle, kSymmetrySlices, 1);
  take_unseen_from_opposite(whole, stack.size);
  std::vector<amc::AmcFrame> frames;
  for (int i = 0; i < kSymmetrySlices; ++i) {
    frames.push_back({whole.slices[static_cast<std::size_t>(i)], static_cast<double>(i) / kSymmetrySlices});
  }
  return amc::analyse_symmetry(frames, threshold);
}

}  // namespace

CaptureTable make_table(const RectifiedStack& stack, const SurfaceMask& mask, double first_angle,
                        const TableOptions& options) {
  CaptureTable made;
  made.symmetry = symmetry_of(stack, mask, first_angle, options.symmetry_threshold);
  const int symmetry = options.symmetry.value_or(made.symmetry.symmetry);
  AssembledSlices slices = assemble(stack, mask, first_angle, options.slices, symmetry);
  made.amc = amc::AmcTable(options.size, options.slices, symmetry);
  made.amc.encoding = options.encoding;
  made.amc.isotropic = !options.symmetry && made.symmetry.isotropic;
  parallel_for(options.slices,
               [&](int i) { amc::set_slice_image(made.amc, i, slices.slices[static_cast<std::size_t>(i)]); });
  amc::quantise(made.amc);
  made.seen_share = slices.seen_share;
  made.seen = std::move(slices.seen);
  return made;
}

}  // namespace sateen::capture
