// SPDX-License-Identifier: MIT
#include "sateen/capture/table/collect_stack.h"

#include <algorithm>
#include <atomic>

#include <fmt/format.h>

#include "sateen/capture/turning/used_frames.h"
#include "sateen/core/parallel.h"

namespace sateen::capture {
namespace {

Image preview_of(const Photograph& frame) {
  const int factor = (frame.width() + 959) / 960;
  Image preview(frame.width() / factor, frame.height() / factor, 3);
  parallel_for(preview.height, [&](int y) {
    for (int x = 0; x < preview.width; ++x) {
      Vec3f sum(0, 0, 0);
      for (int v = y * factor; v < (y + 1) * factor; ++v) {
        for (int u = x * factor; u < (x + 1) * factor; ++u) sum += frame.rgb(u, v);
      }
      preview.set_rgb(x, y, sum / static_cast<float>(factor * factor));
    }
  });
  return preview;
}

/// Adds the share of frames in which each texel is clipped to `result`.
void count_clipped(const RectifiedStack& stack, CaptureResult& result) {
  double clipped = 0;
  double samples = 0;
  result.clipped = Image(stack.size, stack.size, 1);
  const float share = 1 / static_cast<float>(std::max<std::size_t>(1, stack.frames.size()));
  for (const RectifiedFrame& frame : stack.frames) {
    for (std::size_t t = 0; t < frame.weight.size(); ++t) {
      samples += frame.weight[t] > 0 ? 1 : 0;
      if (frame.clipped[t] <= 127) continue;
      ++clipped;
      result.clipped.data[t] += share;
    }
  }
  result.clipped_share = samples > 0 ? clipped / samples : 0;
  if (result.clipped_share > 0.01) {
    result.warnings.push_back(
        fmt::format("{:.1f} % of the material is clipped: highlights will look flat. Expose shorter, or "
                    "bracket exposures",
                    100 * result.clipped_share));
  }
}

}  // namespace

RectifiedStack collect_stack(FrameSource& source, const FirstLook& look, const StillMask& still,
                             const CaptureOptions& options, const Progress& progress, CaptureResult& result) {
  // A bright background shines in further than a pixel: the lens blurs, JPEG rings.
  const double rim = 2.5 * look.factor;
  RectifyMap map(result.camera, result.sphere, options.size, options.frame, rim);
  map.hide(still);
  RectifiedStack stack;
  stack.size = options.size;
  stack.axis = result.axis;
  stack.frame = options.frame;
  for (int y = 0; y < options.size; ++y) {
    for (int x = 0; x < options.size; ++x) stack.points.push_back(map.point(x, y));
  }
  std::vector<int> indices;
  for (const std::size_t i : used_frames(result.frames)) indices.push_back(static_cast<int>(i));
  result.preview_frame = indices.front();
  result.preview = preview_of(source.read(result.preview_frame));
  std::vector<Vec2> centres;
  centres.reserve(indices.size());
  for (const int i : indices) centres.push_back(result.frames[static_cast<std::size_t>(i)].centre);
  const PixelRect sphere = map.region(centres, source.width(), source.height());
  std::vector<RectifiedFrame> frames(result.frames.size());
  std::atomic<int> done = 0;
  const auto take = [&](int index, const Photograph& frame) {
    const CaptureFrame& known = result.frames[static_cast<std::size_t>(index)];
    frames[static_cast<std::size_t>(index)] = rectify(map, frame, known.centre, known.gain);
    report(progress, static_cast<double>(++done) / static_cast<double>(indices.size()));
  };
  source.visit(indices, take, &sphere);
  const auto turned = [&](int i) { return result.frames[static_cast<std::size_t>(i)].turned; };
  std::ranges::sort(indices, {}, turned);
  for (const int i : indices) {
    RectifiedFrame& frame = frames[static_cast<std::size_t>(i)];
    if (frame.weight.empty()) continue;
    stack.frames.push_back(std::move(frame));
    stack.angles.push_back(turned(i));
  }
  count_clipped(stack, result);
  return stack;
}

}  // namespace sateen::capture
