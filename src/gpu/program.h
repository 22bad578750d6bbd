// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sateen/appearance/appearance.h"
#include "sateen/gpu/handle.h"
#include "sateen/gpu/shaders.h"

namespace sateen::gpu {

/// Preprocessor definitions put in front of both stages.
using Defines = std::vector<std::pair<std::string, std::string>>;

/// A linked pair of shaders in desktop GLSL 3.30.
class Program {
 public:
  /// The stages' texts in order. Vertex attributes get the locations of `attributes` by position.
  /// Throws Error with the driver's message, file and line when the text does not compile or link.
  Program(std::span<const ShaderFile> vertex, std::span<const ShaderFile> fragment,
          const Defines& defines = {}, std::span<const std::string> attributes = {});

  void use() const;

  /// Sets a uniform; the program must be in use. A name the compiled program does not read is ignored: a
  /// variant may not need what another does.
  void set(const std::string& name, const appearance::UniformValue& value) const;

 private:
  Handle handle_;
};

}  // namespace sateen::gpu
