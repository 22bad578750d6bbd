// SPDX-License-Identifier: MIT
#include "sateen/capture/rig/stage.h"

#include <thread>

#include <fmt/format.h>

#include "sateen/capture/rig/serial.h"
#include "sateen/core/error.h"

namespace sateen::capture {
namespace {

using std::chrono::milliseconds;

class GrblStage final : public Stage {
 public:
  GrblStage(const std::string& device, const GrblOptions& options)
      : device_(device), options_(options), line_(device, options.baud) {
    // Opening the line resets most boards; a soft reset makes sure, and the banner says who is there.
    std::this_thread::sleep_for(milliseconds(50));
    line_.clear();
    line_.send("\x18");
    const auto deadline = std::chrono::steady_clock::now() + options_.answer_timeout;
    bool greeted = false;
    while (!greeted && std::chrono::steady_clock::now() < deadline) {
      const auto text = line_.receive(milliseconds(200));
      greeted = text && text->starts_with("Grbl");
    }
    if (!greeted) {
      throw Error(fmt::format("{}: nothing there greets as GRBL; check cable, device and --baud ({} tried)",
                              device_, options_.baud));
    }
    unlock();
    repeat_after_alarm([&] {
      command("G21");
      command("G90");
      command(fmt::format("G92 {}0", options_.axis));
    });
  }

  void stands_at(double degrees) override {
    repeat_after_alarm([&] { command(fmt::format("G92 {}{:.4f}", options_.axis, units_of(degrees))); });
  }

  void move_to(double degrees) override {
    const double units = units_of(degrees);
    const std::string code = fmt::format("G1 {}{:.4f} F{:.1f}", options_.axis, units, options_.feed);
    repeat_after_alarm([&] {
      command(code);
      wait_until_idle();
    });
    std::this_thread::sleep_for(options_.settle);
  }

 private:
  double units_of(double degrees) const {
    return degrees / 360 * options_.units_per_turn * (options_.reverse ? -1 : 1);
  }

  struct Alarm : Error {
    using Error::Error;
  };

  [[noreturn]] void raise(const std::string& what) const {
    throw Alarm(
        fmt::format("{}: the stage raised {} again after unlocking; look for what blocks it", device_, what));
  }

  /// Does what moves or addresses the stage; after an alarm once more, unlocked.
  void repeat_after_alarm(const std::function<void()>& work) {
    try {
      work();
    } catch (const Alarm&) {
      unlock();
      work();
    }
  }

  void check(const std::string& text) const {
    if (text.starts_with("ALARM:")) raise(text);
    if (text.starts_with("error:")) {
      throw Error(fmt::format("{}: the stage refused a command with {}; see GRBL's list of error codes",
                              device_, text));
    }
    if (text.starts_with("Grbl")) {
      throw Error(
          fmt::format("{}: the controller restarted in the middle of the capture and lost its position "
                      "(power, a touched reset?). Start again in another folder, or resume and let the "
                      "pictures tell the angles: --angles pictures",
                      device_));
    }
  }

  void command(const std::string& code) {
    line_.send(code + "\n");
    const auto deadline = std::chrono::steady_clock::now() + options_.answer_timeout;
    while (std::chrono::steady_clock::now() < deadline) {
      const auto text = line_.receive(milliseconds(100));
      if (!text) continue;
      if (*text == "ok") return;
      check(*text);
    }
    throw Error(fmt::format("{}: the stage does not answer to \"{}\"", device_, code));
  }

  void unlock() {
    line_.send("$X\n");
    const auto deadline = std::chrono::steady_clock::now() + options_.answer_timeout;
    while (std::chrono::steady_clock::now() < deadline) {
      const auto text = line_.receive(milliseconds(100));
      if (text && *text == "ok") return;
    }
    throw Error(fmt::format("{}: the stage cannot be unlocked", device_));
  }

  void wait_until_idle() {
    const auto deadline = std::chrono::steady_clock::now() + options_.move_timeout;
    while (std::chrono::steady_clock::now() < deadline) {
      line_.send("?");
      const auto answer_by = std::chrono::steady_clock::now() + milliseconds(250);
      while (std::chrono::steady_clock::now() < answer_by) {
        const auto text = line_.receive(milliseconds(50));
        if (!text) continue;
        if (text->starts_with("<Idle")) return;
        if (text->starts_with("<Alarm")) raise("an alarm");
        if (text->starts_with("<")) break;
        check(*text);
      }
      std::this_thread::sleep_for(milliseconds(20));
    }
    throw Error(fmt::format("{}: the stage did not come to rest within {} s", device_,
                            options_.move_timeout.count() / 1000));
  }

  std::string device_;
  GrblOptions options_;
  SerialLine line_;
};

class ManualStage final : public Stage {
 public:
  explicit ManualStage(std::function<void(const std::string&)> prompt) : prompt_(std::move(prompt)) {}
  void move_to(double degrees) override {
    prompt_(fmt::format("Turn the sphere to about {:.1f} degrees, let go of it, then press Enter", degrees));
  }
  bool knows_angles() const override { return false; }

 private:
  std::function<void(const std::string&)> prompt_;
};

class ContinuousStage final : public Stage {
 public:
  explicit ContinuousStage(std::chrono::milliseconds turn) : turn_(turn) {}
  void move_to(double degrees) override {
    const auto after = std::chrono::duration_cast<Clock::duration>(turn_ * (degrees / 360));
    if (!start_) start_ = Clock::now() - after;
    std::this_thread::sleep_until(*start_ + after);
  }
  bool knows_angles() const override { return false; }

 private:
  using Clock = std::chrono::steady_clock;
  std::chrono::milliseconds turn_;
  std::optional<Clock::time_point> start_;
};

}  // namespace

std::unique_ptr<Stage> open_grbl_stage(const std::string& device, const GrblOptions& options) {
  return std::make_unique<GrblStage>(device, options);
}

std::unique_ptr<Stage> manual_stage(std::function<void(const std::string&)> prompt) {
  return std::make_unique<ManualStage>(std::move(prompt));
}

std::unique_ptr<Stage> continuous_stage(std::chrono::milliseconds turn) {
  return std::make_unique<ContinuousStage>(turn);
}

}  // namespace sateen::capture
