// SPDX-License-Identifier: MIT
#include "sateen/render/geometry_buffers.h"

#include <array>
#include <cstdint>

#include <epoxy/gl.h>

namespace sateen::render {
namespace {

enum Attribute : GLuint { kPosition, kNormal, kTangent, kMapTangent, kUv, kOcclusion, kCurvature };

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

std::span<const std::string> GeometryBuffers::attributes() {
  static const std::array<std::string, 7> names{
      "in_position", "in_normal", "in_tangent", "in_map_tangent", "in_uv", "in_occlusion", "in_curvature"};
  return names;
}

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
  attribute(kUv, mesh.uvs, 2);
  attribute(kOcclusion, mesh.occlusion, 1);
  attribute(kCurvature, mesh.curvature, 1);

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
  // What a mesh without the attribute has; these belong to the context, not to the vertex array.
  glVertexAttrib4f(kTangent, 1, 0, 0, 1);
  glVertexAttrib4f(kMapTangent, 1, 0, 0, 1);
  glVertexAttrib2f(kUv, 0, 0);
  glVertexAttrib1f(kOcclusion, 1);
  glVertexAttrib1f(kCurvature, 0);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(first * sizeof(std::uint32_t)));
}

}  // namespace sateen::render
