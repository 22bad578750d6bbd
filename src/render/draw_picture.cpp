// SPDX-License-Identifier: MIT
#include "sateen/render/draw_picture.h"

#include <array>
#include <optional>

#include "sateen/gpu/context.h"

namespace sateen::render {

Picture draw_picture(const scene::Scene& scene, const PictureSettings& settings, const scene::Camera& camera,
                     const Mat3& rotation) {
  std::optional<gpu::Context> context;
  if (!gpu::context_is_current()) context.emplace();
  const double aspect = static_cast<double>(settings.width) / settings.height;
  const scene::View view = scene::frame_object(scene.mesh, camera, std::array{rotation}, aspect)[0];
  return Renderer(scene).render(view, settings);
}

}  // namespace sateen::render
