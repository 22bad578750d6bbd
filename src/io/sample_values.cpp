// SPDX-License-Identifier: MIT
#include "sateen/io/sample_values.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "sateen/core/colour.h"

namespace sateen::io {
namespace {

/// Sample k stands for k / steps.
std::vector<float> table(std::size_t steps, bool srgb) {
  std::vector<float> values(steps + 1);
  const float step = 1 / static_cast<float>(steps);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] =
        srgb ? srgb_decode(static_cast<float>(i) / static_cast<float>(steps)) : static_cast<float>(i) * step;
  }
  return values;
}

template <class Sample>
void look_up(const Sample* in, std::size_t pixels, std::size_t channels, const std::vector<float>& colour,
             const std::vector<float>& alpha, float* out) {
  const bool with_alpha = channels == 2 || channels == 4;
  for (std::size_t i = 0; i < pixels * channels; ++i)
    out[i] = (with_alpha && (i + 1) % channels == 0 ? alpha : colour)[in[i]];
}

}  // namespace

SampleValues::SampleValues(const PictureHeader& header, bool srgb)
    : type_(header.samples),
      channels_(static_cast<std::size_t>(header.delivered())),
      whole_floats_(header.samples == SampleType::f32 && !header.floating && srgb) {
  if (type_ == SampleType::f32 && !whole_floats_) return;
  const std::size_t steps = type_ == SampleType::u8 ? 255 : 65535;
  colour_ = table(steps, srgb);
  alpha_ = srgb ? table(steps, false) : colour_;
}

void SampleValues::convert(const std::byte* samples, std::size_t pixels, float* out) const {
  if (type_ == SampleType::u8) {
    look_up(reinterpret_cast<const std::uint8_t*>(samples), pixels, channels_, colour_, alpha_, out);
  } else if (type_ == SampleType::u16) {
    look_up(reinterpret_cast<const std::uint16_t*>(samples), pixels, channels_, colour_, alpha_, out);
  } else {
    std::memcpy(out, samples, pixels * channels_ * sizeof(float));
    if (!whole_floats_) return;
    const bool with_alpha = channels_ == 2 || channels_ == 4;
    for (std::size_t i = 0; i < pixels * channels_; ++i) {
      if (with_alpha && (i + 1) % channels_ == 0) continue;
      out[i] = colour_[static_cast<std::size_t>(std::clamp(out[i], 0.0f, 1.0f) * 65535 + 0.5f)];
    }
  }
}

}  // namespace sateen::io
