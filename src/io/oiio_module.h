// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "sateen/io/picture_source.h"

namespace sateen::io {

/// What the module sateen-oiio does, by way of OpenImageIO.
struct OiioModule {
  static constexpr const char* kName = "sateen-oiio";
  const char* version;  ///< of Sateen

  /// The picture in a DDS file. Throws Error, which calls it `name`.
  std::unique_ptr<PictureSource> (*open_dds)(std::span<const std::byte> file, const std::string& name);
};

}  // namespace sateen::io
