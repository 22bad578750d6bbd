// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

namespace sateen::cli {

/// What every `sateen brdf` command takes: a model and the file with its parameters.
struct BrdfArguments {
  std::string model;
  std::filesystem::path parameters;
};

/// Declares them; `arguments` outlives the parsing.
void add_brdf_options(CLI::App& command, BrdfArguments& arguments);

}  // namespace sateen::cli
