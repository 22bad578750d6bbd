// SPDX-License-Identifier: MIT
#include "sateen/io/picture_process.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sateen/io/file.h"
#include "sateen/io/file_error.h"
#include "sateen/io/file_stream.h"
#include "sateen/io/module.h"

extern char** environ;

namespace sateen::io {
namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

std::string mark_of(const fs::path& path) {
  std::string first(16, '\0');
  const PictureBytes bytes = open_picture_file(path);
  first.resize(std::fread(first.data(), 1, first.size(), bytes.stream.get()));
  return first;
}

/// OpenImageIO's name of a kind, and how its files begin.
struct MarkedKind {
  std::string_view name;
  std::string_view start;
  std::size_t at = 0;
};

constexpr MarkedKind kMarkedKinds[] = {
    {"gif", "GIF87a"},
    {"gif", "GIF89a"},
    {"bmp", "BM"},
    {"psd", "8BPS"},
    {"dpx", "SDPX"},
    {"dpx", "XPDS"},
    {"cineon", "\x80\x2a\x5f\xd7"},
    {"cineon", "\xd7\x5f\x2a\x80"},
    {"sgi", "\x01\xda"},
    {"dds", "DDS "},
    {"jpeg2000", "\0\0\0\x0cjP"sv},
    {"jpeg2000", "\xff\x4f\xff\x51"},
    {"ico", "\0\0\1\0"sv},
    {"fits", "SIMPLE"},
    {"heif", "ftyphei", 4},
    {"heif", "ftypmif1", 4},
    {"heif", "ftypmsf1", 4},
    {"heif", "ftypavif", 4},
    {"iff", "FOR4"},
    {"softimage", "\x53\x80\xf6\x34"},
    {"pnm", "P1"},
    {"pnm", "P2"},
    {"pnm", "P3"},
    {"pnm", "P4"},
    {"pnm", "P5"},
    {"pnm", "P6"},
    {"pnm", "Pf"},
    {"pnm", "PF"},
    // Those of the library's own kinds that it leaves to OpenImageIO.
    {"tiff", "II*\0"sv},
    {"tiff", "MM\0*"sv},
    {"tiff", "II+\0"sv},
    {"tiff", "MM\0+"sv},
    {"webp", "WEBP", 8},
    {"jpeg", "\xff\xd8\xff"},
    {"png", "\x89PNG"},
    {"openexr", "\x76\x2f\x31\x01"},
};

/// Kinds that only their extension tells.
struct UnmarkedKind {
  std::string_view name;
  std::string_view extension;
};
constexpr UnmarkedKind kUnmarkedKinds[] = {
    {"targa", ".tga"}, {"targa", ".tpic"}, {"rla", ".rla"}, {"zfile", ".zfile"}, {"raw", ".cr2"},
    {"raw", ".cr3"},   {"raw", ".nef"},    {"raw", ".arw"}, {"raw", ".dng"},     {"raw", ".orf"},
    {"raw", ".rw2"},   {"raw", ".raf"},    {"raw", ".pef"}, {"raw", ".srw"},     {"raw", ".crw"},
    {"raw", ".nrw"},   {"raw", ".sr2"},    {"raw", ".3fr"}, {"raw", ".erf"},     {"raw", ".iiq"},
    {"raw", ".mrw"},   {"raw", ".x3f"},    {"raw", ".kdc"}, {"raw", ".mef"},
};

/// The one decoder to ask; none of the others gets to see the file.
std::string kind_of(const fs::path& path) {
  const std::string first = mark_of(path);
  const std::string extension = extension_of(path);
  for (const UnmarkedKind& ending : kUnmarkedKinds) {
    if (ending.extension == extension) return std::string(ending.name);
  }
  for (const MarkedKind& kind : kMarkedKinds) {
    if (std::string_view(first).substr(std::min(kind.at, first.size())).starts_with(kind.start))
      return std::string(kind.name);
  }
  fail(path, "cannot be read as a picture: its first bytes are those of no known kind");
}

struct Pipe {
  std::array<int, 2> ends{-1, -1};
  Pipe() {
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw Error("no pipe can be made: too many files are open");
  }
  ~Pipe() {
    for (const int end : ends) {
      if (end >= 0) close(end);
    }
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int take(std::size_t end) { return std::exchange(ends[end], -1); }
};

/// The running program; ended with its scope.
class Process {
 public:
  Process(const fs::path& program, const fs::path& picture, std::string kind) {
    Pipe out;
    Pipe messages;
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&files, out.ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, messages.ends[1], kMessageFile);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none;  // our own signals may be left to a thread (file.h)
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    std::string name = program.string();
    std::string argument = picture.string();
    char* const arguments[] = {name.data(), argument.data(), kind.data(), nullptr};
    const int fault = posix_spawn(&id_, name.c_str(), &files, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    if (fault != 0) throw Error(fmt::format("{} cannot be started: {}", name, std::strerror(fault)));
    out_ = out.take(0);
    messages_ = messages.take(0);
  }
  ~Process() {
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
    close(out_);
    close(messages_);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Whether that many bytes came.
  bool read(void* to, std::size_t count) const { return read_from(out_, to, count) == count; }

  /// Why they did not.
  std::string message() const {
    std::string text(2000, '\0');
    text.resize(read_from(messages_, text.data(), text.size()));
    return text.empty() ? "its decoder failed, or needed more memory or time than it may take" : text;
  }

 private:
  static std::size_t read_from(int file, void* to, std::size_t count) {
    std::size_t done = 0;
    while (done < count) {
      const ssize_t n = ::read(file, static_cast<char*>(to) + done, count - done);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) break;
      done += static_cast<std::size_t>(n);
    }
    return done;
  }

