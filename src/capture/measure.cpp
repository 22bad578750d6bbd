// SPDX-License-Identifier: MIT
#include "sateen/capture/measure.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include <tbb/enumerable_thread_specific.h>

#include "sateen/capture/sphere/choose_camera.h"
#include "sateen/core/error.h"
#include "sateen/core/median.h"

namespace sateen::capture {
namespace {

constexpr int kScouts = 24;
constexpr int kLargestPatch = 192;

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

FirstLook first_look(FrameSource& source, const Camera& camera, const Progress& progress) {
  FirstLook look;
  look.factor = grey_factor(source.width(), source.height());
  look.camera = camera.scaled(1.0 / look.factor);
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
  if (camera.focal_source == kAssumedFocal) look.focal = find_focal(greys, look.scouting, look.camera);
  look.outline = fit_outlines(greys, look.scouting, look.camera);
  for (const Vec2& c : look.outline.centres)
    look.centre += c / static_cast<double>(look.outline.centres.size());
  for (const Vec2& c : look.outline.centres) look.reach = std::max(look.reach, (c - look.centre).norm());
  look.scouting.centre = look.centre;
  look.scouting.radius = look.outline.radius;
  look.still = still_points(look.scouting, greys[0].width, greys[0].height, look.factor,
                            look.reach + 6 + 0.05 * look.outline.radius);
  for (const Eigen::Vector2i& p : look.still.pixels) {
    const int x = p.x() / look.factor;
    const int y = p.y() / look.factor;
    const double code = static_cast<double>(
        look.scouting.mean[static_cast<std::size_t>(y) * static_cast<std::size_t>(greys[0].width) +
                           static_cast<std::size_t>(x)]);
    look.still_grey.push_back(code * code / (255.0 * 255.0));
  }
  return look;
}

namespace {

/// Gain of a frame's grey codes from its still points: the median ratio, as a square root like the codes.
double code_gain(const FirstLook& look, const std::vector<Vec3f>& samples) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i][0] < 0 || look.still_grey[i] <= 0) continue;
    const double grey = 0.25 * static_cast<double>(samples[i][0] + 2 * samples[i][1] + samples[i][2]);
    ratios.push_back(grey / look.still_grey[i]);
  }
  if (ratios.size() < 50) return 1;
  return std::sqrt(std::max(1e-3, middle_of(ratios)));
}

}  // namespace

std::vector<FrameNotes> measure_frames(FrameSource& source, const FirstLook& look, const StillMask& still,
                                       const Mat3& axes, const Progress& progress) {
  const double radius = look.outline.radius;
  const int patch_size = std::clamp(static_cast<int>(2 * radius * kPatchReach) / 2 * 2, 48, kLargestPatch);
  const double margin = radius * 1.05 + look.reach + 12;
  const GreyRegion region{
      static_cast<int>(look.centre.x() - margin), static_cast<int>(look.centre.y() - margin),
      static_cast<int>(look.centre.x() + margin) + 1, static_cast<int>(look.centre.y() + margin) + 1};
  const PatchMap patches(look.camera, sphere_at(look.camera, look.centre, radius), axes, patch_size, still);
  std::vector<FrameNotes> notes(static_cast<std::size_t>(source.count()));
  std::vector<int> indices(notes.size());
  std::iota(indices.begin(), indices.end(), 0);
  std::atomic<int> done = 0;
  tbb::enumerable_thread_specific<GreyPicture> greys;
  source.visit(indices, [&](int index, const Photograph& frame) {
    FrameNotes& note = notes[static_cast<std::size_t>(index)];
    GreyPicture& grey = greys.local();
    grey_picture(frame, look.factor, region, grey);
    note.still = sample_still_points(look.still, frame);
    const double gain = code_gain(look, note.still);
    note.centre = look.centre;
    for (const double reach : {look.reach + 4, 3.0}) {
      const OutlineOffset offset = measure_outline(grey, gain, look.outline.plate, look.camera,
                                                   sphere_at(look.camera, note.centre, radius), reach, true);
      note.support = offset.support;
      if (offset.support > 0.25) note.centre += offset.shift;
    }
    note.patch = patches.patch(grey, note.centre);
    note.read = true;
    report(progress, static_cast<double>(++done) / static_cast<double>(indices.size()));
  });
  return notes;
}

}  // namespace sateen::capture
