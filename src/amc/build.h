// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sateen/amc/symmetry.h"
#include "sateen/amc/table.h"
#include "sateen/core/progress.h"

namespace sateen::amc {

struct LoadFramesOptions {
  int size = 128;                 ///< S: frames are area-filtered to this
  double first_angle = 0;         ///< tangent angle of the first frame, turns
  bool clockwise = false;         ///< the sphere turns clockwise as the picture shows it
  std::optional<PixelRect> crop;  ///< the square that just holds the sphere; without it frames must be square
  bool skip_bad = false;          ///< leave out files that cannot be read, instead of failing
  std::function<void(const std::string&)> on_skipped;  ///< told why a file was left out
  Progress progress;
};

struct LoadedFrames {
  std::vector<AmcFrame> frames;  ///< ascending angles in [0, 1)
  bool floating = false;         ///< some file held float samples
  int skipped = 0;
};

/// Reads the frames of one full turn, equal steps apart, in parallel; a skipped file leaves its angle out.
/// Throws Error when there are fewer than kMinFrames, when a file is unreadable (unless skip_bad), not square
/// or of another size than the first, and when the crop leaves the picture.
LoadedFrames load_frames(std::span<const std::filesystem::path> files, const LoadFramesOptions& options);

inline constexpr int kMinFrames = 4;

struct BuildAmcOptions {
  int slices = 128;
  std::optional<int> symmetry;  ///< R to enforce; without it the largest R that analyse_symmetry finds
  AmcEncoding encoding = AmcEncoding::half;
};

/// The table from the frames of one turn (section 5): equivalent slices are averaged, angles resampled
/// cyclically; texels are rounded to what the encoding holds. `report` is analyse_symmetry's.
AmcTable build_amc(std::span<const AmcFrame> frames, const SymmetryReport& report,
                   const BuildAmcOptions& options);

}  // namespace sateen::amc
