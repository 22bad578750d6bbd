// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "sateen/capture/photographs/photograph.h"

namespace sateen::capture {

/// The exposure times (seconds) of one bracketed group when the pictures repeat the same two to nine
/// different times over and over, after their EXIF notes; empty otherwise, and when any picture does not say.
std::vector<double> find_brackets(std::span<const std::filesystem::path> files);

/// One picture of light from a group of exposures, as light per unit of the longest exposure: each sample
/// weighs by how far it is from black and from clipping and by its exposure time (Debevec and Malik 1997, eq.
/// 6, with a known response). Clipped in the result is only what the shortest exposure clips.
Photograph merge_brackets(std::span<const Photograph> group, std::span<const double> exposure_times);

}  // namespace sateen::capture
