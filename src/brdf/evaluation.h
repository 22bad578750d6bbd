// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "sateen/core/vector.h"

namespace sateen::brdf {

/// Unit directions in the shading frame (tangent x, bitangent y, normal z) that point away from the surface.
struct DirectionPair {
  Vec3 light;
  Vec3 view;
};

/// A model with its parameters: the value (r, g, b) for a pair of directions. Safe to call from several
/// threads.
using BrdfFunction = std::function<Vec3(const DirectionPair&)>;

/// Names read_brdf knows: "fibre-diffuse", "ggx", "fuzz".
std::span<const std::string> brdf_models();

/// A model with parameters from a JSON object; docs/materials.md lists the keys. `where` names the source in
/// messages. Values are BRDFs without the cosine (1/sr), Phi for fibre-diffuse, and for fuzz whatever "term"
/// names. Throws Error naming file, key and value for a wrong one, and for keys the model does not know.
BrdfFunction read_brdf(const std::string& model, const std::filesystem::path& parameters);
BrdfFunction parse_brdf(const std::string& model, const std::string& json, const std::string& where);

/// A JSON list of {"light": [x, y, z], "view": [x, y, z]}; lengths are normalised away. Throws Error naming
/// the file and the entry.
std::vector<DirectionPair> read_direction_pairs(const std::filesystem::path& path);

/// Writes a JSON list of [r, g, b], one line each. Atomic.
void write_values(const std::filesystem::path& path, std::span<const Vec3> values);

}  // namespace sateen::brdf
