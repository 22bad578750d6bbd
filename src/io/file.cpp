// SPDX-License-Identifier: MIT
#include "sateen/io/file.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <set>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "sateen/core/error.h"
#include "sateen/io/temporary.h"

namespace sateen::io {
namespace {

namespace fs = std::filesystem;

/// frame_2 before frame_10: runs of digits compare as numbers, everything else as characters.
bool natural_less(const std::string& a, const std::string& b) {
  std::size_t i = 0;
  std::size_t j = 0;
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  while (i < a.size() && j < b.size()) {
    if (digit(a[i]) && digit(b[j])) {
      const auto number = [&](const std::string& s, std::size_t& at) {
        while (at < s.size() && s[at] == '0') ++at;
        const std::size_t begin = at;
        while (at < s.size() && digit(s[at])) ++at;
        return s.substr(begin, at - begin);
      };
      const std::string x = number(a, i);
      const std::string y = number(b, j);
      if (x != y) return x.size() != y.size() ? x.size() < y.size() : x < y;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
    }
  }
  if ((i < a.size()) != (j < b.size())) return j < b.size();
  return a < b;
}

constexpr std::size_t kReadAhead = std::size_t{64} << 10;

/// Closes a file descriptor whichever way its scope is left.
struct Closer {
  int file;
  ~Closer() { close(file); }
};

[[noreturn]] void fail_errno(const char* verb, const fs::path& path) {
  throw Error(fmt::format("{}: cannot {}: {}", path.string(), verb, std::generic_category().message(errno)));
}

}  // namespace

namespace {

/// Where writing to `target` ends up: renaming over a link would replace the link and leave its file as it
/// was.
fs::path destination_of(const fs::path& target) {
  std::error_code code;
  return fs::is_symlink(target, code) ? fs::weakly_canonical(target, code) : target;
}

[[noreturn]] void fail_to_write(const fs::path& target, const std::string& why) {
  throw Error(fmt::format("{}: cannot be written: {}", target.string(), why));
}

void check_folder(const fs::path& target, const fs::path& folder) {
  std::error_code code;
  if (!fs::is_directory(folder, code))
    fail_to_write(target, fmt::format("the folder {} does not exist", folder.string()));
  if (access(folder.c_str(), W_OK | X_OK) != 0) fail_errno("write", target);
}

void check_writable(const fs::path& target) {
  const fs::path destination = destination_of(target);
  std::error_code code;
  check_folder(target, folder_of(destination));
  const fs::file_status there = fs::status(destination, code);
  if (fs::is_directory(there)) fail_to_write(target, "it is a folder");
  if (fs::exists(there) && !fs::is_regular_file(there))
    fail_to_write(target, "it is a device or pipe, a file is needed");
  constexpr auto kAnybodyWrites = fs::perms::owner_write | fs::perms::group_write | fs::perms::others_write;
  if (fs::exists(there) && (there.permissions() & kAnybodyWrites) == fs::perms::none)
    fail_to_write(target, "it is read-only");
}

/// Puts all in their places, or none; the first gets there last.
void take_places(std::vector<Temporary>& temporaries) {
  for (const Temporary& temporary : temporaries) temporary.flush();
  auto next = temporaries.rbegin();
  try {
    for (; next != temporaries.rend(); ++next) next->take_place();
  } catch (...) {
    for (auto done = temporaries.rbegin(); done != next; ++done) done->give_back();
    throw;
  }
}

}  // namespace

void check_writable(std::span<const fs::path> targets) {
  std::set<fs::path> seen;
  for (const fs::path& target : targets) {
    check_writable(target);
    std::error_code code;
    if (!seen.insert(fs::weakly_canonical(target, code)).second)
      throw Error(fmt::format("{}: would be written twice; give two names", target.string()));
  }
}

void check_writable_folder(const fs::path& folder) {
  std::error_code code;
  fs::path there = fs::absolute(folder, code);
  while (!fs::exists(there, code) && there.has_relative_path()) there = there.parent_path();
  if (!fs::is_directory(there, code))
    fail_to_write(folder, there.string() + " is a file, a folder is needed");
  check_folder(folder, there);
}

void make_folder(const fs::path& folder) {
  check_writable_folder(folder);
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) throw Error(fmt::format("{}: cannot be made: {}", folder.string(), code.message()));
}

void write_atomically(std::span<const fs::path> targets,
                      const std::function<void(std::span<const fs::path>)>& write) {
  check_writable(targets);
  std::vector<Temporary> temporaries;
  std::vector<fs::path> names;
  for (const fs::path& target : targets) {
    temporaries.emplace_back(destination_of(target), Temporary::Kind::file);
    names.push_back(temporaries.back().path());
  }
  write(names);
  take_places(temporaries);
}

void write_atomically(const fs::path& target, const std::function<void(const fs::path&)>& write) {
  write_atomically(std::span(&target, 1), [&](std::span<const fs::path> names) { write(names[0]); });
}

