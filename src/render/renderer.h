// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "sateen/core/display.h"
#include "sateen/core/progress.h"
#include "sateen/render/picture.h"
#include "sateen/scene/camera.h"
#include "sateen/scene/scene.h"

namespace sateen::render {

struct PictureSettings {
  int width = 1024;
  int height = 1024;
  int samples = 3;  ///< samples x samples in each pixel, averaged in linear light
  std::optional<Vec3f> background =
      {};  ///< linear, not exposed nor seen through the view; nothing is transparent
  /// Applied to each sample before they are averaged; nothing: the light of the scene as it is, for EXR, and
  /// for baked light, which is shown as it was captured.
  std::optional<DisplaySettings> display = {};
  bool surfaces = false;  ///< fill Picture::surfaces too
  int tile = 4096;        ///< largest side, in samples, drawn at once; more is put together from tiles
};

/// A scene on the GPU, drawn from any view; its materials, lighting and switches may change between frames
/// for the price of the change. It lives in the OpenGL context that is current when it is made, one of its
/// own (gpu::Context) or a window's, and must be used and die while that one is current. Whatever OpenGL
/// state it touches it puts back.
///
/// Appearances are shared with the caller: what is set on one shows in the next frame.
class Renderer {
 public:
  /// Throws Error when a material needs what the mesh does not have, and when the driver cannot hold the
  /// scene.
  explicit Renderer(const scene::Scene& scene);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Replaces one material. Throws Error when there is no such material, and as the constructor does.
  void set_material(std::size_t index, scene::Material material);
  void set_lighting(light::Lighting lighting);
  void set_switches(const scene::RenderSwitches& switches);
  /// Turns all tangents about their normals by so many radians, counter-clockwise seen from outside.
  void set_tangent_turn(double angle);

  /// One picture, with everything prepared that takes long (Appearance::settle).
  Picture render(const scene::View& view, const PictureSettings& settings,
                 const Progress& progress = {}) const;

  /// Draws into whatever framebuffer is bound, over what is in it, with depth test; clearing is the caller's.
  /// Never waits for tables: what is not ready is drawn as it was before.
  void draw(const scene::View& view) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace sateen::render
