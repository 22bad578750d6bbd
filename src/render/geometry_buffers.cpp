// SPDX-License-Identifier: MIT
#include "sateen/render/geometry_buffers.h"

#include <array>
#include <cstdint>

#include <epoxy/gl.h>

namespace sateen::render {
namespace {

enum Attribute : GLuint {
  kPosition,
  kNormal,
  kTangent,
  kMapTangent,
  kCurvatureDiagonal,
  kCurvatureOff,
#define SURFACE_FIELD(...)
#define SURFACE_VERTEX_FIELD(type, glsl, name, ...) k_##name,
#include "sateen/appearance/surface_fields.h"
};

/// What a mesh without the attribute has; generic attributes belong to the context, not to the vertex array.
void set_standard(GLuint location, double value) {
  glVertexAttrib1f(location, static_cast<GLfloat>(value));
}
void set_standard(GLuint location, const Vec2& value) {
  glVertexAttrib2f(location, static_cast<GLfloat>(value.x()), static_cast<GLfloat>(value.y()));
}

template <class T>
constexpr int kSize = T::RowsAtCompileTime;
template <>
constexpr int kSize<float> = 1;

gpu::Handle buffer(GLenum target, const void* data, std::size_t bytes) {
  GLuint name = 0;
  glGenBuffers(1, &name);
  glBindBuffer(target, name);
  glBufferData(target, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
  return {name, [](unsigned id) { glDeleteBuffers(1, &id); }};
}

std::size_t material_of(const Mesh& mesh, std::size_t triangle) {
  return mesh.material_ids.empty() ? 0 : mesh.material_ids[triangle];
}

bool winds_with_normals(const Mesh& mesh) {
  double agreement = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3f face = (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
    agreement += face.dot(mesh.normals[a] + mesh.normals[b] + mesh.normals[c]);
  }
  return agreement >= 0;
}

}  // namespace

GeometryBuffers::GeometryBuffers(const scene::Scene& scene)
    : counter_clockwise_(winds_with_normals(scene.mesh)) {
  const Mesh& mesh = scene.mesh;
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  vertex_array_ = gpu::Handle(name, [](unsigned id) { glDeleteVertexArrays(1, &id); });
  glBindVertexArray(name);

  const auto attribute = [&](GLuint location, const auto& values, int components) {
    if (values.empty()) return;
    buffers_.push_back(buffer(GL_ARRAY_BUFFER, values.data(), values.size() * sizeof(values[0])));
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, components, GL_FLOAT, GL_FALSE, 0, nullptr);
  };
  attribute(kPosition, mesh.positions, 3);
  attribute(kNormal, mesh.normals, 3);
  attribute(kTangent, mesh.tangents, 4);
  attribute(kMapTangent, scene.map_tangents.empty() ? mesh.tangents : scene.map_tangents, 4);
#define SURFACE_FIELD(...)
#define SURFACE_VERTEX_FIELD(type, glsl, name, aov, input, mesh_array, ...) \
  attribute(k_##name, mesh.mesh_array, kSize<std::decay_t<decltype(mesh.mesh_array[0])>>);
#include "sateen/appearance/surface_fields.h"
  if (!mesh.curvature_forms.empty()) {
    attribute(kCurvatureDiagonal, mesh.curvature_forms, 3);
    const auto stride = static_cast<GLsizei>(sizeof(mesh.curvature_forms[0]));
    glVertexAttribPointer(kCurvatureDiagonal, 3, GL_FLOAT, GL_FALSE, stride, nullptr);
    glEnableVertexAttribArray(kCurvatureOff);
    glVertexAttribPointer(kCurvatureOff, 3, GL_FLOAT, GL_FALSE, stride,
                          reinterpret_cast<const void*>(sizeof(Vec3f)));
  }

  // A counting sort of the triangles by material.
  const std::size_t count = mesh.triangles.size();
  first_index_.assign(scene.materials.size() + 1, 0);
  for (std::size_t i = 0; i < count; ++i) first_index_[material_of(mesh, i) + 1] += 3;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) first_index_[m + 1] += first_index_[m];
  std::vector<std::uint32_t> indices(count * 3);
  std::vector<std::size_t> next(first_index_.begin(), first_index_.end() - 1);
  for (std::size_t i = 0; i < count; ++i) {
    for (const std::uint32_t vertex : mesh.triangles[i]) indices[next[material_of(mesh, i)]++] = vertex;
  }
  buffers_.push_back(buffer(GL_ELEMENT_ARRAY_BUFFER, indices.data(), indices.size() * sizeof(std::uint32_t)));
}

void GeometryBuffers::draw(std::size_t material) const {
  const std::size_t first = first_index_[material];
  const std::size_t count = first_index_[material + 1] - first;
  if (count == 0) return;
  glBindVertexArray(vertex_array_.name());
  glVertexAttrib4f(kTangent, 1, 0, 0, 1);
  glVertexAttrib4f(kMapTangent, 1, 0, 0, 1);
  glVertexAttrib3f(kCurvatureDiagonal, 0, 0, 0);
  glVertexAttrib3f(kCurvatureOff, 0, 0, 0);
  const appearance::Surface standard;
#define SURFACE_FIELD(...)
#define SURFACE_VERTEX_FIELD(type, glsl, name, ...) set_standard(k_##name, standard.name);
#include "sateen/appearance/surface_fields.h"
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(first * sizeof(std::uint32_t)));
}

}  // namespace sateen::render
