// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace sateen::io {

/// A container of films; one line of the table each.
struct FilmFormat {
  std::string_view extension;  ///< lower case with the dot
  bool written;                ///< otherwise only read
};

std::span<const FilmFormat> film_formats();

}  // namespace sateen::io
