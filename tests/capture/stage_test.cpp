// SPDX-License-Identifier: MIT
#include "sateen/capture/stage.h"

#include <atomic>
#include <cmath>
#include <csignal>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

#include "sateen/capture/live.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "support/files.h"

namespace sateen {
namespace {

using std::chrono::milliseconds;

/// A GRBL 1.1 controller at the other end of a pseudo-terminal, with faults on demand.
class SimulatedGrbl {
 public:
  std::atomic<bool> silent{false};
  std::atomic<bool> slow{false};  // answers byte by byte
  std::atomic<int> alarms{0};     // raised at the next moves
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
      std::this_thread::sleep_for(milliseconds(1));
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
    if (text.starts_with("G92")) position = std::stod(text.substr(5));
    if (text == "$X") say("[MSG:Caution: Unlocked]\r\n");
    say("ok\r\n");
  }

  void run() {
    std::string pending;
    while (!stop_) {
      pollfd wait{master_, POLLIN, 0};
      if (poll(&wait, 1, 10) <= 0) continue;
      char buffer[64];
      const ssize_t n = read(master_, buffer, sizeof buffer);
      for (ssize_t i = 0; i < n; ++i) {
        const char c = buffer[i];
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

GrblOptions quick() {
  GrblOptions options;
  options.answer_timeout = milliseconds(600);
  options.move_timeout = milliseconds(900);
  options.settle = milliseconds(0);
  return options;
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(GrblStage, MovesAndWaitsUntilItStands) {
  SimulatedGrbl grbl;
  GrblOptions options = quick();
  options.units_per_turn = 8;
  const auto stage = open_grbl_stage(grbl.device(), options);
  stage->move_to(90);
  EXPECT_NEAR(grbl.position, 2, 1e-9);
  options.reverse = true;
  open_grbl_stage(grbl.device(), options)->move_to(45);
  EXPECT_NEAR(grbl.position, -1, 1e-9);
}

TEST(GrblStage, TakesAnswersInPieces) {
  SimulatedGrbl grbl;
  grbl.slow = true;
  open_grbl_stage(grbl.device(), quick())->move_to(10);
  EXPECT_EQ(grbl.moves, 1);
}

TEST(GrblStage, UnlocksOneAlarmAndTellsOfTheNext) {
  SimulatedGrbl grbl;
  const auto stage = open_grbl_stage(grbl.device(), quick());
  grbl.alarms = 1;
  stage->move_to(10);
  EXPECT_EQ(grbl.moves, 1);
  grbl.alarms = 2;
  EXPECT_THAT(message_of([&] { stage->move_to(20); }), testing::HasSubstr("ALARM:1"));
}

TEST(GrblStage, TellsOfRestartsRefusalsAndStandstill) {
  SimulatedGrbl grbl;
  const auto stage = open_grbl_stage(grbl.device(), quick());
  grbl.restart_on_move = true;
  EXPECT_THAT(message_of([&] { stage->move_to(20); }), testing::HasSubstr("restarted"));
  grbl.restart_on_move = false;
  grbl.refuse = true;
  EXPECT_THAT(message_of([&] { stage->move_to(20); }), testing::HasSubstr("error:9"));
  grbl.refuse = false;
  grbl.never_idle = true;
  EXPECT_THAT(message_of([&] { stage->move_to(20); }), testing::HasSubstr("come to rest"));
  grbl.silent = true;
  EXPECT_THAT(message_of([&] { stage->move_to(20); }), testing::HasSubstr("does not answer"));
}

TEST(GrblStage, TellsWhenNothingOrNoneOfItsKindIsThere) {
  EXPECT_THROW(open_grbl_stage("/dev/no-such-line", quick()), Error);
  SimulatedGrbl grbl;
  grbl.silent = true;
  EXPECT_THAT(message_of([&] { open_grbl_stage(grbl.device(), quick()); }),
              testing::HasSubstr("greets as GRBL"));
}

/// Pictures of one grey; gives up after some.
class CountingCamera final : public LiveCamera {
 public:
  explicit CountingCamera(int good) : good_(good) {}
  Picture8 shoot() override {
    if (good_-- <= 0) throw Error("unplugged");
    return {4, 3, std::vector<std::uint8_t>(36, 100)};
  }

 private:
  int good_;
};

TEST(CaptureLive, ResumesWithoutLosingFrames) {
  const test::TemporaryFolder folder;
  LiveOptions options;
  options.folder = folder / "shots";
  options.frames = 12;
  SimulatedGrbl grbl;
  const auto stage = open_grbl_stage(grbl.device(), quick());
  CountingCamera failing(5);
  EXPECT_THROW(capture_live(*stage, failing, options), Error);
  CountingCamera camera(100);
  const auto again = open_grbl_stage(grbl.device(), quick());
  const LiveResult result = capture_live(*again, camera, options);
  EXPECT_EQ(result.found, 5);
  EXPECT_EQ(result.taken, 7);
  EXPECT_TRUE(result.angles_known);
  EXPECT_NEAR(grbl.position, 330, 1e-9);
  const std::vector<std::string> extensions{".png"};
  EXPECT_EQ(expand_inputs({options.folder}, extensions).size(), 12);
  options.frames = 16;
  EXPECT_THROW(capture_live(*again, camera, options), Error);
}

TEST(CaptureLive, AFullDiskLeavesOnlyWholeFrames) {
  // A limit on the size of files stands for the full disk: the write fails in the same place.
  const test::TemporaryFolder folder;
  LiveOptions options;
  options.folder = folder.path();
  options.frames = 12;
  CountingCamera camera(100);
  const auto stage = continuous_stage();
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  signal(SIGXFSZ, SIG_IGN);
  rlimit tight = before;
  tight.rlim_cur = 60;
  write_text(folder / "capture.json", "{\"frames\": 12}");
  setrlimit(RLIMIT_FSIZE, &tight);
  const std::string message = message_of([&] { capture_live(*stage, camera, options); });
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_FALSE(message.empty());
  const std::vector<std::string> extensions{".png"};
  EXPECT_THROW(expand_inputs({options.folder}, extensions), Error);
  EXPECT_EQ(capture_live(*stage, camera, options).taken, 12);
}

}  // namespace
}  // namespace sateen
