// SPDX-License-Identifier: MIT
#include "sateen/capture/turning/used_frames.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/median.h"

namespace sateen::capture {

std::vector<std::size_t> used_frames(const std::vector<CaptureFrame>& frames) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].dropped.empty()) indices.push_back(i);
  }
  return indices;
}

namespace {

/// Mean green light of what stands still; clipped points count as white.
double still_light(const FrameNotes& note) {
  double sum = 0;
  for (const Vec3f& light : note.still) sum += light.y() < 0 ? 1 : static_cast<double>(light.y());
  return note.still.empty() ? 1 : sum / static_cast<double>(note.still.size());
}

}  // namespace

void drop_blurred(const std::vector<FrameNotes>& notes, std::vector<CaptureFrame>& frames) {
  std::vector<double> sharpness;
  std::vector<double> light;
  for (const FrameNotes& note : notes) {
    sharpness.push_back(note.patch.sharpness);
    light.push_back(still_light(note));
  }
  const double bright = median(light);
  const double typical = std::max(1e-9, median(sharpness));
  for (std::size_t i = 0; i < notes.size(); ++i) {
    frames[i].sharpness = sharpness[i] / typical;
    // Shading changes the detail slowly along the turn: blur stands out against the frames around.
    std::vector<double> near;
    for (std::size_t j = i > 4 ? i - 4 : 0; j < std::min(notes.size(), i + 5); ++j)
      near.push_back(sharpness[j]);
    if (sharpness[i] < 0.6 * median(near)) frames[i].dropped = "blurred";
    if (light[i] < 0.1 * bright) frames[i].dropped = "much darker than the others";
  }
}

void drop_duplicates(std::vector<CaptureFrame>& frames) {
  const std::vector<std::size_t> indices = used_frames(frames);
  if (indices.size() < 2) return;
  const auto step = [&](std::size_t from, std::size_t to) {
    return std::abs(std::remainder(frames[to].turned - frames[from].turned, 2 * kPi));
  };
  std::vector<double> steps;
  for (std::size_t k = 1; k < indices.size(); ++k) steps.push_back(step(indices[k - 1], indices[k]));
  const double typical = median(steps);
  std::size_t kept = indices[0];
  for (std::size_t k = 1; k < indices.size(); ++k) {
    if (step(kept, indices[k]) < 0.1 * typical) {
      frames[indices[k]].dropped = kSameAngle;
    } else {
      kept = indices[k];
    }
  }
}

}  // namespace sateen::capture
