// SPDX-License-Identifier: MIT
#include "sateen/capture/exposure/mirror_ball_shot.h"

#include <fmt/format.h>

#include "sateen/capture/exposure/mirror_ball.h"
#include "sateen/capture/sphere/first_look.h"
#include "sateen/core/error.h"

namespace sateen::capture {
namespace {

constexpr int kEnvironmentWidth = 512;
constexpr double kScattered = 1;  // pixels: edge points of a real outline lie closer to it

}  // namespace

Image mirror_ball_shot(const MirrorBallOptions& options, const FrameSourceOptions& source_options,
                       const FirstLook& look) {
  FrameSource source = FrameSource::open({options.picture}, source_options);
  const Camera& camera = look.lens.camera;
  if (source.width() != camera.width || source.height() != camera.height) {
    throw Error(fmt::format("{}: is {} x {}, the frames are {} x {}", options.picture.string(),
                            source.width(), source.height(), camera.width, camera.height));
  }
  const Photograph frame = source.read(0);
  const GreyPicture grey = grey_picture(frame, look.factor);
  Vec2 centre = look.centre;
  double radius = look.outline.radius;
  double support = 0;
  double scatter = 0;  // in the first searches, which are wide enough to tell an outline from chance
  for (const double reach : {0.15 * radius, 6.0, 3.0}) {
    const OutlineOffset offset = measure_outline(grey, 1, look.outline.plate, look.camera,
                                                 sphere_at(look.camera, centre, radius), reach, false);
    centre += offset.shift;
    radius += offset.growth;
    support = offset.support;
    if (reach > 3) scatter = offset.residual;
  }
  if (support < 0.4 || scatter > kScattered) {
    throw Error(fmt::format("{}: no ball is found where the sphere stood; put it on the same stand",
                            options.picture.string()));
  }
  const SphereView ball = sphere_at(camera, centre * look.factor, radius * look.factor);
  return mirror_ball_environment(frame, camera, ball, kEnvironmentWidth, options.reflectance);
}

}  // namespace sateen::capture
