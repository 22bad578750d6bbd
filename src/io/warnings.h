// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

namespace sateen::io {

/// Hears of what a file has and we do not use, and of what had to be assumed: one line in plain words that
/// names the file. May be called from several threads, one at a time.
using WarningHandler = std::function<void(const std::string&)>;

/// Who hears them from now on, in the whole process; at first nobody does. Programs set it once, in main.
/// Returns who heard them before.
WarningHandler set_warning_handler(WarningHandler handler);

/// Tells the handler, once for each text.
void warn(const std::string& text);

}  // namespace sateen::io
