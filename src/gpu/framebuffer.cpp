// SPDX-License-Identifier: MIT
#include "sateen/gpu/framebuffer.h"

#include <algorithm>
#include <array>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "sateen/core/error.h"

namespace sateen::gpu {

Framebuffer::Framebuffer(int width, int height, int targets) : width_(width), height_(height) {
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  framebuffer_ = Handle(name, [](unsigned framebuffer) { glDeleteFramebuffers(1, &framebuffer); });
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());

  std::vector<GLenum> locations;
  for (int i = 0; i < targets; ++i) {
    glGenTextures(1, &name);
    colours_.emplace_back(name, [](unsigned texture) { glDeleteTextures(1, &texture); });
    glBindTexture(GL_TEXTURE_2D, name);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    locations.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
    glFramebufferTexture2D(GL_FRAMEBUFFER, locations.back(), GL_TEXTURE_2D, name, 0);
  }
  glDrawBuffers(targets, locations.data());

  glGenRenderbuffers(1, &name);
  depth_ = Handle(name, [](unsigned buffer) { glDeleteRenderbuffers(1, &buffer); });
  glBindRenderbuffer(GL_RENDERBUFFER, name);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, name);

  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw Error(fmt::format("this OpenGL driver cannot draw into {} float targets of {} x {} pixels", targets,
                            width, height));
  }
}

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, width_, height_);
}

void Framebuffer::bind_colour(int unit) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_2D, colours_.front().name());
}

Image Framebuffer::read(int target) const {
  Image image(width_, height_, 4);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(target));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, image.data.data());
  const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(width_) * 4;
  for (int y = 0; y < height_ / 2; ++y) {
    std::swap_ranges(image.data.begin() + y * row, image.data.begin() + (y + 1) * row,
                     image.data.begin() + (height_ - 1 - y) * row);
  }
  return image;
}

int max_framebuffer_size() {
  GLint texture = 0;
  std::array<GLint, 2> viewport{};
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
  return std::min({texture, viewport[0], viewport[1]});
}

}  // namespace sateen::gpu
