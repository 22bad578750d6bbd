// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace sateen::cli {

// One a file, named like it: amc_build.cpp defines add_amc_build. main.cpp lists them once.

}  // namespace sateen::cli
