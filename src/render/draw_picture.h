// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/render/renderer.h"
#include "sateen/scene/camera.h"

namespace sateen::render {

/// A picture of a scene, without a screen: the camera frames the object, which is turned first. Draws in the
/// OpenGL context that is current, or in one of its own for the while. For many pictures of one scene make a
/// Renderer. Throws Error when there is no OpenGL, and what Renderer throws.
Picture draw_picture(const scene::Scene& scene, const PictureSettings& settings = {},
                     const scene::Camera& camera = {}, const Mat3& rotation = Mat3::Identity());

}  // namespace sateen::render
