// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "sateen/core/image.h"
#include "sateen/matcap/edited_matcap.h"

namespace sateen::matcap {

/// An ordinary MatCap of the size and with the disc that `matcap` says, the input's or another, linear light,
/// 3 channels; off the sphere the rim's colour goes on outwards, so that filtering never sees a background.
Image bake(const EditedMatcap& matcap);

/// The two layers Blender's MatCap mode reads, "diffuse" and "specular", linear light: they add up to bake().
/// Where the parts add up in display values, specular is what the high part adds to the light of the low
/// part.
std::array<Image, 2> bake_layers(const EditedMatcap& matcap);

/// The light of one component, turned and multiplied by its colour, as a latitude-longitude map of 2 height x
/// height pixels, linear light, see direction_of_environment. High-frequency light is what the mirror
/// direction sees.
Image bake_environment(const EditedMatcap& matcap, Part part, int height);

/// The unit direction of a pixel of a latitude-longitude map: the middle of the picture looks along -z, into
/// the screen, columns run to +x, rows from +y down.
Vec3 direction_of_environment(int x, int y, int height);

/// Peak signal-to-noise ratio in dB between two pictures over the sphere, of display values: 1 is the peak.
double psnr_on_disc(const Image& a, const Image& b, const Disc& disc);

}  // namespace sateen::matcap
