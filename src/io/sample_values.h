// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "sateen/io/picture_source.h"

namespace sateen::io {

/// Turns the samples of a PictureSource into floats: integers into [0, 1], or into the linear light of sRGB
/// samples (alpha stays as it is); floats stay. By table, since reading frames is to be bound by decoding and
/// not by powers.
class SampleValues {
 public:
  SampleValues(const PictureHeader& header, bool srgb);
  /// `pixels` pixels from where `samples` points.
  void convert(const std::byte* samples, std::size_t pixels, float* out) const;

 private:
  SampleType type_;
  std::size_t channels_;
  bool whole_floats_;          ///< f32 that holds scaled whole numbers to be decoded from sRGB
  std::vector<float> colour_;  ///< of each sample value
  std::vector<float> alpha_;   ///< likewise; of channels that are not colour
};

}  // namespace sateen::io
