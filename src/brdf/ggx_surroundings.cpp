// SPDX-License-Identifier: MIT
#include "sateen/brdf/ggx_surroundings.h"

#include <cmath>

namespace sateen::brdf {

Vec3 ggx_surroundings(const light::Surroundings& surroundings, const AnisotropicRoughness& lobe,
                      const Mat3& frame, const Vec3& view, int lookups) {
  // Half vectors at the quantiles of the slopes that the narrow lobe lacks along the long axis: a GGX
  // marginal, slope = a c / sqrt(1 - c^2) with c even in (-1, 1).
  const AnisotropicRoughness along{lobe.alpha_t, lobe.alpha_b, 0};
  const double narrow = lobe.alpha_b * lobe.alpha_b;
  const double extra = lobe.alpha_t * lobe.alpha_t - narrow;
  const double blur = std::sqrt(narrow + extra / (lookups * lookups));
  const double view_masking = 1 + ggx_lambda(along, view);
  // Rough lobes lean from the mirror direction towards the normal.
  const double smooth = 1 - lobe.alpha_b;
  const double off = smooth * (std::sqrt(smooth) + lobe.alpha_b);
  Vec3 sum = Vec3::Zero();
  double total = 0;
  for (int i = 0; i < lookups; ++i) {
    const double c = (2 * i + 1.0) / lookups - 1;
    const Vec3 half = Vec3(std::sqrt(extra) * c / std::sqrt(1 - c * c), 0, 1).normalized();
    const double cosine = view.dot(half);
    const Vec3 light = (off * (2 * cosine * half - view) + (1 - off) * Vec3::UnitZ()).normalized();
    if (cosine <= 0 || light.z() <= 1e-4) continue;
    const double weight = cosine / half.z() * view_masking / (view_masking + ggx_lambda(along, light));
    sum += weight * surroundings.radiance(frame * light, blur);
    total += weight;
  }
  return total > 0 ? Vec3(sum / total) : Vec3::Zero();
}

}  // namespace sateen::brdf
