// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/vector.h"

namespace sateen {

/// How light that a scene sends, which has no upper end, becomes light that a display shows, at most 1.
enum class ViewTransform {
  none,     ///< clamped; pictures of 8 bits hold the linear values themselves, without the sRGB curve
  srgb,     ///< clamped: what pictures of 8 bits held before there was a choice
  neutral,  ///< Khronos PBR Neutral: colours below 0.8 stay, but for 0.04; brighter ones roll off and lose
            ///< colour
  agx,      ///< AgX without a look: 16.5 stops in an S-curve, bright colours fade to white as on film
};

/// The brightest light that is told from brighter light, so that an infinity is white and nothing worse.
inline constexpr double kBrightestShown = 1e6;

/// Light the display shows for light of the scene, both linear with Rec. 709 primaries; in [0, 1]. Light
/// below 0 counts as 0. The sRGB curve is not in it: io::write_image puts that on.
///
/// neutral: Khronos, PBR Neutral Tone Mapper specification (KhronosGroup/ToneMapping).
/// agx: Sobotka's AgX with Rec. 2020 primaries as Filament and three.js have it, its curve by the polynomial
/// of sixth degree from iolite's "Minimal AgX implementation". shaders/view_transform.glsl has the same.
Vec3 shown_light(ViewTransform view, const Vec3& light);

}  // namespace sateen
