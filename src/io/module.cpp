// SPDX-License-Identifier: MIT
#include "sateen/io/module.h"

#include <cstdlib>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>

#include "sateen/core/error.h"

namespace sateen::io {
namespace {

namespace fs = std::filesystem;

/// The program or shared library this code is part of.
fs::path own_file() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&own_file), &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code code;
  // A program started by its name alone is known by that name.
  const fs::path file = fs::path(info.dli_fname).has_parent_path() ? fs::path(info.dli_fname)
                                                                   : fs::read_symlink("/proc/self/exe", code);
  return fs::canonical(file, code);
}

std::vector<fs::path> places() {
  std::vector<fs::path> places;
  if (const char* told = std::getenv("SATEEN_MODULE_PATH"); told != nullptr && *told != '\0')
    places.emplace_back(told);
  const fs::path beside = own_file().parent_path();
  places.push_back(beside / "sateen");                                 // a library, or a build folder
  places.push_back(beside / ".." / SATEEN_LIBRARY_FOLDER / "sateen");  // a program in bin
  places.push_back(fs::path(SATEEN_MODULE_FOLDER));                    // where it was installed
  return places;
}

[[noreturn]] void fail_missing(const std::string& for_what, const std::string& file, const std::string& fault,
                               const std::string& packages) {
  throw Error(
      fmt::format("{} needs the module {}: {}. It belongs into lib/sateen beside the program's bin (or "
                  "where SATEEN_MODULE_PATH says) and stands on {}",
                  for_what, file, fault, packages));
}

template <class Module>
const Module& load(const std::string& for_what, const char* packages) {
  const std::string file = std::string(Module::kName) + ".so";
  std::string fault = "it is not installed";
  for (const fs::path& place : places()) {
    std::error_code code;
    if (!fs::exists(place / file, code)) continue;
    void* library = dlopen((place / file).c_str(), RTLD_NOW | RTLD_LOCAL);
    using Entry = const Module* (*)();
    const auto entry =
        library == nullptr ? nullptr : reinterpret_cast<Entry>(dlsym(library, "sateen_module"));
    if (entry == nullptr) {
      const char* reason = dlerror();
      fault = reason == nullptr ? "it cannot be loaded" : reason;
      break;
    }
    if (std::string(entry()->version) == SATEEN_VERSION) return *entry();
    fault =
        fmt::format("the one in {} is of version {}, not " SATEEN_VERSION, place.string(), entry()->version);
    break;
  }
  fail_missing(for_what, file, fault, packages);
}

}  // namespace

const OiioModule& oiio_module(const std::string& for_what) {
  static const OiioModule* module = nullptr;
  if (module == nullptr) module = &load<OiioModule>(for_what, kOpenImageIoPackages);
  return *module;
}

const VideoModule& video_module(const std::string& for_what) {
  static const VideoModule* module = nullptr;
  if (module == nullptr)
    module = &load<VideoModule>(for_what, "FFmpeg (libavformat59, libavcodec59, libswscale6 or later)");
  return *module;
}

const CameraModule& camera_module(const std::string& for_what) {
  static const CameraModule* module = nullptr;
  if (module == nullptr)
    module = &load<CameraModule>(for_what, "OpenCV's videoio (libopencv-videoio406 or later)");
  return *module;
}

fs::path module_program(const std::string& name, const std::string& for_what, const std::string& packages) {
  for (const fs::path& place : places()) {
    std::error_code code;
    if (fs::exists(place / name, code)) return place / name;
  }
  fail_missing(for_what, name, "it is not installed", packages);
}

}  // namespace sateen::io
