// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "sateen/core/image.h"
#include "sateen/core/vector.h"

namespace sateen {

/// A surface point as an appearance sees it. The `Surface` struct of shaders/surface.glsl has the same
/// fields.
struct Surface {
  Vec3 position{0, 0, 0};     ///< view space; the eye is at the origin under perspective
  Vec3 normal{0, 0, 1};       ///< view space, unit
  Vec3 mesh_normal{0, 0, 1};  ///< the same before any normal map
  Vec3 tangent{1, 0, 0};      ///< view space, unit, orthogonal to the normal
  double side = 1;            ///< 1 on the front; -1 on the back, whose normal is turned to the viewer
  double bitangent_sign = 1;  ///< bitangent = bitangent_sign * cross(normal, tangent)
  Vec3 view{0, 0, 1};         ///< view space, unit, from the point towards the eye
  Vec3 eye_normal{0, 0,
                  1};  ///< the normal in the eye frame (direction.h): its (x, y) indexes MatCap-like tables
  double tangent_angle =
      0;  ///< k in turns: angle of the eye-frame tangent in the picture plane, [0, 1) or a period more
  Vec2 uv{0, 0};         ///< v up
  double occlusion = 1;  ///< ambient occlusion, 1 is open
  double curvature = 0;  ///< 1 / view-space unit, positive where convex
  int material = 0;      ///< index of the mesh's material
};

/// A texture as plain data: what an appearance asks the GPU to hold.
struct TextureData {
  enum class Shape { image_2d, volume_3d, array_2d, cube };
  enum class Format {
    rgba8,    ///< 4 bytes, linear
    srgba8,   ///< 4 bytes, colour decoded from sRGB on fetch
    rgba16f,  ///< 4 halves
    rgba32f,  ///< 4 floats
    rg32f,    ///< 2 floats
  };
  enum class Wrap { clamp, repeat };

  Shape shape = Shape::image_2d;
  Format format = Format::rgba16f;
  int width = 0;
  int height = 0;
  int depth = 1;  ///< slices of a volume, layers of an array, 6 for a cube
  Wrap wrap_u = Wrap::clamp;
  Wrap wrap_v = Wrap::clamp;
  Wrap wrap_w = Wrap::clamp;
  bool generate_mipmaps = false;  ///< otherwise exactly the given levels are used
  /// One tightly packed array a mip level, layer by layer, row 0 first. Row 0 is where the texture coordinate
  /// v is 0: pictures (row 0 on top) are flipped by whoever fills this.
  std::vector<std::vector<std::byte>> levels;
};

struct TextureBinding {
  std::string sampler;  ///< name of the sampler uniform
  std::shared_ptr<const TextureData> texture;
};

using UniformValue = std::variant<int, float, Vec2f, Vec3f, Vec4f, Eigen::Matrix3f, Eigen::Matrix4f,
                                  std::vector<Vec3f>, std::vector<Vec4f>>;

struct UniformBinding {
  std::string name;
  UniformValue value;
};

/// The GPU face of an appearance: which shader files (in order, from shaders/), which function `vec3
/// f(Surface)`, and what they read.
struct ShaderBinding {
  std::vector<std::string> files;
  std::string function;
  std::vector<UniformBinding> uniforms;
  std::vector<TextureBinding> textures;
};

/// What turns a surface point into a colour. Renderer and `sateen shade` know nothing else about a model.
class Appearance {
 public:
  struct Needs {
    bool tangents = false;  ///< without tangents on the mesh the renderer refuses, with a message
    bool uvs = false;
    bool curvature = false;
  };

  virtual ~Appearance() = default;

  /// Linear radiance towards the eye, the publication's formula in double precision; occlusion included.
  virtual Vec3 evaluate(const Surface& surface) const = 0;
  virtual ShaderBinding shader() const = 0;
  virtual Needs needs() const { return {}; }
  /// Lights the surface with a latitude-longitude picture (light/environment.h), for appearances that are lit
  /// at all; false: its light is baked in, and nothing changed.
  virtual bool set_environment(const Image&) { return false; }
  /// R: turning the tangent by 1/R of a turn changes nothing. The renderer interpolates tangent angles modulo
  /// 1/R.
  virtual int tangent_symmetry() const { return 1; }
};

}  // namespace sateen
