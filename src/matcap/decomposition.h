// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "sateen/core/image.h"
#include "sateen/matcap/filter_estimate.h"
#include "sateen/matcap/kept_pixels.h"
#include "sateen/matcap/separation.h"
#include "sateen/matcap/sphere_disc.h"
#include "sateen/matcap/sphere_map.h"

namespace sateen::matcap {

/// The two components of a MatCap: low-frequency, akin to diffuse, and high-frequency, akin to specular
/// light.
enum class Part { low = 0, high = 1 };
inline constexpr std::array<Part, 2> kParts{Part::low, Part::high};
inline const char* name_of(Part part) {
  return part == Part::low ? "low" : "high";
}

/// One component: light that its material has already filtered, over all directions, and that filter's
/// parameters (Zubiaga et al. 2015, section 3).
struct MatcapPart {
  Vec3 base_color{1, 1, 1};  ///< alpha_0, in the space the parts add up in
  double variance = 0;       ///< nu, radians^2
  bool measured = false;     ///< the variance was measured and is not the fallback
  Feature feature = Feature::line;
  std::vector<Region> regions;  ///< where it was measured, pixels of the input
  PrefilteredMap map;           ///< white-balanced: divided by base_color

  double slope() const;  ///< mu, from the variance
};

/// A MatCap taken apart so that its light can be turned and its material changed.
struct MatcapDecomposition {
  std::array<MatcapPart, 2> parts;  ///< low, high
  AddUpSpace space = AddUpSpace::display;
  int width = 0;  ///< of the input picture; set size and disc otherwise to bake another
  int height = 0;
  Disc disc;        ///< the sphere in it
  KeptPixels kept;  ///< pixels of it that the maps cannot give back
  std::map<std::string, std::string> provenance;

  MatcapPart& operator[](Part part) { return parts[static_cast<std::size_t>(part)]; }
  const MatcapPart& operator[](Part part) const { return parts[static_cast<std::size_t>(part)]; }
};

inline constexpr int kLargestMap = 1024;

/// Variance of a high-frequency part in which nothing is sharp enough to measure: satin.
inline constexpr double kSatin = 0.1;

struct DecomposeOptions {
  AddUpSpace space = AddUpSpace::display;
  Outliers outliers = Outliers::ignore;
  std::array<std::vector<Region>, 2> regions;  ///< of interest for low and high; empty: found
  int map_size =
      0;  ///< texels across the sphere maps; 0: the sphere's diameter in pixels, at most kLargestMap
  double largest_radius =
      kLargestMap;  ///< larger spheres, in pixels, are shrunk to it first: no map would hold them
};

inline constexpr int kSmallestMap = 16;

/// The texels across the sphere maps of a sphere of this size: as many as its diameter has pixels, a multiple
/// of 8.
int default_map_size(const Disc& disc);

/// Sections 3 and 4: separation, filter estimate, sphere maps. `picture` is linear light. `name` is for
/// messages. Throws Error when a value is not finite, the disc does not fit, or a region misses the sphere.
MatcapDecomposition decompose(const Image& picture, const Disc& disc, const DecomposeOptions& options,
                              const std::string& name);

/// The same for components that are given, in the space they add up in (section 4.1, first paragraph).
MatcapDecomposition decompose(const Separation& parts, const Disc& disc, const DecomposeOptions& options,
                              const std::string& name);

}  // namespace sateen::matcap
