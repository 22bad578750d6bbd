// SPDX-License-Identifier: MIT
#include "sateen/gpu/context.h"

#include <array>
#include <string_view>
#include <vector>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "sateen/core/error.h"

namespace sateen::gpu {
namespace {

bool has(const char* extensions, std::string_view name) {
  return extensions != nullptr && std::string_view(extensions).find(name) != std::string_view::npos;
}

/// Displays worth trying, best first. They are the process's own and stay open: EGL hands out the same one
/// again.
std::vector<EGLDisplay> candidate_displays() {
  std::vector<EGLDisplay> displays;
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (has(client, "EGL_EXT_platform_base")) {
    if (has(client, "EGL_EXT_device_enumeration") || has(client, "EGL_EXT_device_base")) {
      std::array<EGLDeviceEXT, 16> devices{};
      EGLint count = 0;
      if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_TRUE) {
        for (int i = 0; i < count; ++i) {
          const EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
          if (has(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software")) continue;
          displays.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
        }
      }
    }
    if (has(client, "EGL_MESA_platform_surfaceless")) {
      displays.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr));
    }
  }
  displays.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
  return displays;
}

EGLContext core_context(EGLDisplay display) {
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE)
    return EGL_NO_CONTEXT;
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return EGL_NO_CONTEXT;
  // Nothing is drawn to EGL surfaces, so any configuration with desktop OpenGL does.
  constexpr std::array<EGLint, 5> wishes{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglChooseConfig(display, wishes.data(), &config, 1, &count) != EGL_TRUE || count < 1)
    return EGL_NO_CONTEXT;
  constexpr std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION_KHR,
                                             3,
                                             EGL_CONTEXT_MINOR_VERSION_KHR,
                                             3,
                                             EGL_CONTEXT_OPENGL_PROFILE_MASK_KHR,
                                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT_KHR,
                                             EGL_NONE};
  EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
  if (context == EGL_NO_CONTEXT) return context;
  if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_TRUE) {
    eglDestroyContext(display, context);
    return EGL_NO_CONTEXT;
  }
  return context;
}

}  // namespace

Context::Context() {
  for (EGLDisplay display : candidate_displays()) {
    context_ = core_context(display);
    if (context_ == EGL_NO_CONTEXT) continue;
    display_ = display;
    renderer_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return;
  }
  throw Error(
      "no OpenGL 3.3 is available without a display; install a driver, or Mesa's software renderer (Debian "
      "and Ubuntu: "
      "libegl-mesa0 and libgl1-mesa-dri)");
}

Context::~Context() {
  if (eglGetCurrentContext() == context_) {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  eglDestroyContext(display_, context_);
}

void Context::make_current() const {
  if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
    throw Error("the OpenGL context is in use on another thread");
  }
}

bool context_is_current() {
  return eglGetCurrentContext() != EGL_NO_CONTEXT;
}

bool Context::is_software() const {
  return renderer_.find("llvmpipe") != std::string::npos || renderer_.find("softpipe") != std::string::npos ||
         renderer_.find("SwiftShader") != std::string::npos;
}

}  // namespace sateen::gpu
