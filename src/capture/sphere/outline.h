// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "sateen/capture/sphere/scout.h"
#include "sateen/capture/sphere/sphere_view.h"

namespace sateen::capture {

/// The background around the sphere as light, where some frame shows it; 0 where none does (negative).
struct Plate {
  int width = 0;
  int height = 0;
  std::vector<float> light;  ///< -1: hidden in every frame
  double noise = 0;          ///< codes, of a single frame (Scouting::noise)
};

/// Where one frame shows the outline, relative to a predicted one.
struct OutlineOffset {
  Vec2 shift{0, 0};     ///< pixels, of the centre
  double growth = 0;    ///< pixels, of the radius
  double residual = 0;  ///< robust rms distance of the seen edge points from the fitted outline, pixels
  double support = 0;   ///< share of the outline where an edge is seen
};

/// Searches the outline within `reach` pixels of where `sphere` predicts it, along normals, as the steepest
/// change of the difference to the background plate, to a fraction of a pixel. Noisy pictures are averaged
/// along the outline first. `gain` is of the codes, as in Scouting. With `fixed_radius` only the shift is
/// fitted.
OutlineOffset measure_outline(const GreyPicture& frame, double gain, const Plate& plate, const Camera& camera,
                              const SphereView& sphere, double reach, bool fixed_radius);

struct OutlineFit {
  double radius = 0;              ///< SphereView::radius_pixel, the same for all frames
  std::vector<Vec2> centres;      ///< SphereView::centre_pixel, per frame
  std::vector<double> residuals;  ///< per frame, pixels
  double support = 0;             ///< mean share of the outline that is seen
  Plate plate;
};

/// The outline that the frames show on average, as pixels around the mean of the fit's centres: at each
/// azimuth the middle of what the frames show within `reach` pixels of the fit; none where too few do.
std::vector<Vec2> mean_outline(std::span<const GreyPicture> frames, const Scouting& scouting,
                               const Camera& camera, const OutlineFit& fit, double reach);

/// The sphere of each scout frame, sub-pixel, from the coarse circle; in pixels of the grey pictures, whose
/// camera is `camera`. Throws Error when no outline stands out against the background.
OutlineFit fit_outlines(std::span<const GreyPicture> frames, const Scouting& scouting, const Camera& camera);

}  // namespace sateen::capture
