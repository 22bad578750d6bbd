// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/texture/anisotropy.h"

namespace sateen {

// What other programs call anisotropy, in and out of the lobe of anisotropy.h. Rotations are in turns,
// counter-clockwise from U towards V (V up). Out of range values are clamped.

/// Two roughnesses along and across an axis, as in the slides' authoring node: alpha = roughness^2. (Gloss is
/// 1 - roughness.)
struct UvRoughness {
  double along = 0.5;
  double across = 0.5;
  double rotation = 0;  ///< of the axis
};
AnisotropicRoughness lobe_of(const UvRoughness& style);
UvRoughness uv_roughness_of(const AnisotropicRoughness& lobe);

/// glTF KHR_materials_anisotropy: the highlight stretches along the rotation; alpha_t = mix(roughness^2, 1,
/// strength^2), alpha_b = roughness^2.
struct GltfAnisotropy {
  double roughness = 0.5;
  double strength = 0;
  double rotation = 0;
};
AnisotropicRoughness lobe_of(const GltfAnisotropy& style);
GltfAnisotropy gltf_of(const AnisotropicRoughness& lobe);

/// Blender's Principled BSDF (Burley 2012): aspect = sqrt(1 - 0.9 anisotropic), alphas roughness^2 / aspect
/// along the rotation and roughness^2 * aspect across. No ratio of alphas beyond 10 : 1.
struct BlenderAnisotropy {
  double roughness = 0.5;
  double anisotropic = 0;
  double rotation = 0;
};
AnisotropicRoughness lobe_of(const BlenderAnisotropy& style);
BlenderAnisotropy blender_of(const AnisotropicRoughness& lobe);

/// Substance 3D Painter's metal/rough anisotropy shader: roughness along the angle, roughness / sqrt(1 -
/// level) across: the highlight stretches across the angle.
struct SubstanceAnisotropy {
  double roughness = 0.5;
  double level = 0;
  double angle = 0;  ///< turns
};
AnisotropicRoughness lobe_of(const SubstanceAnisotropy& style);
SubstanceAnisotropy substance_of(const AnisotropicRoughness& lobe);

}  // namespace sateen
