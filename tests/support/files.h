// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

namespace sateen::test {

inline std::filesystem::path source_dir() {
  return SATEEN_SOURCE_DIR;
}
inline std::filesystem::path examples() {
  return source_dir() / "examples";
}

/// A folder of its own for one test, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "sateen-test-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~TemporaryFolder() {
    std::error_code code;
    std::filesystem::remove_all(path_, code);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// Writes a file as quickly as it goes; io::write_bytes waits for the disk, which counts when there are
/// thousands.
inline void put_bytes(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}
inline void put_text(const std::filesystem::path& path, std::string_view text) {
  put_bytes(path, std::as_bytes(std::span(text)));
}

struct ProgramResult {
  int exit_code = 0;
  std::string output;  ///< stdout and stderr together
};

/// Runs the command-line program through the shell, after the shell commands `before`.
inline ProgramResult run_program(const std::string& arguments, const std::string& before = "") {
  ProgramResult result;
  FILE* pipe = popen(fmt::format("{} {} {} 2>&1", before, SATEEN_PROGRAM, arguments).c_str(), "r");
  std::array<char, 4096> buffer{};
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    result.output.append(buffer.data(), n);
  const int status = pclose(pipe);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

}  // namespace sateen::test
