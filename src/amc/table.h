// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "sateen/core/image.h"
#include "sateen/core/vector.h"

namespace sateen::amc {

/// How an AMC's texels are stored in files and on the GPU. In memory they are always linear halves.
enum class AmcEncoding {
  srgb8,  ///< 8 bits a channel, sRGB transfer; clips at 1
  half,   ///< 16-bit floats, linear
};

/// An Anisotropic MatCap (Magri, Cignoni, Tarini, section 4): the colour of a material under one fixed light,
/// for every normal the viewer can see and every direction of the tangent in the picture plane.
///
/// Texel (x, y, f) holds the colour for n_x = 2 (x + 0.5) / size - 1, n_y = 2 (y + 0.5) / size - 1 (y grows
/// upwards: this is a texture, not a picture) and the tangent angle k = f / (symmetry * slices) turns,
/// counter-clockwise from +x. Texels outside the unit disc are filled from the rim. Angles repeat after 1 /
/// symmetry of a turn.
struct AmcTable {
  int size = 0;            ///< S, texels along n_x and n_y
  int slices = 0;          ///< S_k, tangent angles in one period
  int symmetry = 1;        ///< R: the material looks the same turned by 1/R of a turn
  bool isotropic = false;  ///< every turn looks alike
  AmcEncoding encoding = AmcEncoding::half;
  std::map<std::string, std::string> provenance;  ///< where it came from: free key/value text, kept in files
  std::vector<Half> texels;                       ///< RGBA, alpha 1; index ((f * size + y) * size + x) * 4

  AmcTable() = default;
  /// A black table. Throws Error unless size and slices are in [1, 2048] and symmetry in [1, 16].
  AmcTable(int size, int slices, int symmetry);

  std::size_t index(int x, int y, int slice) const {
    return ((static_cast<std::size_t>(slice) * static_cast<std::size_t>(size) + static_cast<std::size_t>(y)) *
                static_cast<std::size_t>(size) +
            static_cast<std::size_t>(x)) *
           4;
  }
  Vec3f texel(int x, int y, int slice) const;
  void set_texel(int x, int y, int slice, const Vec3f& colour);

  /// Tangent angle of a slice, turns.
  double slice_angle(int slice) const { return static_cast<double>(slice) / (symmetry * slices); }
};

/// One slice as a size x size picture (RGB, row 0 on top), and back.
Image slice_image(const AmcTable& table, int slice);
void set_slice_image(AmcTable& table, int slice, const Image& image);

/// The mean of all slices (section 5.3): the isotropic MatCap nearest to the material. RGB, row 0 on top.
Image isotropic_average(const AmcTable& table);

/// Rounds every texel to what `table.encoding` can hold, so that memory, file and GPU agree bit for bit.
void quantise(AmcTable& table);

/// The texels as their encoding stores them (rgba8 sRGB or rgba16f), in table order, and back.
std::vector<std::byte> encoded_texels(const AmcTable& table);
void set_encoded_texels(AmcTable& table, const std::vector<std::byte>& bytes);

}  // namespace sateen::amc