  pid_t id_ = -1;
  int out_ = -1;
  int messages_ = -1;
};

class ProcessSource final : public PictureSource {
 public:
  ProcessSource(const fs::path& program, const fs::path& path, const std::string& kind)
      : path_(path), process_(program, path, kind) {
    PictureStart start;
    if (!process_.read(&start, sizeof start)) fail(path, process_.message());
    if (std::strncmp(start.version, SATEEN_VERSION, sizeof start.version) != 0)
      fail(path, fmt::format("cannot be read: {} is not of version " SATEEN_VERSION, program.string()));
    header_.width = start.width;
    header_.height = start.height;
    header_.channels = start.channels;
    header_.samples = static_cast<SampleType>(start.samples);
    header_.bits = start.bits;
    header_.floating = start.floating != 0;
    header_.alpha = start.alpha;
    header_.associated = start.associated != 0;
    header_.orientation = start.orientation;
    header_.window = {start.window[0], start.window[1], start.window[2], start.window[3]};
    constexpr std::uint32_t kLargestProfile = 64 << 20;
    if (start.icc_bytes > kLargestProfile) fail(path, "has a colour profile of absurd size");
    header_.colour.icc.resize(start.icc_bytes);
    if (!process_.read(header_.colour.icc.data(), start.icc_bytes)) fail(path, process_.message());
  }

  void read(int rows, void* out) override {
    if (!process_.read(out, header_.row_bytes() * static_cast<std::size_t>(rows)))
      fail(path_, process_.message());
  }

 private:
  fs::path path_;
  Process process_;
};

}  // namespace

std::unique_ptr<PictureSource> open_with_openimageio(const fs::path& path) {
  const std::string kind = kind_of(path);
  const fs::path program = module_program(
      "sateen-read-picture",
      fmt::format("{}: cannot be read as a picture: it is no PNG, JPEG, OpenEXR, Radiance HDR, WebP "
                  "or usual TIFF, and any other kind",
                  path.string()),
      kOpenImageIoPackages);
  return std::make_unique<ProcessSource>(program, path, kind);
}

}  // namespace sateen::io
