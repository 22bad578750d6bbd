// SPDX-License-Identifier: MIT
#include "sateen/io/temporary.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "sateen/io/file.h"
#include "sateen/io/file_error.h"

namespace sateen::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = ".sateen-";

/// What this process has under way. Never destroyed: a signal may come while the program ends.
struct UnderWay {
  std::mutex mutex;
  std::set<fs::path> paths;
  std::set<fs::path> swept;  ///< folders
};
UnderWay& under_way() {
  static auto& all = *new UnderWay;
  return all;
}

[[noreturn]] void fail_errno(const fs::path& target, int reason) {
  fail(target, "cannot be written: " + std::generic_category().message(reason));
}

/// Removes what dead processes left in a folder: what nobody has locked.
void sweep(const fs::path& folder) {
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code)) {
    if (!entry.path().filename().string().starts_with(kPrefix)) continue;
    const int file = open(entry.path().c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (file < 0) continue;
    if (flock(file, LOCK_EX | LOCK_NB) == 0) fs::remove_all(entry.path(), code);
    close(file);
  }
}

/// A new file or folder, opened; the name is taken by nobody else.
int make_new(const fs::path& path, Temporary::Kind kind) {
  if (kind == Temporary::Kind::file) return open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (mkdir(path.c_str(), 0777) != 0) return -1;
  return open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
}

int exchange(const fs::path& a, const fs::path& b) {
#ifdef RENAME_EXCHANGE
  return renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE);
#else
  errno = ENOSYS;
  return -1;
#endif
}

}  // namespace

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

Temporary::Temporary(const fs::path& target, Kind kind) : target_(target), kind_(kind) {
  static std::atomic<unsigned> counter{0};
  const fs::path folder = folder_of(target);
  UnderWay& all = under_way();
  const std::lock_guard lock(all.mutex);
  if (all.swept.insert(fs::absolute(folder)).second) sweep(folder);
  while (true) {
    path_ = folder / fmt::format("{}{}-{}{}", kPrefix, getpid(), counter++, target.extension().string());
    // Known before it is there, so that no signal comes between.
    all.paths.insert(path_);
    file_ = make_new(path_, kind);
    if (file_ < 0) {
      all.paths.erase(path_);
      if (errno == EEXIST) continue;
      fail_errno(target, errno);
    }
    // Another process may have taken it for a dead one's before it was locked.
    struct stat state {};
    if (flock(file_, LOCK_EX) != 0 || (fstat(file_, &state) == 0 && state.st_nlink > 0)) return;
    close(file_);
    all.paths.erase(path_);
  }
}

Temporary::Temporary(Temporary&& other) noexcept
    : target_(std::move(other.target_)),
      path_(std::move(other.path_)),
      kind_(other.kind_),
      file_(std::exchange(other.file_, -1)),
      holds_older_(other.holds_older_),
      placed_(other.placed_) {}

Temporary::~Temporary() {
  if (file_ < 0) return;
  std::error_code code;
  if (!placed_ || holds_older_) fs::remove_all(path_, code);
  close(file_);
  UnderWay& all = under_way();
  const std::lock_guard lock(all.mutex);
  all.paths.erase(path_);
}

void Temporary::flush() const {
  // By name: whoever wrote it may have made it anew.
  const int file = open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail_errno(target_, errno);
  struct stat older {};
  const bool mode_kept = stat(target_.c_str(), &older) != 0 || fchmod(file, older.st_mode & 07777) == 0;
  const bool fine = mode_kept && (fsync(file) == 0 || errno == EINVAL);
  const int reason = errno;
  close(file);
  if (!fine) fail_errno(target_, reason);
}

void Temporary::take_place() {
  std::error_code code;
  const bool older = fs::exists(target_, code);
  const bool older_folder = fs::is_directory(target_, code);
  // Both can be exchanged, but what went would be gone.
  if (older && older_folder != (kind_ == Kind::folder)) fail_errno(target_, older_folder ? EISDIR : ENOTDIR);
  if (older && exchange(path_, target_) == 0) {
    holds_older_ = true;
  } else if (older_folder) {
    // File systems that cannot exchange names: for a moment there is no folder.
    Temporary aside(target_, Kind::folder);
    if (std::rename(target_.c_str(), aside.path_.c_str()) != 0) fail_errno(target_, errno);
    if (std::rename(path_.c_str(), target_.c_str()) != 0) {
      const int reason = errno;
      std::rename(aside.path_.c_str(), target_.c_str());
      fail_errno(target_, reason);
    }
  } else if (std::rename(path_.c_str(), target_.c_str()) != 0) {
    fail_errno(target_, errno);
  }
  placed_ = true;
  const int folder = open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  fsync(folder);
  close(folder);
}

void Temporary::give_back() noexcept {
  if (!placed_) return;
  if (holds_older_ ? exchange(path_, target_) == 0 : std::rename(target_.c_str(), path_.c_str()) == 0) {
    holds_older_ = placed_ = false;
  }
}

void remove_temporaries_on_signals() {
  sigset_t ending;
  sigemptyset(&ending);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction now {};
    sigaction(number, nullptr, &now);
    if (now.sa_handler == SIG_DFL) sigaddset(&ending, number);
  }
  // Every thread made from here on leaves them to this one, which may do what a handler must not.
  pthread_sigmask(SIG_BLOCK, &ending, nullptr);
  std::thread([ending] {
    int number = 0;
    if (sigwait(&ending, &number) != 0) return;
    UnderWay& all = under_way();
    const std::lock_guard lock(all.mutex);  // until the end: nothing new is begun
    std::error_code code;
    for (int pass = 0; pass < 2; ++pass) {
      for (const fs::path& path : all.paths) {
        // By another name first: other threads are still writing into it.
        const fs::path gone = path.string() + "-gone";
        fs::rename(path, gone, code);
        fs::remove_all(gone, code);
      }
    }
    std::signal(number, SIG_DFL);
    pthread_sigmask(SIG_UNBLOCK, &ending, nullptr);
    kill(getpid(), number);
    pause();
  }).detach();
}

}  // namespace sateen::io
