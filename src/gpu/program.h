// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sateen/appearance/shader_module.h"
#include "sateen/gpu/handle.h"
#include "sateen/gpu/shaders.h"

namespace sateen::gpu {

/// Preprocessor definitions put in front of both stages.
using Defines = appearance::ShaderDefines;

/// All a program is made from. The files' texts are views: whoever owns them outlives this.
struct ProgramText {
  std::vector<ShaderFile> vertex;
  std::vector<ShaderFile> fragment;
  Defines defines = {};
  std::vector<std::string> attributes = {};  ///< vertex attributes by location

  enum class Stage { vertex, fragment };
  /// One stage as it stands before the driver, behind `header` (#version and precisions).
  std::string stage(Stage stage, const std::string& header) const;
  /// Equal for equal programs.
  std::string key() const;
};

/// The lines in front of every stage in desktop GLSL 3.30.
extern const std::string kDesktopHeader;

/// A linked pair of shaders in desktop GLSL 3.30.
class Program {
 public:
  /// Throws Error with the driver's message, file and line when the text does not compile or link.
  explicit Program(const ProgramText& text);
  Program(std::span<const ShaderFile> vertex, std::span<const ShaderFile> fragment,
          const Defines& defines = {}, std::span<const std::string> attributes = {});

  void use() const;

  /// Whether the text declares a uniform of that name; the driver may still have left it out where nothing
  /// reads it.
  bool declares(const std::string& name) const { return uniforms_.contains(name); }

  /// Sets a uniform; the program must be in use. Throws Error for a name that the text does not declare.
  void set(const std::string& name, const appearance::UniformValue& value) const;

 private:
  Handle handle_;
  std::map<std::string, int> uniforms_;  ///< declared ones, with their locations, -1 where left out
};

}  // namespace sateen::gpu
