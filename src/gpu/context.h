// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace sateen::gpu {

/// A headless OpenGL context, core 3.3 or later, through EGL: no display and no window. A hardware device is
/// preferred, then Mesa's surfaceless platform (software rendering), then whatever the default display
/// offers.
///
/// The constructor makes it current on the calling thread; objects of this folder belong to the context that
/// is current when they are made and must die while it is current.
class Context {
 public:
  /// Throws Error when no driver offers such a context, with what would help.
  Context();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// Makes this context current on the calling thread. Throws Error when it is current on another.
  void make_current() const;

  /// The driver's own words, "llvmpipe (LLVM 15.0.6, 256 bits)".
  const std::string& renderer() const { return renderer_; }
  /// Whether the driver computes on the processor: its frame times say nothing about a graphics card.
  bool is_software() const;

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
  std::string renderer_;
};

/// Whether an OpenGL context made through EGL is current on the calling thread, of this library or a
/// window's.
bool context_is_current();

}  // namespace sateen::gpu
