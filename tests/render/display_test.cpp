// SPDX-License-Identifier: MIT
#include "sateen/core/display.h"

#include <array>
#include <cmath>
#include <cstring>
#include <random>

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "sateen/gpu/framebuffer.h"
#include "sateen/gpu/program.h"
#include "sateen/gpu/texture.h"
#include "sateen/render/metering.h"
#include "sateen/scene/constant.h"
#include "support/rendering.h"
#include "support/shapes.h"

// The display pass: exposure and view transform of every sample, then their mean.
namespace sateen::render {
namespace {

constexpr std::array kViews{ViewTransform::none, ViewTransform::srgb, ViewTransform::neutral,
                            ViewTransform::agx};

/// Light over 24 stops, a tenth of it below 0, on pixels that are empty, partly covered or whole.
Image random_light(int size) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> stops(-12, 12);
  std::uniform_real_distribution<float> unit(0, 1);
  Image light(size, size, 4);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const float alpha = (x + y) % 3 == 0 ? 1 : (x + y) % 3 == 1 ? unit(random) : 0;
      for (int c = 0; c < 3; ++c) {
        light.at(x, y, c) = alpha * std::exp2(stops(random)) * (unit(random) < 0.1f ? -1.0f : 1.0f);
      }
      light.at(x, y, 3) = alpha;
    }
  }
  return light;
}

TextureData texture_of(const Image& image) {
  TextureData data;
  data.format = TextureData::Format::rgba32f;
  data.width = image.width;
  data.height = image.height;
  data.levels.resize(1);
  data.levels[0].resize(image.data.size() * sizeof(float));
  const std::size_t row = static_cast<std::size_t>(image.width) * 4;
  for (int y = 0; y < image.height; ++y) {  // the texture's first row is at the bottom
    std::memcpy(data.levels[0].data() + static_cast<std::size_t>(y) * row * sizeof(float),
                image.data.data() + static_cast<std::size_t>(image.height - 1 - y) * row,
                row * sizeof(float));
  }
  return data;
}

/// shaders/display.frag over a picture of samples.
Image display_pass(const Image& light, int samples, const DisplaySettings& settings) {
  test::context();
  const gpu::Program program(std::array{gpu::shader_file("picture.vert")},
                             gpu::with_needed(std::array{std::string("display.frag")}));
  const gpu::Texture texture(texture_of(light));
  const gpu::Framebuffer target(light.width / samples, light.height / samples);
  target.bind();
  glDisable(GL_DEPTH_TEST);
  GLuint vertex_array = 0;
  glGenVertexArrays(1, &vertex_array);
  glBindVertexArray(vertex_array);
  program.use();
  texture.bind(0);
  program.set("supersampled", 0);
  program.set("samples", samples);
  program.set("background", Vec4f(0, 0, 0, 0));
  program.set("display_view", static_cast<int>(settings.view));
  program.set("display_gain", static_cast<float>(display_gain(settings)));
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDeleteVertexArrays(1, &vertex_array);
  return target.read();
}

TEST(Display, ShaderAndEvaluatorAreTheSame) {
  const Image light = random_light(48);
  for (const ViewTransform view : kViews) {
    const DisplaySettings settings{.exposure = -0.7, .view = view};
    const Image drawn = display_pass(light, 1, settings);
    const Image expected = displayed(light, settings);
    test::Difference difference;
    for (int y = 0; y < light.height; ++y) {
      for (int x = 0; x < light.width; ++x) {
        EXPECT_EQ(drawn.at(x, y, 3), expected.at(x, y, 3));
        difference.add(x, y, (drawn.rgb(x, y) - expected.rgb(x, y)).cwiseAbs().maxCoeff(), 1e-4);
      }
    }
    EXPECT_EQ(difference.failing, 0) << "view " << static_cast<int>(view) << ": " << difference.largest
                                     << " at (" << difference.x << ", " << difference.y << ")";
  }
}

