// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sateen::gpu {

/// One text file of shaders/, embedded in the library by cmake/shaders.cmake.
struct ShaderFile {
  std::string_view name;  ///< "matcap.glsl"
  std::string_view text;
};

/// All of them.
std::span<const ShaderFile> embedded_shaders();

/// The named file. Throws Error for an unknown name.
const ShaderFile& shader_file(std::string_view name);

/// `names` in order, each after the files that its "// needs:" lines name, every file once. Throws Error for
/// an unknown name.
std::vector<ShaderFile> with_needed(std::span<const std::string> names);
/// The same for texts of which some are not embedded.
std::vector<ShaderFile> with_needed(std::span<const ShaderFile> files);

}  // namespace sateen::gpu
