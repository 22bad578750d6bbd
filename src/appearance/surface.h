// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "sateen/core/vector.h"

namespace sateen::appearance {

/// A surface point as an appearance sees it, in C++ and in GLSL: the rows of surface_fields.h, which say
/// what each field means. Directions are unit vectors in view space (x right, y up, z towards the viewer).
struct Surface {
#define SURFACE_FIELD(type, glsl, name, aov, input, meaning, ...) type name{__VA_ARGS__};
#include "sateen/appearance/surface_fields.h"
};

/// The fields by name.
enum class SurfaceField {
#define SURFACE_FIELD(type, glsl, name, ...) name,
#include "sateen/appearance/surface_fields.h"
};

/// What is said of a field besides its value. Packed, a Surface is a row of floats in which each field has
/// its place.
struct SurfaceFieldInfo {
  SurfaceField field;
  std::string_view name;
  std::string_view aov;      ///< name among the output variables of a rendered picture; empty: none
  std::string_view input;    ///< name among the pictures that `sateen shade` takes; empty: none
  std::string_view meaning;  ///< one line
  int first;                 ///< component of a packed surface
  int components;
};

/// All fields in the order of the struct.
std::span<const SurfaceFieldInfo> surface_fields();
const SurfaceFieldInfo& surface_field(SurfaceField field);

/// Floats of a packed Surface.
int packed_components();
/// The field's value from its components, as many as surface_field(field).components.
void set_field(Surface& surface, SurfaceField field, std::span<const float> components);
/// A whole packed surface.
Surface unpacked(std::span<const float> components);

}  // namespace sateen::appearance
