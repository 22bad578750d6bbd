// SPDX-License-Identifier: MIT
#include "sateen/io/file_stream.h"

#include <cerrno>
#include <system_error>

#include "sateen/io/file_error.h"

namespace sateen::io {
namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail_errno(const std::string& name, const char* verb, int code) {
  fail(name, fmt::format("cannot be {}: {}", verb, std::generic_category().message(code)));
}

}  // namespace

PictureBytes open_picture_file(const fs::path& path) {
  std::error_code code;
  if (!fs::exists(path, code)) fail(path, "no such file");
  if (fs::is_directory(path, code)) fail(path, "is a folder, a picture is needed");
  if (!fs::is_regular_file(path, code)) fail(path, "is no regular file, a picture is needed");
  PictureBytes bytes{path.string(), FileStream(std::fopen(path.c_str(), "rbe")), fs::file_size(path, code)};
  if (!bytes.stream || code) fail_errno(bytes.name, "read", errno);
  return bytes;
}

PictureBytes open_picture_memory(std::span<const std::byte> bytes, const std::string& name) {
  if (bytes.empty()) fail(name, "is empty");
  PictureBytes opened{name, FileStream(fmemopen(const_cast<std::byte*>(bytes.data()), bytes.size(), "rb")),
                      bytes.size()};
  if (!opened.stream) fail_errno(name, "read", errno);
  return opened;
}

std::vector<std::byte> remaining_bytes(PictureBytes& bytes) {
  const long at = std::ftell(bytes.stream.get());
  std::vector<std::byte> all(static_cast<std::size_t>(bytes.count) - static_cast<std::size_t>(at));
  if (std::fread(all.data(), 1, all.size(), bytes.stream.get()) != all.size())
    fail_errno(bytes.name, "read", errno);
  return all;
}

FileStream create_file(const fs::path& path, const std::string& name) {
  FileStream file(std::fopen(path.c_str(), "w+be"));
  if (!file) fail_errno(name, "written", errno);
  return file;
}

void close_written(FileStream file, const std::string& name) {
  const bool failed_before = std::ferror(file.get()) != 0;
  errno = 0;
  if (std::fclose(file.release()) != 0 || failed_before) {
    fail_errno(name, "written", errno != 0 ? errno : ENOSPC);
  }
}

}  // namespace sateen::io
