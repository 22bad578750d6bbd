// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>

#include "sateen/core/image.h"

namespace sateen::io {

/// Whether the extension is one that write_video takes: .mp4, .mov or .avi.
bool is_video_path(const std::filesystem::path& path);

/// Writes `count` pictures as a film: linear light in, sRGB 8 bit out, alpha ignored (associated colour on
/// black). `picture` is asked for each index in order; all must be of one even size. H.264 where the system
/// has its encoder, else MPEG-4, tagged with BT.709's matrix and primaries and sRGB's transfer function. The
/// same pictures give the same bytes. Atomic. Throws Error for another extension, odd or different sizes, no
/// picture, and when the file cannot be written.
void write_video(const std::filesystem::path& path, int count, double frames_per_second,
                 const std::function<Image(int)>& picture);

}  // namespace sateen::io
