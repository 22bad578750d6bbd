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

/// Throws Error unless each target could be written: its folder is there and lets us write, it is no folder,
/// device or pipe, an older file is not read-only, and no two are the same. Ask before long work.
void check_writable(std::span<const std::filesystem::path> targets);
/// The same for a folder that is there or can be made.
void check_writable_folder(const std::filesystem::path& folder);
/// Makes a folder and those it lies in. Throws Error.
void make_folder(const std::filesystem::path& folder);

/// Runs `write` on a temporary name beside `target` (same extension, same folder); when it returned, the file
/// is brought to the disk and takes its name. On any exception the temporary file is removed and an older
/// target stays as it was; its permissions are kept. A symbolic link is followed. Throws Error as
/// check_writable, and what `write` throws.
void write_atomically(const std::filesystem::path& target,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// The same for files that belong together: none takes its name before all are written, and the first takes
/// it last.
void write_atomically(std::span<const std::filesystem::path> targets,
                      const std::function<void(std::span<const std::filesystem::path> temporaries)>& write);

/// The same for a folder whose files belong together; it is made if need be. Of an older folder the files for
/// which `is_part` is true go, all others stay. Throws Error when it holds folders, too.
void write_folder_atomically(const std::filesystem::path& target,
                             const std::function<void(const std::filesystem::path& temporary)>& write,
                             const std::function<bool(const std::string& name)>& is_part);

/// For programs, at their start, before any thread: on Ctrl-C, SIGTERM and SIGHUP temporary files are removed
/// before the process ends by that signal. What a killed process left is removed by the next that writes
/// into the same folder.
void remove_temporaries_on_signals();

/// write_atomically for bytes that are already there. Throws Error, for a full disk too.
void write_bytes(const std::filesystem::path& target, std::span<const std::byte> bytes);
/// The same for files that belong together: all appear, or none. One path a file.
void write_bytes(std::span<const std::filesystem::path> targets,
                 std::span<const std::vector<std::byte>> files);
void write_text(const std::filesystem::path& target, const std::string& text);
void write_texts(std::span<const std::filesystem::path> targets, std::span<const std::string> texts);

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
