// SPDX-License-Identifier: MIT
#include "sateen/capture/rig/serial.h"

#include <array>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include "sateen/core/error.h"

namespace sateen::capture {
namespace {

speed_t speed_of(int baud) {
  switch (baud) {
    case 9600:
      return B9600;
    case 19200:
      return B19200;
    case 38400:
      return B38400;
    case 57600:
      return B57600;
    case 115200:
      return B115200;
    case 230400:
      return B230400;
    default:
      throw Error(fmt::format("{} baud is no usual speed; GRBL speaks 115200", baud));
  }
}

}  // namespace

SerialLine::SerialLine(const std::filesystem::path& device, int baud) : device_(device) {
  const speed_t speed = speed_of(baud);
  descriptor_ = open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) {
    throw Error(fmt::format("{}: cannot be opened: {}{}", device.string(), std::strerror(errno),
                            errno == EACCES ? " (is the user in the group dialout?)" : ""));
  }
  termios settings{};
  if (tcgetattr(descriptor_, &settings) != 0) {
    close(descriptor_);
    throw Error(fmt::format("{}: is no serial line", device.string()));
  }
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  cfsetispeed(&settings, speed);
  cfsetospeed(&settings, speed);
  tcsetattr(descriptor_, TCSANOW, &settings);
}

SerialLine::~SerialLine() {
  if (descriptor_ >= 0) close(descriptor_);
}

void SerialLine::send(const std::string& text) {
  std::size_t sent = 0;
  while (sent < text.size()) {
    pollfd wait{descriptor_, POLLOUT, 0};
    if (poll(&wait, 1, 5000) <= 0) throw Error(fmt::format("{}: takes no more data", device_.string()));
    const ssize_t n = write(descriptor_, text.data() + sent, text.size() - sent);
    if (n < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (n <= 0) throw Error(fmt::format("{}: connection lost", device_.string()));
    sent += static_cast<std::size_t>(n);
  }
}

std::optional<std::string> SerialLine::receive(std::chrono::milliseconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  for (;;) {
    const std::size_t end = pending_.find('\n');
    if (end != std::string::npos) {
      std::string line = pending_.substr(0, end);
      pending_.erase(0, end + 1);
      while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
      return line;
    }
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    if (left.count() < 0) return std::nullopt;
    pollfd wait{descriptor_, POLLIN, 0};
    const int ready = poll(&wait, 1, static_cast<int>(left.count()) + 1);
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) return std::nullopt;
    std::array<char, 256> buffer{};
    const ssize_t n = read(descriptor_, buffer.data(), buffer.size());
    if (n < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (n <= 0) throw Error(fmt::format("{}: connection lost", device_.string()));
    pending_.append(buffer.data(), static_cast<std::size_t>(n));
  }
}

void SerialLine::clear() {
  while (receive(std::chrono::milliseconds(0))) {
  }
  pending_.clear();
}

}  // namespace sateen::capture
