// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "sateen/io/camera_module.h"
#include "sateen/io/oiio_module.h"
#include "sateen/io/video_module.h"

namespace sateen::io {

/// Modules hold what takes hundreds of shared libraries, and are loaded when something needs them: files
/// beside the program or library, or in ../lib/sateen, or where the environment variable SATEEN_MODULE_PATH
/// says. Each function throws Error, which says `for_what` the module is needed and what to install, when it
/// is missing or of another version.
const OiioModule& oiio_module(const std::string& for_what);
const VideoModule& video_module(const std::string& for_what);
const CameraModule& camera_module(const std::string& for_what);

/// A program that lies where the modules do. Throws Error likewise; it stands on `packages`.
std::filesystem::path module_program(const std::string& name, const std::string& for_what,
                                     const std::string& packages);
inline constexpr const char* kOpenImageIoPackages = "OpenImageIO (libopenimageio2.4 or later)";

}  // namespace sateen::io
