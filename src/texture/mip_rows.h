// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sateen::texture {

/// The kernel that halves a level.
enum class MipKernel {
  box,     ///< the area each texel covers; exact for odd sizes too
  kaiser,  ///< a sinc of three texels' half width under a Kaiser window (alpha 4): keeps more detail, can
           ///< ring
};

/// What lies beyond the border.
enum class MipWrap { repeat, clamp, mirror };

/// Names as at the command line; throw Error for another.
MipKernel mip_kernel_from_name(const std::string& name);
MipWrap mip_wrap_from_name(const std::string& name);

/// Sizes of a whole chain along one axis: each is half the one before, rounded down, at least 1, until both
/// are 1.
std::vector<int> mip_sizes(int size, int levels);
int mip_levels(int width, int height);

/// The input texels (wrapped) and weights that make one output texel; weights sum to 1.
struct MipTap {
  int source;
  float weight;
};
using MipTaps = std::vector<MipTap>;

/// The taps of every output texel when a line of `in` texels becomes one of `out` <= in.
std::vector<MipTaps> mip_taps(int in, int out, MipKernel kernel, MipWrap wrap);

/// Halves a picture that arrives row by row, in any order, and holds only the rows that are still needed: a
/// few for a picture that arrives from top to bottom, whatever its height.
class MipRowFilter {
 public:
  struct Row {
    int y = 0;
    std::vector<float> values;  ///< width x channels
  };

  MipRowFilter(int width, int height, int channels, MipKernel kernel, MipWrap wrap_u, MipWrap wrap_v);

  int out_width() const { return static_cast<int>(across_.size()); }
  int out_height() const { return static_cast<int>(down_.size()); }

  /// Takes rows of the input, each once, and returns the output rows that can now be made, by ascending y.
  /// Works on several rows at a time.
  std::vector<Row> push(const std::vector<Row>& rows);

  /// Values kept for rows to come: the memory in use between calls.
  std::size_t held_values() const;

 private:
  int channels_;
  std::vector<MipTaps> across_;
  std::vector<MipTaps> down_;
  std::vector<std::vector<int>> users_;     ///< output rows that read an input row
  std::vector<int> missing_;                ///< input rows an output row still waits for
  std::vector<int> pending_;                ///< output rows that still wait for an input row
  std::vector<std::vector<float>> narrow_;  ///< input rows already filtered across, while they are needed
};

}  // namespace sateen::texture
