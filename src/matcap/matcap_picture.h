// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "sateen/core/image.h"
#include "sateen/matcap/sphere_disc.h"

namespace sateen::matcap {

/// A MatCap as a file holds it, and where its sphere is.
struct MatcapPicture {
  Image image;  ///< linear light, 3 channels; where there was alpha, colour is divided by it
  Disc disc;
};

/// The most pixels across that a MatCap is read with; of more, squares of pixels are averaged. No map
/// (decomposition.h) and no screen shows them.
inline constexpr int kMostAcross = 4096;

/// Reads any picture; the sphere is found unless `disc` says where it is. Throws Error naming the file when
/// it cannot be read, is animated, CMYK or not finite, or when it shows no sphere or `disc` does not fit.
MatcapPicture read_matcap_picture(const std::filesystem::path& path, const std::optional<Disc>& disc = {});

}  // namespace sateen::matcap
