// SPDX-License-Identifier: MIT
#include "sateen/gpu/program.h"

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

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

StageText stage_text(std::span<const ShaderFile> files, const Defines& defines, const std::string& header) {
  StageText stage;
  stage.text = header;
  for (const auto& [name, value] : defines) stage.text += fmt::format("#define {} {}\n", name, value);
  for (const ShaderFile& file : files) {
    stage.first_lines.push_back(std::ranges::count(stage.text, '\n') + 1);
    stage.text += fmt::format("{}\n", file.text);
  }
  return stage;
}

/// The names that the texts declare as uniforms.
std::set<std::string> declared_uniforms(std::span<const ShaderFile> files) {
  static const std::regex declaration(R"(\buniform\s+(?:(?:lowp|mediump|highp)\s+)?\w+\s+(\w+))");
  std::set<std::string> names;
  for (const ShaderFile& file : files) {
    const char* begin = file.text.data();
    for (std::cregex_iterator at(begin, begin + file.text.size(), declaration); at != std::cregex_iterator();
         ++at) {
      names.insert((*at)[1].str());
    }
  }
  return names;
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
  const StageText text = stage_text(files, defines, kDesktopHeader);
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

const std::string kDesktopHeader =
    "#version 330 core\nprecision highp float;\nprecision highp int;\nprecision highp sampler3D;\n";

std::string ProgramText::stage(Stage which, const std::string& header) const {
  return stage_text(which == Stage::vertex ? vertex : fragment, defines, header).text;
}

std::string ProgramText::key() const {
  return fmt::format("{}\n{}\n{}", stage(Stage::vertex, ""), stage(Stage::fragment, ""),
                     fmt::join(attributes, ","));
}

Program::Program(const ProgramText& text)
    : Program(text.vertex, text.fragment, text.defines, text.attributes) {}

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
  for (const auto& files : {vertex, fragment}) {
    for (const std::string& name : declared_uniforms(files)) {
      uniforms_[name] = glGetUniformLocation(handle_.name(), name.c_str());
    }
  }
}

void Program::use() const {
  glUseProgram(handle_.name());
}

void Program::set(const std::string& name, const appearance::UniformValue& value) const {
  const auto found = uniforms_.find(name);
  if (found == uniforms_.end()) throw Error(fmt::format("the shader declares no uniform \"{}\"", name));
  if (found->second >= 0) std::visit(SetUniform{found->second}, value);
}

}  // namespace sateen::gpu
