// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sateen/core/image.h"
#include "sateen/gpu/handle.h"

namespace sateen::gpu {

/// Float RGBA colour targets of one size, with a depth buffer.
class Framebuffer {
 public:
  /// `targets` colour attachments of 32-bit floats, locations 0 .. targets - 1, and 32-bit depth.
  /// Throws Error when the driver cannot make them.
  Framebuffer(int width, int height, int targets = 1);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Draws go here from now on, with a viewport over the whole of it.
  void bind() const;

  /// Colour target 0 (texelFetch only: no filtering) as a texture.
  void bind_colour(int unit) const;

  /// One colour target as RGBA, row 0 on top. Waits for the drawing to end.
  Image read(int target = 0) const;

 private:
  int width_;
  int height_;
  Handle framebuffer_;
  Handle depth_;
  std::vector<Handle> colours_;
};

/// The largest side of a framebuffer and its viewport.
int max_framebuffer_size();

}  // namespace sateen::gpu
