// SPDX-License-Identifier: MIT
#include "sateen/gpu/cache.h"

namespace sateen::gpu {

std::shared_ptr<const Texture> TextureCache::of(const std::shared_ptr<const TextureData>& data) {
  Entry& entry = entries_[data.get()];
  // An address may come back for other data.
  if (entry.data.lock() != data) entry = {data, std::make_shared<const Texture>(*data)};
  return entry.texture;
}

void TextureCache::sweep() {
  std::erase_if(entries_, [](const auto& item) { return item.second.data.expired(); });
}

std::shared_ptr<const Program> ProgramCache::of(const ProgramText& text) {
  std::erase_if(entries_, [](const auto& item) { return item.second.expired(); });
  std::weak_ptr<const Program>& known = entries_[text.key()];
  std::shared_ptr<const Program> program = known.lock();
  if (!program) known = program = std::make_shared<const Program>(text);
  return program;
}

}  // namespace sateen::gpu
