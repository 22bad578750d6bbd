// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "sateen/core/vector.h"
#include "sateen/matcap/edited_matcap.h"
#include "sateen/matcap/painted_light.h"

namespace sateen::matcap {

// The edits of section 5, in the order they were made. docs/matcap-decomposition.md describes the JSON.

/// Turns the light by rotation_xyz(angles), on top of earlier turns.
struct Turn {
  Vec3 angles{0, 0, 0};  ///< radians about x, then y, then z
};

/// Turns the light by the smallest rotation that brings the main highlight of the high part to a point of the
/// sphere.
struct Align {
  Vec2 to{0, 0};  ///< disc point
};

/// A painted reflection. It stays with the light under later turns, and its blur follows later changes of
/// roughness.
struct Paint {
  Part part = Part::high;
  Vec2 at{0, 0};    ///< disc point: (x, y) of the eye-frame normal where it shall be seen
  double turn = 0;  ///< radians, counter-clockwise
  Footprint footprint;
  Vec3 color{1, 1, 1};  ///< white-balanced: the part's base colour multiplies it
};

/// A picture as a light.
struct Bitmap {
  Part part = Part::high;
  std::filesystem::path file;
  Vec2 at{0, 0};
  double turn = 0;
  double width = 0.5;  ///< radians
  Vec3 color{1, 1, 1};
};

/// Changes the variance of a part's filter: blur for rougher, deconvolution for shinier looks. The slope
/// follows.
struct Roughness {
  Part part = Part::high;
  bool absolute = false;  ///< `variance` is the new one, not a change
  double variance = 0;    ///< radians^2
};

/// Changes the base colour in HSV.
struct Recolor {
  Part part = Part::high;
  double hue = 0;         ///< turns added
  double saturation = 1;  ///< factor
  double value = 1;       ///< factor
};

struct Intensity {
  Part part = Part::high;
  double factor = 1;
};

struct SetSilhouette {
  Part part = Part::low;
  Silhouette silhouette;
};

/// Takes a part, with its colour and filter, from another MatCap. Earlier edits of the part are gone.
struct Mix {
  Part part = Part::high;
  std::filesystem::path from;
};

using Edit = std::variant<Turn, Align, Paint, Bitmap, Roughness, Recolor, Intensity, SetSilhouette, Mix>;

/// Reads a JSON list of edits; files named in it are found beside `folder`. Throws Error naming `name`, the
/// edit's number and the key for anything unknown, missing, or out of range.
std::vector<Edit> parse_edits(const std::string& json, const std::filesystem::path& folder,
                              const std::string& name);

/// parse_edits of a file.
std::vector<Edit> read_edits(const std::filesystem::path& path);

/// Replays the edits. Throws Error when a file cannot be read, MatCaps to mix add up in different spaces, or
/// a part would become sharper than a mirror.
EditedMatcap apply_edits(MatcapDecomposition matcap, const std::vector<Edit>& edits);

/// The direction of the brightest, slightly blurred light of the high part, before any turn.
Vec3 main_highlight(const MatcapDecomposition& matcap);

}  // namespace sateen::matcap
