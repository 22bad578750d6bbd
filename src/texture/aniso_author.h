// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "sateen/core/progress.h"
#include "sateen/texture/anisotropy.h"

namespace sateen::texture {

/// A channel of a picture, or one value everywhere.
struct MapInput {
  std::filesystem::path file;  ///< empty: `value`
  int channel = 0;
  double value = 0;
};

/// "0.4" is a value; anything else a file, with an optional ":r", ":g", ":b" or ":a" for the channel.
MapInput parse_map_input(const std::string& text);

/// How the inputs of authoring are meant (brdf/conventions.h).
enum class AnisotropyStyle { uv, gltf, blender, substance, materialx, filament };
AnisotropyStyle anisotropy_style_from_name(const std::string& name);

/// The inputs of a material. Which are read depends on the style; those given beyond are the caller's
/// mistake.
struct AuthorInputs {
  AnisotropyStyle style = AnisotropyStyle::uv;
  MapInput along{{}, 0, 0.5};      ///< uv: roughness along the axis
  MapInput across{{}, 0, 0.5};     ///< uv: roughness across it
  bool gloss = false;              ///< uv: both are gloss, 1 - roughness
  MapInput roughness{{}, 0, 0.5};  ///< the other styles
  MapInput amount;    ///< glTF strength, Blender's anisotropic, Substance's level, the others' anisotropy
  MapInput rotation;  ///< all styles: turns in a value, a map of 1 is `turns_at_one`
  double turns_at_one = 1;
  /// A direction map instead of `rotation`: red and green hold x / 2 + 1/2, y / 2 + 1/2 of the axis (y up).
  /// With glTF, blue is the strength, multiplied by `amount`, and `rotation` (a value) turns the vectors.
  std::filesystem::path vectors;
};

/// Writes the anisotropy map of the inputs, row by row: .png with 8 or 16 bits or .exr. All maps need the
/// same size; without any map the result is 4 x 4. Throws Error naming the file that is missing, damaged, or
/// differs in size.
void author_anisotropy(const AuthorInputs& inputs, const std::filesystem::path& output,
                       AnisotropyEncoding encoding, int bits = 16, const Progress& progress = {});

/// What decode_anisotropy_map writes, three channels each.
enum class DecodeStyle {
  alphas,  ///< alpha_t, alpha_b, angle / pi
  uv,      ///< roughness along, across, rotation in half turns
  gltf,  ///< the KHR_materials_anisotropy texture: direction x, y, strength; roughness goes to a second file
  blender,    ///< roughness, anisotropic, rotation in turns
  substance,  ///< roughness, level, angle in turns
  materialx,  ///< roughness, anisotropy, rotation in turns
  filament,   ///< the same
};
DecodeStyle decode_style_from_name(const std::string& name);

/// Turns an anisotropy map back into what other programs read; returns the files written (for glTF also
/// NAME_roughness). Throws Error as author_anisotropy.
std::vector<std::filesystem::path> decode_anisotropy_map(const std::filesystem::path& map,
                                                         AnisotropyEncoding encoding, DecodeStyle style,
                                                         const std::filesystem::path& output, int bits = 16,
                                                         const Progress& progress = {});

}  // namespace sateen::texture
