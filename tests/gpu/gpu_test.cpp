// SPDX-License-Identifier: MIT
#include <array>
#include <cstring>
#include <memory>

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sateen/core/colour.h"
#include "sateen/core/error.h"
#include "sateen/gpu/cache.h"
#include "sateen/gpu/context.h"
#include "sateen/gpu/framebuffer.h"
#include "sateen/gpu/program.h"
#include "sateen/gpu/shaders.h"
#include "sateen/gpu/texture.h"
#include "sateen/gpu/timer.h"

namespace sateen::gpu {
namespace {

using testing::HasSubstr;

/// Runs a fragment shader over a small framebuffer and returns what it wrote.
Image draw(std::string_view fragment, const TextureData* texture = nullptr, int width = 8, int height = 8) {
  const ShaderFile file{"test.frag", fragment};
  const Program program(std::array{shader_file("picture.vert")}, std::array{file});
  const Framebuffer target(width, height);
  target.bind();
  glDisable(GL_DEPTH_TEST);
  GLuint vertex_array = 0;
  glGenVertexArrays(1, &vertex_array);
  glBindVertexArray(vertex_array);
  program.use();
  if (program.declares("size")) {
    program.set("size", Vec2f(static_cast<float>(width), static_cast<float>(height)));
  }
  std::unique_ptr<Texture> bound;
  if (texture != nullptr) {
    bound = std::make_unique<Texture>(*texture);
    bound->bind(0);
    program.set("map", 0);
  }
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDeleteVertexArrays(1, &vertex_array);
  return target.read();
}

TextureData float_texture(TextureData::Shape shape, int width, int height, int depth,
                          const std::vector<float>& red) {
  TextureData data;
  data.shape = shape;
  data.format = TextureData::Format::rgba32f;
  data.width = width;
  data.height = height;
  data.depth = depth;
  std::vector<float> texels;
  for (const float r : red) texels.insert(texels.end(), {r, 0, 0, 1});
  data.levels.resize(1);
  data.levels[0].resize(texels.size() * sizeof(float));
  std::memcpy(data.levels[0].data(), texels.data(), data.levels[0].size());
  return data;
}

TEST(Context, OffersAtLeastOpenGl33) {
  const Context context;
  GLint major = 0;
  GLint minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  EXPECT_GE(major * 10 + minor, 33);
  EXPECT_FALSE(context.renderer().empty());
}

TEST(Context, TwoCanTakeTurnsAndComeAndGo) {
  const Context first;
  {
    const Context second;
    EXPECT_FLOAT_EQ(draw("out vec4 c; void main() { c = vec4(2.0); }").at(0, 0, 0), 2);
  }
  first.make_current();
  EXPECT_FLOAT_EQ(draw("out vec4 c; void main() { c = vec4(3.0); }").at(0, 0, 0), 3);
}

TEST(Program, ErrorsNameFileAndLine) {
  const Context context;
  try {
    draw("out vec4 c;\nvoid main() {\n  c = vec4(unknown_thing);\n}\n");
    FAIL() << "a broken shader compiled";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("shaders/test.frag:3"));
    EXPECT_THAT(error.what(), HasSubstr("unknown_thing"));
  }
}

TEST(Program, RefusesUniformsThatItsTextDoesNotDeclare) {
  const Context context;
  const ShaderFile file{
      "test.frag",
      "out vec4 c;\nuniform float used;\nuniform highp vec3 unread;\nvoid main() { c = vec4(used); }"};
  const Program program(std::array{shader_file("picture.vert")}, std::array{file});
  program.use();
  program.set("used", 1.0f);
  program.set("unread", Vec3f(1, 2, 3));  // the driver leaves it out
  EXPECT_THROW(program.set("usde", 1.0f), Error);
}

TEST(Shaders, NeededFilesComeFirstAndOnce) {
  const std::vector<std::string> names{"surface.glsl", "matcap.glsl", "surface.frag"};
  const auto files = with_needed(names);
  std::vector<std::string> order;
  for (const ShaderFile& file : files) order.emplace_back(file.name);
  EXPECT_THAT(order,
              testing::ElementsAre("surface.glsl", "matcap.glsl", "switches.glsl", "surface_varyings.glsl",
                                   "surface_packed.glsl", "eye_frame.glsl", "constant.glsl", "surface.frag"));
  EXPECT_THROW(shader_file("nothing.glsl"), Error);
}

TEST(Framebuffer, ReadsWithTheTopRowFirst) {
  const Context context;
  const Image image =
      draw("out vec4 c; uniform vec2 size; void main() { c = vec4(gl_FragCoord.xy / size, 0, 1); }", nullptr,
           5, 3);
  EXPECT_EQ(image.width, 5);
  EXPECT_EQ(image.height, 3);
  EXPECT_NEAR(image.at(0, 0, 1), 2.5 / 3, 1e-6);
  EXPECT_NEAR(image.at(4, 2, 0), 4.5 / 5, 1e-6);
  EXPECT_NEAR(image.at(4, 2, 1), 0.5 / 3, 1e-6);
}

TEST(Texture, FirstRowIsWhereVIsZeroAndFilteringIsLinear) {
  const Context context;
  const TextureData data = float_texture(TextureData::Shape::image_2d, 2, 2, 1, {0, 1, 2, 3});
  const std::string fetch =
      "out vec4 c; uniform sampler2D map; uniform vec2 size;"
      "void main() { c = texture(map, gl_FragCoord.xy / size); }";
  const Image image = draw(fetch, &data, 4, 4);
  EXPECT_NEAR(image.at(0, 3, 0), 0, 1e-5);           // lower left, clamped
  EXPECT_NEAR(image.at(0, 0, 0), 2, 1e-5);           // upper left
  EXPECT_NEAR(image.at(1, 2, 0), 0.25 + 0.5, 2e-2);  // a quarter of the way right and up
}

TEST(Texture, VolumesRepeatAlongW) {
  const Context context;
  TextureData data = float_texture(TextureData::Shape::volume_3d, 1, 1, 4, {0, 1, 2, 3});
  data.wrap_w = TextureData::Wrap::repeat;
  const std::string fetch =
      "out vec4 c; uniform sampler3D map;"
      "void main() { c = vec4(texture(map, vec3(0.5, 0.5, 0.0)).r, texture(map, vec3(0.5, 0.5, 1.375)).r, 0, "
      "0); }";
  const Image image = draw(fetch, &data);
  EXPECT_NEAR(image.at(0, 0, 0), 1.5, 2e-2);  // between the last slice and the first
  EXPECT_NEAR(image.at(0, 0, 1), 1, 2e-2);
}

TEST(Texture, CubesHaveSixFaces) {
  const Context context;
  const TextureData data = float_texture(TextureData::Shape::cube, 1, 1, 6, {1, 2, 3, 4, 5, 6});
  const std::array<const char*, 6> axes = {"1,0,0", "-1,0,0", "0,1,0", "0,-1,0", "0,0,1", "0,0,-1"};
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string fetch = fmt::format(
        "out vec4 c; uniform samplerCube map; void main() {{ c = texture(map, vec3({})); }}", axes[i]);
    EXPECT_NEAR(draw(fetch, &data).at(4, 4, 0), static_cast<double>(i) + 1, 1e-5) << axes[i];
  }
}

