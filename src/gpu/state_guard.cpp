// SPDX-License-Identifier: MIT
#include "sateen/gpu/state_guard.h"

#include <algorithm>

#include <epoxy/gl.h>

namespace sateen::gpu {
namespace {

constexpr std::array<GLenum, 5> kSwitches{GL_DEPTH_TEST, GL_CULL_FACE, GL_BLEND, GL_SCISSOR_TEST,
                                          GL_FRAMEBUFFER_SRGB};
constexpr std::array<std::array<GLenum, 2>, 4> kTargets{{{GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D},
                                                         {GL_TEXTURE_3D, GL_TEXTURE_BINDING_3D},
                                                         {GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BINDING_2D_ARRAY},
                                                         {GL_TEXTURE_CUBE_MAP, GL_TEXTURE_BINDING_CUBE_MAP}}};

}  // namespace

StateGuard::StateGuard(int units) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, &most);
  units_.resize(static_cast<std::size_t>(std::min(units, most)));
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_framebuffer_);
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_framebuffer_);
  glGetIntegerv(GL_RENDERBUFFER_BINDING, &renderbuffer_);
  glGetIntegerv(GL_CURRENT_PROGRAM, &program_);
  glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &vertex_array_);
  glGetIntegerv(GL_ARRAY_BUFFER_BINDING, &array_buffer_);
  glGetIntegerv(GL_ACTIVE_TEXTURE, &active_texture_);
  glGetIntegerv(GL_UNPACK_ALIGNMENT, &unpack_alignment_);
  glGetIntegerv(GL_PACK_ALIGNMENT, &pack_alignment_);
  glGetIntegerv(GL_DEPTH_FUNC, &depth_function_);
  glGetIntegerv(GL_VIEWPORT, viewport_.data());
  glGetFloatv(GL_COLOR_CLEAR_VALUE, clear_colour_.data());
  glGetBooleanv(GL_COLOR_WRITEMASK, colour_mask_.data());
  glGetBooleanv(GL_DEPTH_WRITEMASK, &depth_mask_);
  for (std::size_t i = 0; i < kSwitches.size(); ++i) enabled_[i] = glIsEnabled(kSwitches[i]);
  for (std::size_t unit = 0; unit < units_.size(); ++unit) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    for (std::size_t t = 0; t < kTargets.size(); ++t)
      glGetIntegerv(kTargets[t][1], &units_[unit].textures[t]);
    glGetIntegerv(GL_SAMPLER_BINDING, &units_[unit].sampler);
    // A window's sampler objects would override how textures say they are to be read.
    glBindSampler(static_cast<GLuint>(unit), 0);
  }
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_FRAMEBUFFER_SRGB);
}

StateGuard::~StateGuard() {
  for (std::size_t unit = 0; unit < units_.size(); ++unit) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    for (std::size_t t = 0; t < kTargets.size(); ++t) {
      glBindTexture(kTargets[t][0], static_cast<GLuint>(units_[unit].textures[t]));
    }
    glBindSampler(static_cast<GLuint>(unit), static_cast<GLuint>(units_[unit].sampler));
  }
  for (std::size_t i = 0; i < kSwitches.size(); ++i) {
    if (enabled_[i] != 0) {
      glEnable(kSwitches[i]);
    } else {
      glDisable(kSwitches[i]);
    }
  }
  glDepthMask(depth_mask_);
  glColorMask(colour_mask_[0], colour_mask_[1], colour_mask_[2], colour_mask_[3]);
  glClearColor(clear_colour_[0], clear_colour_[1], clear_colour_[2], clear_colour_[3]);
  glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
  glDepthFunc(static_cast<GLenum>(depth_function_));
  glPixelStorei(GL_PACK_ALIGNMENT, pack_alignment_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, unpack_alignment_);
  glActiveTexture(static_cast<GLenum>(active_texture_));
  glBindVertexArray(static_cast<GLuint>(vertex_array_));
  glBindBuffer(GL_ARRAY_BUFFER, static_cast<GLuint>(array_buffer_));
  glUseProgram(static_cast<GLuint>(program_));
  glBindRenderbuffer(GL_RENDERBUFFER, static_cast<GLuint>(renderbuffer_));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_framebuffer_));
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_framebuffer_));
}

}  // namespace sateen::gpu
