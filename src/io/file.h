// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace sateen::io {

/// Runs `write` on a temporary name beside `target` (same extension, same folder) and renames it to `target`
/// when `write` returned; on any exception the temporary file is removed and an older target stays as it was.
/// A symbolic link is followed. Throws Error when the folder does not exist or cannot be written, when
/// `target` is a folder, device or pipe, and what `write` throws.
void write_atomically(const std::filesystem::path& target,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// The same for files that belong together: none takes its name before all are written, and the first takes
/// it last.
void write_atomically(std::span<const std::filesystem::path> targets,
                      const std::function<void(std::span<const std::filesystem::path> temporaries)>& write);

/// write_atomically for bytes that are already there. Throws Error, for a full disk too.
void write_bytes(const std::filesystem::path& target, std::span<const std::byte> bytes);
/// The same for files that belong together: all appear, or none. One path a file.
void write_bytes(std::span<const std::filesystem::path> targets,
                 std::span<const std::vector<std::byte>> files);
void write_text(const std::filesystem::path& target, const std::string& text);

/// A whole file, or all that comes through a pipe. Throws Error when it is missing or cannot be read.
std::vector<std::byte> read_bytes(const std::filesystem::path& path);
std::string read_text(const std::filesystem::path& path);

/// The files a user means by `inputs`: a file stands for itself, a folder for the files in it whose extension
/// (lower case, with the dot) is among `extensions`, in natural order (frame_2 before frame_10).
/// Throws Error for a path that does not exist and for a folder without such files.
std::vector<std::filesystem::path> expand_inputs(const std::vector<std::filesystem::path>& inputs,
                                                 std::span<const std::string> extensions);

/// The extension in lower case with its dot, ".png"; empty if there is none.
std::string extension_of(const std::filesystem::path& path);

}  // namespace sateen::io
