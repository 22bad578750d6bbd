// SPDX-License-Identifier: MIT
#include "sateen/capture/table/collect_stack.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace sateen::capture {

RectifiedStack collect_stack(FrameSource& source, const RectifyMap& map, std::span<const CaptureFrame> frames,
                             const Vec3& axis, const Progress& progress) {
  const auto frame_of = [&](int i) -> const CaptureFrame& { return frames[static_cast<std::size_t>(i)]; };
  std::vector<int> indices;
  std::vector<Vec2> centres;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!frames[i].used()) continue;
    indices.push_back(static_cast<int>(i));
    centres.push_back(frames[i].centre);
  }
  const PixelRect sphere = map.region(centres, source.width(), source.height());
  std::vector<RectifiedFrame> rectified(frames.size());
  std::atomic<int> done = 0;
  const auto take = [&](int index, const Photograph& photograph) {
    const CaptureFrame& known = frame_of(index);
    rectified[static_cast<std::size_t>(index)] = rectify(map, photograph, known.centre, known.gain);
    report(progress, static_cast<double>(++done) / static_cast<double>(indices.size()));
  };
  source.visit(indices, take, &sphere);

  RectifiedStack stack;
  stack.size = map.size();
  stack.axis = axis;
  stack.frame = map.frame();
  stack.points = map.points();
  std::ranges::sort(indices, {}, [&](int i) { return frame_of(i).turned; });
  for (const int i : indices) {
    RectifiedFrame& frame = rectified[static_cast<std::size_t>(i)];
    if (frame.weight.empty()) continue;
    stack.frames.push_back(std::move(frame));
    stack.angles.push_back(frame_of(i).turned);
  }
  return stack;
}

}  // namespace sateen::capture
