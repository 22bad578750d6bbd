// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "sateen/core/progress.h"

namespace sateen::cli {

/// A subcommand `name` under `parent`, with the option --threads, that runs `run` once the whole command line
/// is parsed; `example` is a command that really runs and ends its --help. Each file of this folder adds one:
/// parse, call the library, report.
CLI::App* add_command(CLI::App& parent, const std::string& name, const std::string& summary,
                      const std::string& example);

/// Throws Error unless each of these could be written now: files, and folders for names without extension;
/// empty names are left out. To be asked before the work, so that nobody waits for nothing.
void check_outputs(const std::vector<std::filesystem::path>& outputs);

/// A bar on stderr if that is a terminal, shown once the work has lasted a second; otherwise nothing.
Progress progress_bar(std::string label);

/// Prints to stdout: what the user asked for, nothing else. Throws Error when stdout cannot take it.
void print(const std::string& text);

/// Tells the user something on stderr; that this fails is no reason to fail.
void say(const std::string& text);
/// The same for what is no error but worth knowing.
void warn(const std::string& text);

}  // namespace sateen::cli
