// SPDX-License-Identifier: MIT
#include "sateen/gpu/program.h"

#include <algorithm>
#include <regex>
#include <sstream>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "sateen/core/error.h"

namespace sateen::gpu {
namespace {

template <typename GetParameter, typename GetLog>
std::string info_log(unsigned name, GetParameter get_parameter, GetLog get_log) {
  GLint length = 0;
  get_parameter(name, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  get_log(name, length, nullptr, log.data());
  while (!log.empty() && (log.back() == '\0' || log.back() == '\n')) log.pop_back();
  return log;
}

/// A stage's whole text and where each file begins in it.
struct StageText {
  std::string text;
  std::vector<long> first_lines;  ///< by file, counted from 1
};

StageText stage_text(std::span<const ShaderFile> files, const Defines& defines) {
  StageText stage;
  stage.text =
      "#version 330 core\nprecision highp float;\nprecision highp int;\nprecision highp sampler3D;\n";
  for (const auto& [name, value] : defines) stage.text += fmt::format("#define {} {}\n", name, value);
  for (const ShaderFile& file : files) {
    stage.first_lines.push_back(std::ranges::count(stage.text, '\n') + 1);
    stage.text += fmt::format("{}\n", file.text);
  }
  return stage;
}

/// Drivers report places as "0:12(5)" or "0(12)", 12 being the line of the whole text (what #line says of
/// files is not kept by all of them): puts file and line there.
std::string with_file_names(const std::string& log, const StageText& stage,
                            std::span<const ShaderFile> files) {
  static const std::regex place(R"(^(?:ERROR: )?\d+[:(](\d+)\)?)");
  std::string result;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_search(line, match, place)) {
      const long number = std::stol(match[1].str());
      const auto next = std::ranges::upper_bound(stage.first_lines, number);
      if (next != stage.first_lines.begin()) {
        const auto index = static_cast<std::size_t>(next - stage.first_lines.begin() - 1);
        line = fmt::format("shaders/{}:{}{}", files[index].name, number - stage.first_lines[index] + 1,
                           match.suffix().str());
      }
    }
    result += (result.empty() ? "" : "\n") + line;
  }
  return result;
}

Handle compile(unsigned stage, std::span<const ShaderFile> files, const Defines& defines) {
  const StageText text = stage_text(files, defines);
  Handle shader(glCreateShader(stage), [](unsigned name) { glDeleteShader(name); });
  const char* pointer = text.text.c_str();
  glShaderSource(shader.name(), 1, &pointer, nullptr);
  glCompileShader(shader.name());
  GLint done = 0;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &done);
  if (done == 0) {
    const std::string log = info_log(
        shader.name(), [](auto... a) { glGetShaderiv(a...); }, [](auto... a) { glGetShaderInfoLog(a...); });
    throw Error("a shader does not compile: " + with_file_names(log, text, files));
  }
  return shader;
}

/// How each alternative of UniformValue reaches the driver.
struct SetUniform {
  GLint location;
  void operator()(int v) const { glUniform1i(location, v); }
  void operator()(float v) const { glUniform1f(location, v); }
  void operator()(const Vec2f& v) const { glUniform2fv(location, 1, v.data()); }
  void operator()(const Vec3f& v) const { glUniform3fv(location, 1, v.data()); }
  void operator()(const Vec4f& v) const { glUniform4fv(location, 1, v.data()); }
  void operator()(const Eigen::Matrix3f& v) const { glUniformMatrix3fv(location, 1, GL_FALSE, v.data()); }
  void operator()(const Eigen::Matrix4f& v) const { glUniformMatrix4fv(location, 1, GL_FALSE, v.data()); }
  void operator()(const std::vector<Vec3f>& v) const {
    if (!v.empty()) glUniform3fv(location, static_cast<GLsizei>(v.size()), v.front().data());
  }
  void operator()(const std::vector<Vec4f>& v) const {
    if (!v.empty()) glUniform4fv(location, static_cast<GLsizei>(v.size()), v.front().data());
  }
};

}  // namespace

Program::Program(std::span<const ShaderFile> vertex, std::span<const ShaderFile> fragment,
                 const Defines& defines, std::span<const std::string> attributes) {
  const Handle vertex_shader = compile(GL_VERTEX_SHADER, vertex, defines);
  const Handle fragment_shader = compile(GL_FRAGMENT_SHADER, fragment, defines);
  handle_ = Handle(glCreateProgram(), [](unsigned name) { glDeleteProgram(name); });
  glAttachShader(handle_.name(), vertex_shader.name());
  glAttachShader(handle_.name(), fragment_shader.name());
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    glBindAttribLocation(handle_.name(), static_cast<GLuint>(i), attributes[i].c_str());
  }
  glLinkProgram(handle_.name());
  GLint done = 0;
  glGetProgramiv(handle_.name(), GL_LINK_STATUS, &done);
  if (done == 0) {
    throw Error("shaders do not link: " + info_log(
                                              handle_.name(), [](auto... a) { glGetProgramiv(a...); },
                                              [](auto... a) { glGetProgramInfoLog(a...); }));
  }
}

void Program::use() const {
  glUseProgram(handle_.name());
}

void Program::set(const std::string& name, const appearance::UniformValue& value) const {
  const GLint location = glGetUniformLocation(handle_.name(), name.c_str());
  if (location >= 0) std::visit(SetUniform{location}, value);
}

}  // namespace sateen::gpu
