// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "sateen/gpu/context.h"
#include "sateen/render/renderer.h"

// Helpers for tests that draw: a shared context, one-material scenes, and the comparison of what the GPU drew
// with the appearance's C++ evaluator.
namespace sateen::test {

/// The context of this test program, current on the calling thread.
inline const gpu::Context& context() {
  static const gpu::Context shared;
  shared.make_current();
  return shared;
}

inline scene::Scene scene_of(Mesh mesh, std::shared_ptr<appearance::Appearance> appearance,
                             const scene::RenderSwitches& switches = {},
                             const light::Lighting& lighting = {}) {
  scene::Scene scene;
  scene.mesh = std::move(mesh);
  scene.materials.resize(1);
  scene.materials[0].appearance = std::move(appearance);
  scene.switches = switches;
  scene.lighting = lighting;
  return scene;
}

struct Shot {
  int width = 128;
  int height = 128;
  scene::Camera camera = {};
  Mat3 rotation = Mat3::Identity();
  int samples = 1;
  bool surfaces = true;
};

/// A square picture of a mesh whose coordinates are view space.
inline Shot in_view_space(int size) {
  Shot picture;
  picture.width = picture.height = size;
  picture.camera.kind = scene::Camera::Kind::view_space;
  return picture;
}

inline render::Picture render(const scene::Scene& scene, const Shot& picture) {
  context();
  const std::vector<Mat3> rotations{picture.rotation};
  const scene::View view = scene::frame_object(scene.mesh, picture.camera, rotations,
                                               static_cast<double>(picture.width) / picture.height)[0];
  render::PictureSettings settings;
  settings.width = picture.width;
  settings.height = picture.height;
  settings.samples = picture.samples;
  settings.surfaces = picture.surfaces;
  return render::Renderer(scene).render(view, settings);
}

/// How two pictures, or a picture and a formula, differ.
struct Difference {
  double largest = 0;
  double sum_of_squares = 0;
  int pixels = 0;   ///< compared
  int failing = 0;  ///< further apart than the tolerance
  int x = -1;       ///< of the largest
  int y = -1;

  void add(int px, int py, double difference, double tolerance) {
    ++pixels;
    sum_of_squares += difference * difference;
    if (!(difference <= tolerance)) ++failing;
    if (!(difference <= largest)) {
      largest = difference;
      x = px;
      y = py;
    }
  }
  double rms() const { return pixels == 0 ? 0 : std::sqrt(sum_of_squares / pixels); }
  double failing_share() const { return pixels == 0 ? 0 : static_cast<double>(failing) / pixels; }
};

/// The frame's colour against radiance() of the surface the pipeline saw, at every covered pixel. The frame
/// is drawn with one sample and with its surfaces.
inline Difference against_evaluator(const render::Picture& frame, const scene::Scene& scene,
                                    double tolerance) {
  Difference difference;
  for (int y = 0; y < frame.colour.height; ++y) {
    for (int x = 0; x < frame.colour.width; ++x) {
      const auto surface = scene::surface_at(*frame.surfaces, x, y);
      if (!surface) continue;
      const Vec3 expected = scene.materials[static_cast<std::size_t>(surface->material)].appearance->radiance(
          *surface, scene.lighting);
      difference.add(x, y, (expected - frame.colour.rgb(x, y).cast<double>()).cwiseAbs().maxCoeff(),
                     tolerance);
    }
  }
  return difference;
}

/// For a new appearance: renders `mesh` under perspective with it and expects every pixel within `tolerance`
/// of the C++ evaluator.
inline void expect_matches_evaluator(const Mesh& mesh, std::shared_ptr<appearance::Appearance> appearance,
                                     double tolerance, const scene::RenderSwitches& switches = {},
                                     const Shot& picture = {}, const light::Lighting& lighting = {}) {
  const scene::Scene scene = scene_of(mesh, std::move(appearance), switches, lighting);
  const render::Picture frame = render(scene, picture);
  const Difference difference = against_evaluator(frame, scene, tolerance);
  EXPECT_GT(difference.pixels, frame.colour.width * frame.colour.height / 10);
  EXPECT_EQ(difference.failing, 0) << "largest difference " << difference.largest << " at pixel ("
                                   << difference.x << ", " << difference.y << ")";
}

/// A smooth picture over the disc, bright and varied enough to tell directions apart: red grows to the right,
/// green upwards, blue is a highlight up and left.
inline Image test_matcap(int size = 64) {
  Image image(size, size, 3);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const float i = (static_cast<float>(x) + 0.5f) / static_cast<float>(size);
      const float j = 1 - (static_cast<float>(y) + 0.5f) / static_cast<float>(size);
      const float d2 = (i - 0.35f) * (i - 0.35f) + (j - 0.7f) * (j - 0.7f);
      image.set_rgb(x, y, {i, j, std::exp(-40 * d2)});
    }
  }
  return image;
}

}  // namespace sateen::test
