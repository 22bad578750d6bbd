// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sateen::io {

/// Where the corners of a colour space lie: CIE x and y of red, green, blue and white.
struct Chromaticities {
  std::array<double, 8> xy{};
  bool operator==(const Chromaticities&) const = default;
};

inline constexpr Chromaticities kRec709{{0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290}};

/// What a picture file says of its colours; whatever it does not say is Encoding's default.
struct StoredColour {
  std::vector<std::byte> icc;                    ///< an ICC profile
  std::optional<Chromaticities> chromaticities;  ///< of EXR, PNG (cHRM, cICP), HDR (PRIMARIES)
  std::optional<double> gamma;                   ///< samples are light to the power of 1 / gamma (PNG)
  bool srgb = false;                             ///< it says that it is sRGB, which goes before all above
  /// Factors that make red, green and blue the light that was recorded (EXPOSURE and COLORCORR of an HDR).
  std::optional<std::array<double, 3>> scale;
  std::vector<std::string> ignored;  ///< what it says and we do not use, as in "transfer function 16 (PQ)"
};

}  // namespace sateen::io
