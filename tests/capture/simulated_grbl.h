// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>
#include <unistd.h>

namespace sateen::test {

/// A GRBL 1.1 controller at the other end of a pseudo-terminal, with faults on demand.
class SimulatedGrbl {
 public:
  std::atomic<bool> silent{false};
  std::atomic<bool> slow{false};  // answers byte by byte
  std::atomic<int> alarms{0};     // raised at the next moves
  std::atomic<int> alarms_on_position{0};
  std::atomic<bool> restart_on_move{false};
  std::atomic<bool> never_idle{false};
  std::atomic<bool> refuse{false};
  std::atomic<double> position{0};
  std::atomic<int> moves{0};

  SimulatedGrbl() : master_(posix_openpt(O_RDWR | O_NOCTTY)) {
    grantpt(master_);
    unlockpt(master_);
    device_ = ptsname(master_);
    keep_open_ = open(device_.c_str(), O_RDWR | O_NOCTTY);
    thread_ = std::thread([this] { run(); });
  }
  ~SimulatedGrbl() {
    stop_ = true;
    thread_.join();
    close(keep_open_);
    close(master_);
  }
  const std::string& device() const { return device_; }

 private:
  void say(const std::string& text) {
    if (silent) return;
    if (!slow) {
      EXPECT_EQ(write(master_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
      return;
    }
    for (const char c : text) {
      EXPECT_EQ(write(master_, &c, 1), 1);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  void line(const std::string& text) {
    if (text.starts_with("G1")) {
      if (refuse) return say("error:9\r\n");
      if (alarms > 0) {
        --alarms;
        return say("ALARM:1\r\n");
      }
      if (restart_on_move) return say("\r\nGrbl 1.1h ['$' for help]\r\n");
      position = std::stod(text.substr(4));
      ++moves;
      running_ = 2;
    }
    if (text.starts_with("G92") && alarms_on_position > 0) {
      --alarms_on_position;
      return say("ALARM:3\r\n");
    }
    if (text.starts_with("G92")) position = std::stod(text.substr(5));
    if (text == "$X") say("[MSG:Caution: Unlocked]\r\n");
    say("ok\r\n");
  }

  void run() {
    std::string pending;
    while (!stop_) {
      pollfd wait{master_, POLLIN, 0};
      if (poll(&wait, 1, 10) <= 0) continue;
      std::array<char, 64> buffer{};
      const ssize_t n = read(master_, buffer.data(), buffer.size());
      for (ssize_t i = 0; i < n; ++i) {
        const char c = buffer[static_cast<std::size_t>(i)];
        if (c == '\x18') {
          pending.clear();
          say("\r\nGrbl 1.1h ['$' for help]\r\n");
        } else if (c == '?') {
          const bool busy = never_idle || running_ > 0;
          if (running_ > 0) --running_;
          say(busy ? "<Run|MPos:1.000,0.000,0.000|FS:0,0>\r\n" : "<Idle|MPos:1.000,0.000,0.000|FS:0,0>\r\n");
        } else if (c == '\n') {
          line(pending);
          pending.clear();
        } else if (c != '\r') {
          pending += c;
        }
      }
    }
  }

  int master_;
  int keep_open_ = -1;
  int running_ = 0;
  std::string device_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace sateen::test
