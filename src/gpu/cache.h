// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <string>

#include "sateen/core/texture_data.h"
#include "sateen/gpu/program.h"
#include "sateen/gpu/texture.h"

namespace sateen::gpu {

/// Textures by the data they hold: the same data is uploaded once, and given back when nobody holds the data
/// any more.
class TextureCache {
 public:
  /// The texture of `data`, uploaded now if need be.
  std::shared_ptr<const Texture> of(const std::shared_ptr<const TextureData>& data);
  /// Lets go of textures whose data is gone.
  void sweep();

 private:
  struct Entry {
    std::weak_ptr<const TextureData> data;
    std::shared_ptr<const Texture> texture;
  };
  std::map<const TextureData*, Entry> entries_;
};

/// Programs by their whole text: equal texts are compiled once and kept while somebody draws with them.
class ProgramCache {
 public:
  std::shared_ptr<const Program> of(const ProgramText& text);

 private:
  std::map<std::string, std::weak_ptr<const Program>> entries_;
};

}  // namespace sateen::gpu
