// SPDX-License-Identifier: MIT
#pragma once

#include <csetjmp>
#include <cstdio>

#include <png.h>

#include "sateen/io/image_error.h"

namespace sateen::io {

/// libpng's way out of an error is a jump; the message waits here.
struct PngEscape {
  std::jmp_buf to;
  char message[256] = {};
};

[[noreturn]] inline void leave_png(png_structp png, png_const_charp message) {
  auto* escape = static_cast<PngEscape*>(png_get_error_ptr(png));
  std::snprintf(escape->message, sizeof escape->message, "%s", message);
  std::longjmp(escape->to, 1);
}

/// A warning of libpng's: it is about what we do not read.
inline void ignore_png(png_structp /*png*/, png_const_charp /*message*/) {}

/// Runs `work`, out of which libpng's errors jump: it may own nothing. Throws Error: `fault`, then libpng's
/// message.
template <class Work>
void guarded_png(PngEscape& escape, const std::string& name, const char* fault, const Work& work) {
  if (setjmp(escape.to) != 0) fail(name, fault + image_reason(escape.message));
  work();
}

}  // namespace sateen::io
