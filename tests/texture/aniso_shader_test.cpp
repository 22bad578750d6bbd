// SPDX-License-Identifier: MIT
// shaders/aniso_map.glsl against anisotropy.h, texel by texel.
#include <array>
#include <random>

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "sateen/gpu/context.h"
#include "sateen/gpu/framebuffer.h"
#include "sateen/gpu/program.h"
#include "sateen/gpu/shaders.h"
#include "sateen/gpu/texture.h"
#include "sateen/texture/anisotropy.h"

namespace sateen::texture {
namespace {

constexpr int kSize = 64;

TextureData texture_of(const Image& image) {
  TextureData data;
  data.format = TextureData::Format::rgba32f;
  data.width = image.width;
  data.height = image.height;
  const auto bytes = std::as_bytes(std::span(image.data));
  data.levels.assign(1, {bytes.begin(), bytes.end()});
  return data;
}

/// Runs `main_text` on every texel of `input`.
Image run(const Image& input, const std::string& main_text) {
  const std::string text =
      "uniform sampler2D map;\nout vec4 result;\nvoid main() {\n"
      "  vec3 c = texelFetch(map, ivec2(gl_FragCoord.xy), 0).rgb;\n" +
      main_text + "}\n";
  const gpu::ShaderFile main_file{"test.frag", text};
  const gpu::Program program(std::array{gpu::shader_file("picture.vert")},
                             std::array{gpu::shader_file("aniso_map.glsl"), main_file});
  const gpu::Framebuffer target(kSize, kSize);
  target.bind();
  glDisable(GL_DEPTH_TEST);
  GLuint vertex_array = 0;
  glGenVertexArrays(1, &vertex_array);
  glBindVertexArray(vertex_array);
  program.use();
  const gpu::Texture texture(texture_of(input));
  texture.bind(0);
  program.set("map", 0);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDeleteVertexArrays(1, &vertex_array);
  // Row 0 of the framebuffer's picture is its top; of the texture it is v = 0.
  const Image read = target.read();
  Image upright(kSize, kSize, 4);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x)
      std::ranges::copy(read.pixel(x, kSize - 1 - y), upright.pixel(x, y).begin());
  }
  return upright;
}

TEST(AnisoShader, DecodesAsTheReferenceDoes) {
  const gpu::Context context;
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> value(0, 1);
  std::uniform_real_distribution<double> alpha(0.02, 1);
  for (const auto encoding : {AnisotropyEncoding::root, AnisotropyEncoding::correlation}) {
    // The left half are lobes, the right half any channels, as bad interpolation might give.
    Image input(kSize, kSize, 4);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const Vec3 c =
            x < kSize / 2
                ? encode_anisotropy(
                      brdf::roughness_matrix({alpha(generator), alpha(generator), 7 * alpha(generator)}),
                      encoding)
                : Vec3(value(generator), value(generator), value(generator));
        for (int k = 0; k < 3; ++k) input.at(x, y, k) = static_cast<float>(c[k]);
      }
    }
    const Image out = run(input, "  AnisotropicLobe lobe = decode_anisotropy_" + name_of(encoding) +
                                     "(c);\n  result = vec4(lobe.alpha_t, lobe.alpha_b, lobe.axis);\n");
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const Vec3 c(input.at(x, y, 0), input.at(x, y, 1), input.at(x, y, 2));
        const brdf::AnisotropicRoughness expected =
            brdf::roughness_from_matrix(decode_anisotropy(c, encoding));
        const auto got = out.pixel(x, y);
        ASSERT_NEAR(got[0], expected.alpha_t, 1e-4);
        ASSERT_NEAR(got[1], expected.alpha_b, 2e-3);
        ASSERT_GE(got[1], 0.9e-3f);
        ASSERT_NEAR(std::hypot(got[2], got[3]), 1, 1e-4);
        if (expected.alpha_t - expected.alpha_b > 0.02) {
          const double along = got[2] * std::cos(expected.azimuth) + got[3] * std::sin(expected.azimuth);
          ASSERT_NEAR(std::abs(along), 1, 1e-3);
        }
      }
    }
  }
}

TEST(AnisoShader, FrameIsTheSmallestRotation) {
  const gpu::Context context;
  Image input(kSize, kSize, 4);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const Vec3 n = Vec3(x / 20.0 - 1.6, y / 20.0 - 1.6, 1).normalized();
      for (int k = 0; k < 2; ++k) input.at(x, y, k) = static_cast<float>(n[k] / 2 + 0.5);
    }
  }
  for (int column = 0; column < 3; ++column) {
    const Image out = run(input, "  result = vec4(normal_map_frame(decode_normal_xy(c.xy))[" +
                                     std::to_string(column) + "], 1.0);\n");
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const Vec3 n = Vec3(x / 20.0 - 1.6, y / 20.0 - 1.6, 1).normalized();
        const Vec3 expected = normal_frame(n).col(column);
        for (int k = 0; k < 3; ++k) ASSERT_NEAR(out.at(x, y, k), expected[k], 1e-5);
      }
    }
  }
}

}  // namespace
}  // namespace sateen::texture
