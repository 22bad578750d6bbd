// SPDX-License-Identifier: MIT
#include "sateen/appearance/surface.h"

#include <array>

namespace sateen::appearance {
namespace {

template <class T>
constexpr int kComponents = T::RowsAtCompileTime;
template <>
constexpr int kComponents<double> = 1;
template <>
constexpr int kComponents<int> = 1;

void take(std::span<const float> from, double& value) {
  value = from[0];
}
void take(std::span<const float> from, int& value) {
  value = static_cast<int>(from[0]);
}
template <class Vector>
void take(std::span<const float> from, Vector& value) {
  for (int i = 0; i < value.size(); ++i) value[i] = from[static_cast<std::size_t>(i)];
}

constexpr auto kFields = [] {
  std::array fields{
#define SURFACE_FIELD(type, glsl, name, aov, input, meaning, ...) \
  SurfaceFieldInfo{SurfaceField::name, #name, aov, input, meaning, 0, kComponents<type>},
#include "sateen/appearance/surface_fields.h"
  };
  int first = 0;
  for (SurfaceFieldInfo& field : fields) {
    field.first = first;
    first += field.components;
  }
  return fields;
}();

}  // namespace

std::span<const SurfaceFieldInfo> surface_fields() {
  return kFields;
}

const SurfaceFieldInfo& surface_field(SurfaceField field) {
  return kFields[static_cast<std::size_t>(field)];
}

int packed_components() {
  return kFields.back().first + kFields.back().components;
}

void set_field(Surface& surface, SurfaceField field, std::span<const float> components) {
  switch (field) {
#define SURFACE_FIELD(type, glsl, name, ...) \
  case SurfaceField::name:                   \
    take(components, surface.name);          \
    break;
#include "sateen/appearance/surface_fields.h"
  }
}

Surface unpacked(std::span<const float> components) {
  Surface surface;
  for (const SurfaceFieldInfo& field : kFields) {
    set_field(surface, field.field, components.subspan(static_cast<std::size_t>(field.first)));
  }
  return surface;
}

}  // namespace sateen::appearance
