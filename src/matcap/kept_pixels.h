// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sateen/core/image.h"
#include "sateen/matcap/sphere_disc.h"

namespace sateen::matcap {

/// A pixel of the input that its sphere maps cannot give back: at a drawn sphere's edge, which they leave
/// out, and near the rim of a glossy one, where a ring of pixels shares the few texels around the view axis'
/// far end. Baking puts these pixels back as long as nothing is edited.
struct KeptPixel {
  std::uint32_t index = 0;  ///< y * width + x
  Vec3f colour{0, 0, 0};    ///< linear light
};

/// Those pixels, and the picture they were in: they say nothing about one of another size or with its sphere
/// elsewhere.
struct KeptPixels {
  int width = 0;
  int height = 0;
  Disc disc;
  std::vector<KeptPixel> pixels;
};

/// The pixels on the disc where the display values of `baked` are off by more than half of 1/255; at most an
/// eighth of the disc, the worst. Both pictures are linear, of the same size; `picture` has 3 channels. In
/// rising order of the index.
KeptPixels pixels_to_keep(const Image& picture, const Image& baked, const Disc& disc);

/// The pixels within `width` of the disc's edge.
KeptPixels pixels_of_rim(const Image& picture, const Disc& disc, double width);

/// Into a picture of that size whose sphere is at that disc; others stay as they are.
void put_back(const KeptPixels& kept, Image& picture, const Disc& disc);

/// As text for metadata: per pixel eight hexadecimal digits of its index and four of each channel's half
/// float.
std::string text_of_pixels(const std::vector<KeptPixel>& pixels);

/// Reads them back. Throws Error, saying what is wrong, unless every index is below `count` and every colour
/// finite.
std::vector<KeptPixel> pixels_of_text(std::string_view text, std::size_t count);

}  // namespace sateen::matcap