void write_folder_atomically(const fs::path& target, const std::function<void(const fs::path&)>& write,
                             const std::function<bool(const std::string&)>& is_part) {
  fs::path destination = destination_of(target);
  if (!destination.has_filename()) destination = destination.parent_path();  // "folder/"
  std::error_code code;
  if (fs::exists(destination, code) && !fs::is_directory(destination, code))
    fail_to_write(target, "it is a file, a folder is needed");
  make_folder(folder_of(destination));
  std::vector<Temporary> temporary;
  temporary.emplace_back(destination, Temporary::Kind::folder);
  const fs::path& made = temporary[0].path();
  write(made);
  for (const auto& entry : fs::directory_iterator(destination, code)) {
    const std::string name = entry.path().filename().string();
    if (is_part(name) || fs::exists(made / name, code)) continue;
    fs::create_hard_link(entry.path(), made / name, code);
    if (code)
      fail_to_write(target, fmt::format("the folder holds {}, which is no part of it; choose another", name));
  }
  take_places(temporary);
}

namespace {

/// Puts the bytes into a file called `temporary` that messages call `target`.
void put_bytes(const fs::path& temporary, const fs::path& target, std::span<const std::byte> bytes) {
  const int file = open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) fail_errno("write", target);
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::write(file, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int reason = errno;
      close(file);
      errno = reason;
      fail_errno("write", target);
    }
    done += static_cast<std::size_t>(n);
  }
  if (close(file) != 0) fail_errno("write", target);
}

}  // namespace

void write_bytes(const fs::path& target, std::span<const std::byte> bytes) {
  write_atomically(target, [&](const fs::path& temporary) { put_bytes(temporary, target, bytes); });
}

void write_bytes(std::span<const fs::path> targets, std::span<const std::vector<std::byte>> files) {
  write_atomically(targets, [&](std::span<const fs::path> temporaries) {
    for (std::size_t i = 0; i < targets.size(); ++i) put_bytes(temporaries[i], targets[i], files[i]);
  });
}

void write_text(const fs::path& target, const std::string& text) {
  write_texts(std::span(&target, 1), std::span(&text, 1));
}

void write_texts(std::span<const fs::path> targets, std::span<const std::string> texts) {
  write_atomically(targets, [&](std::span<const fs::path> temporaries) {
    for (std::size_t i = 0; i < targets.size(); ++i) {
      put_bytes(temporaries[i], targets[i], std::as_bytes(std::span(texts[i])));
    }
  });
}

std::vector<std::byte> read_bytes(const fs::path& path) {
  std::error_code code;
  if (!fs::exists(path, code)) throw Error(fmt::format("{}: no such file", path.string()));
  if (fs::is_directory(path, code))
    throw Error(fmt::format("{}: is a folder, a file is needed", path.string()));
  if (fs::is_character_file(path, code) || fs::is_block_file(path, code))
    throw Error(fmt::format("{}: is a device, a file is needed", path.string()));
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail_errno("read", path);
  const Closer closer{file};
  // A pipe or a file of /proc has no length to rely on: its bytes are taken as they come.
  const std::uintmax_t known = fs::is_regular_file(path, code) ? fs::file_size(path, code) : 0;
  std::vector<std::byte> bytes(code ? 0 : static_cast<std::size_t>(known) + 1);  // one more, to see the end
  std::size_t done = 0;
  while (true) {
    if (done == bytes.size()) bytes.resize(std::max(2 * done, kReadAhead));
    const ssize_t n = ::read(file, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail_errno("read", path);
    if (n == 0) break;
    done += static_cast<std::size_t>(n);
  }
  bytes.resize(done);
  return bytes;
}

std::string read_text(const fs::path& path) {
  const std::vector<std::byte> bytes = read_bytes(path);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::vector<fs::path> expand_inputs(const std::vector<fs::path>& inputs,
                                    std::span<const std::string> extensions) {
  std::vector<fs::path> files;
  for (const fs::path& input : inputs) {
    std::error_code code;
    if (!fs::exists(input, code)) throw Error(fmt::format("{}: no such file or folder", input.string()));
    if (!fs::is_directory(input, code)) {
      files.push_back(input);
      continue;
    }
    std::vector<fs::path> found;
    const fs::directory_iterator entries(input, code);
    if (code) throw Error(fmt::format("{}: cannot be read: {}", input.string(), code.message()));
    for (const auto& entry : entries) {
      const bool hidden = entry.path().filename().string().starts_with('.');
      if (!hidden && entry.is_regular_file(code) &&
          std::ranges::find(extensions, extension_of(entry.path())) != extensions.end()) {
        found.push_back(entry.path());
      }
    }
    if (found.empty()) {
      throw Error(fmt::format("{}: no files here end in {}", input.string(), fmt::join(extensions, ", ")));
    }
    std::ranges::sort(
        found, [](const fs::path& a, const fs::path& b) { return natural_less(a.string(), b.string()); });
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

std::string extension_of(const fs::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace sateen::io
