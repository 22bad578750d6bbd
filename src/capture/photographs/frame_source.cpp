// SPDX-License-Identifier: MIT
#include "sateen/capture/photographs/frame_source.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <tbb/concurrent_queue.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include "sateen/capture/photographs/bracket.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "sateen/io/video_reader.h"

namespace sateen::capture {
namespace fs = std::filesystem;

namespace {

bool is_video_file(const fs::path& path) {
  const auto known = io::video_extensions();
  return std::ranges::find(known, io::extension_of(path)) != known.end();
}

/// A promise of fewer frames is sooner checked than believed: some containers do not say.
constexpr int kFewestPromised = 32;

int count_by_decoding(const fs::path& path) {
  io::VideoReader reader(path);
  int frames = 0;
  while (reader.skip()) ++frames;
  return frames;
}

}  // namespace

FrameSource FrameSource::open(const std::vector<fs::path>& inputs, const FrameSourceOptions& options) {
  FrameSource source;
  source.options_ = options;
  source.response_ = options.response.value_or(Response::srgb());
  if (inputs.empty()) throw Error("no photographs given; name a folder, files or a video");

  std::error_code code;
  if (inputs.size() == 1 && is_video_file(inputs[0]) && !fs::is_directory(inputs[0], code)) {
    const io::VideoReader reader(inputs[0]);
    source.video_ = true;
    source.files_ = inputs;
    source.width_ = reader.width();
    source.height_ = reader.height();
    source.counted_ = reader.promised_frames() < kFewestPromised;
    source.spread(source.counted_ ? count_by_decoding(inputs[0]) : reader.promised_frames());
    return source;
  }
  for (const fs::path& input : inputs) {
    if (is_video_file(input)) {
      throw Error(
          fmt::format("{}: a video has to be the only input, without other files beside it", input.string()));
    }
  }
  source.files_ = io::expand_inputs(inputs, io::image_extensions());
  const auto brackets = find_brackets(source.files_);
  source.exposure_times_ = brackets;
  const std::size_t group = std::max<std::size_t>(1, brackets.size());
  source.counted_ = true;
  source.spread(static_cast<int>(source.files_.size() / group));
  const Photograph first = source.decode(0);
  source.width_ = first.width();
  source.height_ = first.height();
  return source;
}

void FrameSource::spread(int frames) {
  frames_ = frames;
  stride_ = std::max(1, (frames + options_.max_frames - 1) / options_.max_frames);
  count_ = (frames + stride_ - 1) / stride_;
}

void FrameSource::found_end(int frames) {
  if (counted_) return;
  counted_ = true;
  // A promise that rounds a duration is a frame or two off.
  if (frames + 2 < frames_) {
    damage_ = fmt::format(
        "{}: promises {} frames, but only {} can be decoded: its end is damaged or its index is wrong",
        files_[0].filename().string(), frames_, frames);
  }
  spread(frames);
}

std::vector<std::string> FrameSource::warnings() const {
  std::vector<std::string> warnings;
  if (!damage_.empty()) warnings.push_back(damage_);
  if (stride_ > 1)
    warnings.push_back(fmt::format("of {} frames every {}th is used (--max-frames)", frames_, stride_));
  return warnings;
}

const fs::path& FrameSource::path(int index) const {
  if (video_) return files_[0];
  const std::size_t group = std::max<std::size_t>(1, exposure_times_.size());
  return files_[static_cast<std::size_t>(index * stride_) * group];
}

std::string FrameSource::name(int index) const {
  const std::string file = path(index).filename().string();
  return video_ ? fmt::format("{}#{}", file, index * stride_) : file;
}

Photograph FrameSource::decode(int index, io::Picture8 memory, const PixelRect* only) const {
  const auto one = [&](const fs::path& file) {
    const std::string extension = io::extension_of(file);
    const bool floats = extension == ".exr" || extension == ".hdr";
    const bool jpeg = extension == ".jpg" || extension == ".jpeg";
    if (jpeg || (!floats && io::read_image_info(file).bits == 8)) {
      only == nullptr ? io::read_picture8(file, memory) : io::read_picture8(file, *only, memory);
      return Photograph(std::exchange(memory, {}), response_);
    }
    Image image = with_channels(io::read_data(file), 3);
    if (!floats || options_.response) {
      for (float& v : image.data) v = response_(v);
    }
    return Photograph(std::move(image), floats ? std::numeric_limits<float>::infinity() : 0.995f);
  };
  if (exposure_times_.size() < 2) return one(path(index));
  std::vector<Photograph> group;
  for (std::size_t i = 0; i < exposure_times_.size(); ++i) {
    group.push_back(one(files_[static_cast<std::size_t>(index * stride_) * exposure_times_.size() + i]));
  }
  return merge_brackets(group, exposure_times_);
}

void FrameSource::visit(std::span<const int> indices, const std::function<void(int, const Photograph&)>& body,
                        const PixelRect* only) {
  struct Item {
    int index = 0;
    io::Picture8 picture;
  };
  std::optional<io::VideoReader> reader;
  if (video_) reader.emplace(files_[0]);
  std::size_t next = 0;
  int position = 0;                           // of the video's next frame
  tbb::concurrent_queue<io::Picture8> spare;  // memory of frames that are done
  const auto tokens = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()) + (video_ ? 1 : 0);

  // Not to be cancelled, without a word, by a loop around it (core/parallel.cpp).
  tbb::task_group_context alone(tbb::task_group_context::isolated);
  tbb::parallel_pipeline(
      tokens,
      tbb::make_filter<void, Item>(tbb::filter_mode::serial_in_order,
                                   [&](tbb::flow_control& control) {
                                     Item item;
                                     if (next >= indices.size()) {
                                       // Only the end of a video tells how long it is.
                                       while (reader && !counted_ && reader->skip()) ++position;
                                       found_end(position);
                                       control.stop();
                                       return item;
                                     }
                                     item.index = indices[next++];
                                     spare.try_pop(item.picture);
                                     if (!video_) return item;
                                     const int wanted = item.index * stride_;
                                     bool more = true;
                                     while (more && position < wanted) {
                                       more = reader->skip();
                                       position += more ? 1 : 0;
                                     }
                                     more = more && reader->next(item.picture);
                                     position += more ? 1 : 0;
                                     if (!more) {
                                       found_end(position);
                                       control.stop();
                                     }
                                     return item;
                                   }) &
          tbb::make_filter<Item, void>(
              tbb::filter_mode::parallel,
              [&](Item item) {
                Photograph frame = video_ ? Photograph(std::move(item.picture), response_)
                                          : decode(item.index, std::move(item.picture), only);
                if (frame.width() != width_ || frame.height() != height_) {
                  throw Error(
                      fmt::format("{}: is {} x {} pixels, the first frame is {} x {}; all must be alike",
                                  path(item.index).string(), frame.width(), frame.height(), width_, height_));
                }
                body(item.index, frame);
                spare.push(frame.take_codes());
              }),
      alone);
}

Photograph FrameSource::read(int index) {
  if (!video_) return decode(index);
  Photograph result;
  const std::array<int, 1> only{index};
  visit(only, [&](int, const Photograph& frame) { result = frame; });
  return result;
}

}  // namespace sateen::capture
