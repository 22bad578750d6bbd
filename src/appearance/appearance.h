// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "sateen/appearance/surface.h"
#include "sateen/core/image.h"
#include "sateen/core/texture_data.h"
#include "sateen/core/vector.h"

namespace sateen::appearance {

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

}  // namespace sateen::appearance
