// SPDX-License-Identifier: MIT
#include "command.h"

#include <chrono>
#include <cstdio>
#include <memory>
#include <mutex>

#include <fmt/format.h>
#include <unistd.h>

#include "sateen/core/error.h"
#include "sateen/core/parallel.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"

namespace sateen::cli {

CLI::App* add_command(CLI::App& parent, const std::string& name, const std::string& summary,
                      const std::string& example) {
  CLI::App* command = parent.add_subcommand(name, summary);
  command->add_option_function<int>("--threads", limit_threads, "Threads to use; 0 means all processors")
      ->check(CLI::NonNegativeNumber)
      ->type_name("INT");
  command
      ->add_option_function<std::int64_t>("--max-pixels", io::set_max_pixels,
                                          "The largest picture, in pixels, to take into memory")
      ->check(CLI::PositiveNumber)
      ->default_str(std::to_string(io::max_pixels()))
      ->type_name("INT");
  command->footer("Example:\n  " + example);
  return command;
}

void check_outputs(const std::vector<std::filesystem::path>& outputs) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& output : outputs) {
    if (output.empty()) continue;
    if (output.has_extension()) {
      files.push_back(output);
    } else {
      io::check_writable_folder(output);
    }
  }
  io::check_writable(files);
}

Progress progress_bar(std::string label) {
  if (isatty(STDERR_FILENO) == 0) return {};
  using Clock = std::chrono::steady_clock;
  struct State {
    std::string label;
    std::mutex mutex;
    Clock::time_point start = Clock::now();
    int shown = -1;
  };
  auto state = std::make_shared<State>();
  state->label = std::move(label);
  return [state](double fraction) {
    const std::lock_guard lock(state->mutex);
    const int percent = static_cast<int>(fraction * 100);
    if (percent <= state->shown || Clock::now() - state->start < std::chrono::seconds(1)) return;
    state->shown = percent;
    const int filled = percent * 30 / 100;
    std::string line =
        fmt::format("\r{} [{:#<{}}{:.<{}}] {:3}%", state->label, "", filled, "", 30 - filled, percent);
    if (percent >= 100) line += fmt::format("\r{:{}}\r", "", state->label.size() + 40);
    std::fputs(line.c_str(), stderr);
    std::fflush(stderr);
  };
}

void print(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw Error("standard output cannot be written");
  }
}

void say(const std::string& text) {
  std::fputs(fmt::format("sateen: {}\n", text).c_str(), stderr);
}

void warn(const std::string& text) {
  say("warning: " + text);
}

}  // namespace sateen::cli
