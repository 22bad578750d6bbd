// SPDX-License-Identifier: MIT
#include "sateen/amc/build.h"

#include <algorithm>
#include <atomic>
#include <mutex>

#include <fmt/format.h>

#include "sateen/amc/resample.h"
#include "sateen/core/direction.h"
#include "sateen/core/disc.h"
#include "sateen/core/error.h"
#include "sateen/core/parallel.h"
#include "sateen/io/image.h"

namespace sateen::amc {
namespace {

namespace fs = std::filesystem;

void check_square(const fs::path& file, const io::ImageInfo& info, const LoadFramesOptions& options) {
  if (options.crop || info.width == info.height) return;
  throw Error(
      fmt::format("{}: is {} x {} pixels; rectified frames are square and just hold the sphere. Give --crop "
                  "X,Y,SIZE, or use "
                  "'sateen capture build' for photographs",
                  file.string(), info.width, info.height));
}

}  // namespace

LoadedFrames load_frames(std::span<const fs::path> files, const LoadFramesOptions& options) {
  const int count = static_cast<int>(files.size());
  if (count < kMinFrames) {
    throw Error(
        fmt::format("{} frame{} given; an AMC needs the pictures of a full turn, {} at the very least", count,
                    count == 1 ? " was" : "s were", kMinFrames));
  }
  struct Loaded {
    Image image;
    int width = 0;
    int height = 0;
    bool floating = false;
    std::string error;
  };
  std::vector<Loaded> loaded(files.size());
  std::atomic<int> done{0};
  parallel_for(count, [&](int i) {
    Loaded& frame = loaded[static_cast<std::size_t>(i)];
    const fs::path& file = files[static_cast<std::size_t>(i)];
    try {
      const io::ImageInfo info = io::read_image_info(file);
      frame.floating = info.floating;
      frame.width = info.width;
      frame.height = info.height;
      check_square(file, info, options);
      Image image = io::read_image(file, {.region = options.crop});
      frame.image = with_channels(resized_disc(std::move(image), options.size), 3);
      // Ringing of the photograph's own filters can go below black; light cannot.
      for (float& v : frame.image.data) v = std::max(v, 0.0f);
    } catch (const Error& error) {
      frame.error = error.what();
    }
    report(options.progress, static_cast<double>(++done) / count);
  });

  LoadedFrames result;
  const Loaded* first = nullptr;
  for (int i = 0; i < count; ++i) {
    Loaded& frame = loaded[static_cast<std::size_t>(i)];
    if (frame.error.empty() && first == nullptr) first = &frame;
    if (frame.error.empty() && (frame.width != first->width || frame.height != first->height)) {
      frame.error = fmt::format("{}: is {} x {} pixels, the first frame is {} x {}",
                                files[static_cast<std::size_t>(i)].string(), frame.width, frame.height,
                                first->width, first->height);
    }
    if (!frame.error.empty()) {
      if (!options.skip_bad) throw Error(frame.error + " (--skip-bad leaves such frames out)");
      if (options.on_skipped) options.on_skipped(frame.error);
      ++result.skipped;
      continue;
    }
    const double turned = static_cast<double>(i) / count;
    result.floating = result.floating || frame.floating;
    result.frames.push_back(
        {std::move(frame.image), wrap(options.first_angle + (options.clockwise ? -turned : turned))});
  }
  if (static_cast<int>(result.frames.size()) < kMinFrames) {
    throw Error(fmt::format("only {} of {} frames can be read; an AMC needs {} at the very least",
                            result.frames.size(), count, kMinFrames));
  }
  std::ranges::sort(result.frames, {}, &AmcFrame::angle);
  return result;
}

AmcTable build_amc(std::span<const AmcFrame> frames, const SymmetryReport& report,
                   const BuildAmcOptions& options) {
  const int size = frames[0].image.width;
  AmcTable table(size, options.slices, options.symmetry.value_or(report.symmetry));
  table.isotropic = report.isotropic;
  table.encoding = options.encoding;
  std::vector<double> angles;
  for (const AmcFrame& frame : frames) angles.push_back(frame.angle);
  const double spacing = 1.0 / (table.symmetry * table.slices);

  parallel_for(table.slices, [&](int f) {
    Image slice(size, size, 3);
    for (int m = 0; m < table.symmetry; ++m) {
      const double angle = table.slice_angle(f) + static_cast<double>(m) / table.symmetry;
      for (const auto& [frame, weight] : cyclic_weights(angles, angle, spacing)) {
        const float share = static_cast<float>(weight / table.symmetry);
        const std::vector<float>& data = frames[static_cast<std::size_t>(frame)].image.data;
        for (std::size_t i = 0; i < data.size(); ++i) slice.data[i] += share * data[i];
      }
    }
    // The cubic can overshoot below black beside a highlight.
    for (float& v : slice.data) v = std::max(v, 0.0f);
    set_slice_image(table, f, slice);
  });
  quantise(table);
  return table;
}

}  // namespace sateen::amc
