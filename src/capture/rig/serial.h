// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

namespace sateen::capture {

/// A serial line (or anything that looks like one to termios) in raw mode, read by lines.
class SerialLine {
 public:
  /// Throws Error naming the device when it is missing, not permitted or no serial line.
  SerialLine(const std::filesystem::path& device, int baud);
  ~SerialLine();
  SerialLine(const SerialLine&) = delete;
  SerialLine& operator=(const SerialLine&) = delete;

  /// Sends all of `text`. Throws Error when the device is gone.
  void send(const std::string& text);
  /// The next line without its end, waiting at most `timeout`; nothing when none became complete. Throws
  /// Error when the device is gone.
  std::optional<std::string> receive(std::chrono::milliseconds timeout);
  /// Forgets what has arrived and not been read.
  void clear();

 private:
  std::filesystem::path device_;
  int descriptor_ = -1;
  std::string pending_;
};

}  // namespace sateen::capture
