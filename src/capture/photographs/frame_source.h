// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sateen/capture/photographs/photograph.h"

namespace sateen::capture {

struct FrameSourceOptions {
  std::optional<Response> response;  ///< otherwise sRGB for 8- and 16-bit files, linear for EXR and HDR
  int max_frames = 1024;             ///< of a longer video or sequence every n-th frame is used
};

/// The pictures of a capture, from files or a video, decoded when they are needed and never all in memory.
class FrameSource {
 public:
  /// Photographs (files and folders, natural order) or one video. Photographs bracketed by exposure time
  /// (EXIF, the same few times over and over) are merged, each group one frame. Throws Error for missing
  /// files, a mix of photographs and video, pictures of different sizes.
  static FrameSource open(const std::vector<std::filesystem::path>& inputs,
                          const FrameSourceOptions& options);

  /// Of a video what its index promises, until it was visited once.
  int count() const { return count_; }
  /// Every how many frames of the files one is used.
  int stride() const { return stride_; }
  int width() const { return width_; }
  int height() const { return height_; }
  bool is_video() const { return video_; }
  /// The file's name, for a video with #frame behind it.
  std::string name(int index) const;
  const std::filesystem::path& path(int index) const;
  std::vector<std::string> warnings() const;

  /// Calls body(index, frame) for each of `indices` (ascending), from several threads at once, with only a
  /// few frames in memory at any time. Throws what decoding and `body` throw; an Error for a picture of
  /// another size.
  /// With `only` (not null, inside the picture) the body looks at nothing else: of photographs the rest may
  /// not be there.
  void visit(std::span<const int> indices, const std::function<void(int, const Photograph&)>& body,
             const PixelRect* only = nullptr);

  /// Frame `index` alone; of a video everything before it is decoded too.
  Photograph read(int index);

 private:
  Photograph decode(int index, io::Picture8 memory = {}, const PixelRect* only = nullptr) const;
  void spread(int frames);     // the used ones over all `frames` there are
  void found_end(int frames);  // of a video, after `frames`

  std::vector<std::filesystem::path> files_;
  std::vector<double> exposure_times_;  ///< of one bracketed group, seconds; one entry: no brackets
  bool video_ = false;
  int frames_ = 0;        // in the files; of a video not counted yet: promised
  bool counted_ = false;  // or known otherwise
  int stride_ = 1;
  int count_ = 0;
  int width_ = 0;
  int height_ = 0;
  FrameSourceOptions options_;
  Response response_;
  std::string damage_;
};

}  // namespace sateen::capture
