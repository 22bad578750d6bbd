// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

namespace sateen::gpu {

/// Puts the OpenGL state that drawing touches back when it goes: framebuffers, viewport, program, vertex
/// array, buffers, tests and masks, clear colour, pixel storage, and the textures of the first `units` units.
/// For windows that draw beside.
class StateGuard {
 public:
  explicit StateGuard(int units = 16);
  ~StateGuard();
  StateGuard(const StateGuard&) = delete;
  StateGuard& operator=(const StateGuard&) = delete;

 private:
  struct Unit {
    std::array<int, 4> textures;  ///< by target
    int sampler;
  };
  int draw_framebuffer_ = 0;
  int read_framebuffer_ = 0;
  int renderbuffer_ = 0;
  int program_ = 0;
  int vertex_array_ = 0;
  int array_buffer_ = 0;
  int active_texture_ = 0;
  int unpack_alignment_ = 0;
  int pack_alignment_ = 0;
  int depth_function_ = 0;
  std::array<int, 4> viewport_{};
  std::array<float, 4> clear_colour_{};
  std::array<unsigned char, 4> colour_mask_{};
  unsigned char depth_mask_ = 0;
  std::array<unsigned char, 5> enabled_{};
  std::vector<Unit> units_;
};

}  // namespace sateen::gpu
