// SPDX-License-Identifier: MIT
// The module sateen-oiio: blocks that OpenImageIO decodes.
#include "oiio_source.h"
#include "sateen/io/oiio_module.h"

namespace sateen::io {
namespace {

std::unique_ptr<PictureSource> open_dds(std::span<const std::byte> file, const std::string& name) {
  std::vector<std::byte> kept(file.begin(), file.end());
  auto memory = std::make_unique<OIIO::Filesystem::IOMemReader>(kept.data(), kept.size());
  auto input = OIIO::ImageInput::open("blocks.dds", nullptr, memory.get());
  if (!input) fail(name, "its blocks cannot be decoded: " + image_reason(OIIO::geterror()));
  return std::make_unique<OiioSource>(name, std::move(input), std::move(kept), std::move(memory));
}

constexpr OiioModule kModule{SATEEN_VERSION, open_dds};

}  // namespace
}  // namespace sateen::io

extern "C" __attribute__((visibility("default"))) const sateen::io::OiioModule* sateen_module() {
  return &sateen::io::kModule;
}
