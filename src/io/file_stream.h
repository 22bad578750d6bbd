// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace sateen::io {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
/// A C stream, which every picture library takes; closed with its scope.
using FileStream = std::unique_ptr<std::FILE, CloseFile>;

/// The bytes of a picture: a file on disk or a span of memory.
struct PictureBytes {
  std::string name;          ///< what messages call it
  FileStream stream;         ///< at its first byte
  std::uintmax_t count = 0;  ///< how many there are
};

/// Throws Error when there is no such file, or it is a folder, pipe or device.
PictureBytes open_picture_file(const std::filesystem::path& path);

/// Memory as a file; it must stay where it is for as long as it is read.
PictureBytes open_picture_memory(std::span<const std::byte> bytes, const std::string& name);

/// All bytes from where the stream stands. Throws Error when they cannot be read.
std::vector<std::byte> remaining_bytes(PictureBytes& bytes);

/// A file made anew for writing. Throws Error, which calls it `name`, when it cannot be.
FileStream create_file(const std::filesystem::path& path, const std::string& name);

/// Closes a file that was written. Throws Error when a byte did not reach the disk.
void close_written(FileStream file, const std::string& name);

}  // namespace sateen::io