TEST(Display, SamplesAreShownBeforeTheyAreAveraged) {
  const Image light = random_light(48);
  for (const ViewTransform view : {ViewTransform::srgb, ViewTransform::neutral, ViewTransform::agx}) {
    const DisplaySettings settings{.exposure = 0.5, .view = view};
    const Image drawn = display_pass(light, 4, settings);
    const Image each = displayed(light, settings);
    for (int y = 0; y < drawn.height; ++y) {
      for (int x = 0; x < drawn.width; ++x) {
        Vec4f sum = Vec4f::Zero();
        for (int i = 0; i < 16; ++i) {
          sum += Eigen::Map<const Vec4f>(each.pixel(4 * x + i % 4, 4 * y + i / 4).data());
        }
        const Eigen::Map<const Vec4f> mean(drawn.pixel(x, y).data());
        EXPECT_LT((sum / 16 - mean).cwiseAbs().maxCoeff(), 1e-4) << x << ", " << y;
      }
    }
  }
}

/// A white cloth over the left half of one pixel.
scene::Scene half_a_pixel(double light) {
  Mesh mesh = test::plane();
  for (Vec3f& p : mesh.positions) p.x() = (p.x() - 1) / 2;
  return test::scene_of(std::move(mesh), std::make_shared<scene::Constant>(Vec3::Constant(light)));
}

Image one_pixel(double light, const std::optional<Vec3f>& background,
                const std::optional<DisplaySettings>& display) {
  test::context();
  const scene::Scene scene = half_a_pixel(light);
  scene::Camera camera;
  camera.kind = scene::Camera::Kind::view_space;
  const scene::View view = scene::frame_object(scene.mesh, camera, std::array{Mat3(Mat3::Identity())}, 1)[0];
  return Renderer(scene)
      .render(view, {.width = 1, .height = 1, .samples = 4, .background = background, .display = display})
      .colour;
}

// Light of 20 is white on a screen: half a pixel of it is half white, not white.
TEST(Display, BrightOutlinesAreSmooth) {
  const Vec3f black = Vec3f::Zero();
  EXPECT_NEAR(one_pixel(20, black, std::nullopt).at(0, 0, 0), 10, 1e-5);
  EXPECT_NEAR(one_pixel(20, black, DisplaySettings{}).at(0, 0, 0), 0.5, 1e-6);
  const double agx = shown_light(ViewTransform::agx, Vec3::Constant(20)).x();
  EXPECT_NEAR(one_pixel(20, black, DisplaySettings{.view = ViewTransform::agx}).at(0, 0, 0), agx / 2, 1e-4);
}

TEST(Display, TheBackgroundIsShownAsItIs) {
  const DisplaySettings settings{.exposure = -3, .view = ViewTransform::neutral};
  const Image pixel = one_pixel(0, Vec3f(1, 0.5f, 0.25f), settings);
  EXPECT_LT((pixel.rgb(0, 0) - Vec3f(0.5f, 0.25f, 0.125f)).norm(), 1e-6);
  EXPECT_EQ(pixel.at(0, 0, 3), 1);
}

TEST(Display, MeteringFindsTheLightOfTheObject) {
  test::context();
  const scene::Scene scene =
      test::scene_of(test::sphere(), std::make_shared<scene::Constant>(Vec3::Constant(0.045)));
  const scene::View view =
      scene::frame_object(scene.mesh, {}, std::array{Mat3(Mat3::Identity())}, 1000.0 / 400)[0];
  const PictureSettings settings{.width = 1000,
                                 .height = 400,
                                 .background = Vec3f(1, 1, 1),
                                 .display = DisplaySettings{.exposure = 9, .view = ViewTransform::agx}};
  EXPECT_NEAR(metered_exposure(Renderer(scene), view, settings), 2, 1e-5);
}

}  // namespace
}  // namespace sateen::render
