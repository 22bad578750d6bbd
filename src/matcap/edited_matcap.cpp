// SPDX-License-Identifier: MIT
#include "sateen/matcap/edited_matcap.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/colour.h"
#include "sateen/matcap/warp.h"

namespace sateen::matcap {

EditedMatcap unedited(MatcapDecomposition matcap) {
  EditedMatcap result;
  for (const Part part : kParts) result.look(part).base_color = matcap[part].base_color;
  result.matcap = std::move(matcap);
  return result;
}

double silhouette_factor(const Silhouette& s, double theta, const Vec3& base_color) {
  const double t = std::clamp((theta - s.theta0) / (kPi / 2 - s.theta0), 0.0, 1.0);
  const double spline = t * t * ((3 - 2 * t) + (t - 1) * s.m1);
  return std::max(0.0, 1 + spline * (s.alpha1 - base_color.mean()));
}

namespace {

Vec3 part_value(const EditedMatcap& matcap, const Mat3& light, Part which, const Vec3& n,
                const Modulation& modulation) {
  const MatcapPart& part = matcap.matcap[which];
  const PartLook& look = matcap.look(which);
  const double added = which == Part::high ? std::max(0.0, modulation.added_variance) : 0;
  const Vec3 w = light.transpose() * warp(n, slope_of_variance(part.variance + added));
  Vec3 color = look.intensity * look.base_color.cwiseProduct(sample(part.map, w, added));
  color = color.cwiseProduct(which == Part::low ? modulation.low_color : modulation.high_color);
  if (!look.silhouette) return color;
  return color * silhouette_factor(*look.silhouette, std::acos(std::clamp(n.z(), 0.0, 1.0)), look.base_color);
}

}  // namespace

Vec3 evaluate_part(const EditedMatcap& matcap, Part which, const Vec3& n, const Modulation& modulation) {
  return part_value(matcap, matcap.light, which, n, modulation);
}

Vec3 evaluate(const EditedMatcap& matcap, const Mat3& light, const Vec3& n, const Modulation& modulation) {
  Vec3 sum = part_value(matcap, light, Part::low, n, modulation) +
             part_value(matcap, light, Part::high, n, modulation);
  if (matcap.matcap.space == AddUpSpace::display) {
    for (double& v : sum) v = srgb_decode(static_cast<float>(v));
  }
  return modulation.occlusion * sum;
}

Vec3 evaluate(const EditedMatcap& matcap, const Vec3& n, const Modulation& modulation) {
  return evaluate(matcap, matcap.light, n, modulation);
}

}  // namespace sateen::matcap