TEST(Texture, RowsAreReadWhateverAlignmentTheWindowLeft) {
  const Context context;
  TextureData data;
  data.format = TextureData::Format::rgba8;
  data.width = 1;
  data.height = 2;
  data.levels = {std::vector<std::byte>(8, std::byte{0})};
  data.levels[0][4] = std::byte{255};
  glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
  const Image image = draw(
      "out vec4 c; uniform sampler2D map; uniform vec2 size;"
      "void main() { c = texture(map, gl_FragCoord.xy / size); }",
      &data);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  EXPECT_NEAR(image.at(4, 0, 0), 1, 1e-5);  // the upper texel
  EXPECT_NEAR(image.at(4, 7, 0), 0, 1e-5);
}

TEST(Texture, SrgbIsDecodedOnFetch) {
  const Context context;
  TextureData data;
  data.format = TextureData::Format::srgba8;
  data.width = data.height = 1;
  data.levels = {{std::byte{128}, std::byte{128}, std::byte{128}, std::byte{255}}};
  const Image image =
      draw("out vec4 c; uniform sampler2D map; void main() { c = texture(map, vec2(0.5)); }", &data);
  EXPECT_NEAR(image.at(0, 0, 0), srgb_decode(128.0f / 255), 2e-3);
}

TEST(Texture, RefusesWrongSizes) {
  const Context context;
  TextureData data = float_texture(TextureData::Shape::image_2d, 2, 2, 1, {0, 1, 2, 3});
  data.width = 3;
  EXPECT_THROW(Texture{data}, Error);
  data.width = 1 << 24;
  EXPECT_THROW(Texture{data}, Error);
}

TEST(Cache, DataAtAnAddressThatComesBackAreOtherData) {
  const Context context;
  TextureCache cache;
  const TextureData storage = float_texture(TextureData::Shape::image_2d, 1, 1, 1, {0.5f});
  const auto held = [&] { return std::shared_ptr<const TextureData>(&storage, [](const TextureData*) {}); };
  auto data = held();
  const auto first = cache.of(data);
  EXPECT_EQ(cache.of(data), first);
  data = nullptr;
  data = held();
  EXPECT_NE(cache.of(data), first);
}

TEST(Cache, ProgramsThatNumberTheirAttributesOtherwiseAreTwo) {
  const auto numbered = [](std::vector<std::string> attributes) {
    return ProgramText{.vertex = {}, .fragment = {}, .defines = {}, .attributes = std::move(attributes)}
        .key();
  };
  EXPECT_EQ(numbered({"position", "uv"}), numbered({"position", "uv"}));
  EXPECT_NE(numbered({"position", "uv"}), numbered({"uv", "position"}));
}

TEST(Timer, CountsForward) {
  const Context context;
  const Timer timer;
  draw("out vec4 c; void main() { c = vec4(1.0); }");
  EXPECT_GT(timer.seconds(), 0);
}

}  // namespace
}  // namespace sateen::gpu
