// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sateen/core/texture_data.h"
#include "sateen/core/vector.h"

namespace sateen::appearance {

/// Preprocessor definitions put in front of a program's texts: name and value.
using ShaderDefines = std::vector<std::pair<std::string, std::string>>;

/// A piece of GLSL in the ES 3.00 subset, without #version. A line "// needs: a.glsl b.glsl" names files of
/// shaders/ that have to come before it.
struct ShaderText {
  std::string name;  ///< what messages call it; of an embedded file "matcap.glsl"
  std::string text;  ///< empty: the embedded file of that name
  bool operator==(const ShaderText&) const = default;
};

/// The program an appearance is drawn with, without any value: equal modules share one compiled program.
///
/// Baked light declares `vec3 ENTRY(Surface s)`. Reflectance declares the struct POINT, what one point has in
/// common for all lights, and
///   POINT ENTRY_at(Surface s);
///   vec3 ENTRY_lit(POINT p, vec3 light);     light of unit irradiance from a direction in view space
///   vec3 ENTRY_surroundings(POINT p);        the light of the surroundings (shaders/light/environment.glsl)
/// and shaders/light/lit.glsl has the one loop over lamps. Occlusion is applied outside for reflectance,
/// inside for baked light. An appearance with holes or depth declares `float ENTRY_cover(inout Surface s)`
/// too: below 1/2 the surface is not there, and s may be changed.
struct ShaderModule {
  std::vector<ShaderText> texts = {};
  ShaderDefines defines = {};
  std::string entry = {};
  std::string point = {};  ///< empty: baked light
  bool covers = false;     ///< declares ENTRY_cover
  bool operator==(const ShaderModule&) const = default;
};

using UniformValue = std::variant<int, float, Vec2f, Vec3f, Vec4f, Eigen::Matrix3f, Eigen::Matrix4f,
                                  std::vector<Vec3f>, std::vector<Vec4f>>;

struct UniformBinding {
  std::string name;
  UniformValue value;
  bool optional = false;  ///< a program whose text does not declare it is no error
};

struct TextureBinding {
  std::string sampler;  ///< name of the sampler uniform
  /// Held on the GPU as long as it lives: bind the same one again and nothing is uploaded.
  std::shared_ptr<const TextureData> texture;
};

/// What a module's uniforms and samplers hold; cheap to make and to bind again.
struct ShaderValues {
  std::vector<UniformBinding> uniforms = {};
  std::vector<TextureBinding> textures = {};
};

}  // namespace sateen::appearance
