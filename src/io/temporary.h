// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace sateen::io {

/// The folder a file lies in, "." for a mere name.
std::filesystem::path folder_of(const std::filesystem::path& path);

/// A file or folder beside its target, hidden, that takes the target's name when it is whole and is removed
/// otherwise. While it lives its process holds a lock on it: what a killed process left is told by that and
/// removed by the next one that writes into the folder.
class Temporary {
 public:
  enum class Kind { file, folder };
  /// Made empty in the folder of `target`, with its extension. Throws Error when it cannot be.
  Temporary(const std::filesystem::path& target, Kind kind);
  ~Temporary();
  Temporary(Temporary&& other) noexcept;
  Temporary& operator=(Temporary&&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& target() const { return target_; }

  /// Brings what was written to the disk, with the permissions of an older target. Throws Error.
  void flush() const;
  /// Takes the target's name; an older target's content is here afterwards, and is removed with this, until
  /// give_back() exchanges them again. Throws Error.
  void take_place();
  void give_back() noexcept;

 private:
  std::filesystem::path target_;
  std::filesystem::path path_;
  Kind kind_;
  int file_ = -1;  ///< holds the lock
  bool holds_older_ = false;
  bool placed_ = false;
};

}  // namespace sateen::io
