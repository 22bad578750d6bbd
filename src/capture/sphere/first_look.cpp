// SPDX-License-Identifier: MIT
#include "sateen/capture/sphere/first_look.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "sateen/core/error.h"
#include "sateen/core/median.h"

namespace sateen::capture {
namespace {

constexpr int kScouts = 24;

/// Standard deviation of every 7th pixel's code.
double contrast(const GreyPicture& picture) {
  double sum = 0;
  double squares = 0;
  double n = 0;
  for (int y = 0; y < picture.height; y += 7) {
    for (int x = 0; x < picture.width; x += 7) {
      const double code = picture.at(x, y);
      sum += code;
      squares += code * code;
      ++n;
    }
  }
  return std::sqrt(std::max(0.0, squares / n - sum / n * (sum / n)));
}

/// Takes out pictures that show next to nothing beside the others: a covered lens, a lamp that was off. One
/// of them would make the whole picture look as if it changed.
void leave_out_blank(std::vector<GreyPicture>& pictures) {
  std::vector<double> contrasts;
  contrasts.reserve(pictures.size());
  for (const GreyPicture& picture : pictures) contrasts.push_back(contrast(picture));
  if (contrasts.empty()) return;
  const double typical = median(contrasts);
  std::erase_if(pictures, [&](const GreyPicture& picture) { return contrast(picture) < 0.35 * typical; });
}

/// Tries a few focal lengths: under a wrong one the predicted ellipse finds other edges than the sphere's and
/// fewer of its own. From the best of them on the outline tells. Sets the camera's.
FocalEstimate find_focal(std::span<const GreyPicture> greys, const Scouting& scouting, Camera& camera) {
  const Camera assumed = camera;
  double best = 0;
  for (const double times : {0.5, 0.7, 1.0, 1.5, 3.0}) {
    Camera tried = assumed;
    tried.focal *= times;
    try {
      const OutlineFit fit = fit_outlines(greys, scouting, tried);
      constexpr double kNoise = 0.1;  // pixels: below it residuals tell nothing
      const double score = fit.support / (kNoise + median(fit.residuals));
      if (score <= best) continue;
      best = score;
      camera = tried;
    } catch (const Error&) {
      continue;  // no outline that fits this one
    }
  }
  FocalEstimate found;
  for (int round = 0; round < 3; ++round) {
    constexpr double kReach = 4;
    const OutlineFit fit = fit_outlines(greys, scouting, camera);
    found = estimate_focal(mean_outline(greys, scouting, camera, fit, kReach), assumed);
    camera.focal = Vec2::Constant(found.focal);
  }
  return found;
}

}  // namespace

FirstLook first_look(FrameSource& source, const Lens& lens, const Progress& progress) {
  FirstLook look;
  look.factor = grey_factor(source.width(), source.height());
  look.lens = lens;
  look.camera = lens.camera.scaled(1.0 / look.factor);
  std::vector<int> indices;
  const int scouts = std::min(kScouts, source.count());
  indices.reserve(static_cast<std::size_t>(scouts));
  for (int i = 0; i < scouts; ++i) {
    indices.push_back(static_cast<int>(static_cast<std::int64_t>(i) * source.count() / scouts));
  }
  std::vector<GreyPicture> greys(indices.size());
  std::atomic<int> done = 0;
  source.visit(indices, [&](int index, const Photograph& frame) {
    const auto at = std::ranges::lower_bound(indices, index) - indices.begin();
    greys[static_cast<std::size_t>(at)] = grey_picture(frame, look.factor);
    report(progress, static_cast<double>(++done) / scouts);
  });
  std::erase_if(greys, [](const GreyPicture& grey) { return grey.codes.empty(); });
  leave_out_blank(greys);
  look.scouting = find_sphere(greys, look.factor);
  if (lens.source == FocalSource::assumed) {
    look.lens.estimate = find_focal(greys, look.scouting, look.camera).scaled(look.factor);
    look.lens.camera.focal = Vec2::Constant(look.lens.estimate->focal);
    if (look.lens.estimate->informed) look.lens.source = FocalSource::outline;
  }
  look.outline = fit_outlines(greys, look.scouting, look.camera);
  for (const Vec2& c : look.outline.centres)
    look.centre += c / static_cast<double>(look.outline.centres.size());
  for (const Vec2& c : look.outline.centres) look.reach = std::max(look.reach, (c - look.centre).norm());
  look.scouting.centre = look.centre;
  look.scouting.radius = look.outline.radius;
  return look;
}

}  // namespace sateen::capture
