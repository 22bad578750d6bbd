// SPDX-License-Identifier: MIT
#include "sateen/io/film_formats.h"

#include <array>

namespace sateen::io {

std::span<const FilmFormat> film_formats() {
  static constexpr std::array<FilmFormat, 6> formats{{
      {".mp4", true},
      {".mov", true},
      {".avi", true},
      {".mkv", false},
      {".webm", false},
      {".m4v", false},
  }};
  return formats;
}

}  // namespace sateen::io
