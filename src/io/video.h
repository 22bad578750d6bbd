// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>

#include "sateen/core/image.h"

namespace sateen::io {

/// Whether the extension is one that write_video takes: .mp4, .mov or .avi.
bool is_video_path(const std::filesystem::path& path);

/// Writes `count` pictures as a film: linear light in, sRGB 8 bit out, alpha ignored (associated colour on
/// black). `picture` is asked for each index in order; all must be of one even size. H.264 where the system's
/// encoder has it, else MPEG-4. Atomic. Throws Error for another extension, odd sizes and when the file
/// cannot be written.
void write_video(const std::filesystem::path& path, int count, double frames_per_second,
                 const std::function<Image(int)>& picture);

}  // namespace sateen::io
