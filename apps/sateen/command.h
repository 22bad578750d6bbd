// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "sateen/core/progress.h"

namespace sateen::cli {

/// A subcommand `name` under `parent`, with the option --threads, that runs `run` once the whole command line
/// is parsed; `example` is a command that really runs and ends its --help. Each file of this folder adds one:
/// parse, call the library, report.
CLI::App* add_command(CLI::App& parent, const std::string& name, const std::string& summary,
                      const std::string& example);

/// A bar on stderr if that is a terminal, shown once the work has lasted a second; otherwise nothing.
Progress progress_bar(std::string label);

/// Prints to stdout: what the user asked for, nothing else. Throws Error when stdout cannot take it.
void print(const std::string& text);

/// Tells the user something on stderr; that this fails is no reason to fail.
void say(const std::string& text);
/// The same for what is no error but worth knowing.
void warn(const std::string& text);

}  // namespace sateen::cli
