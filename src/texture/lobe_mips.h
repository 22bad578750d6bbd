// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "sateen/core/image.h"
#include "sateen/texture/lobe_chain.h"

namespace sateen::texture {

/// A filtered chain in memory, as shaders sample it: level 0 first, row 0 on top, values in [0, 1].
struct LobeMips {
  AnisotropyEncoding encoding = AnisotropyEncoding::root;
  bool green_down = false;        ///< of the normals' y
  std::vector<Image> normals;     ///< two channels or more: x / 2 + 1/2, y / 2 + 1/2
  std::vector<Image> anisotropy;  ///< three channels or more, as `encoding` says
};

/// filter_lobe_chain into memory.
LobeMips make_lobe_mips(LobeSource& source, const ChainOptions& options, AnisotropyEncoding encoding);

/// Reads back what write_lobe_chain wrote as KTX2, with blocks or plain; how both are meant comes from their
/// metadata. Throws Error naming the file that is none of these, or when sizes or levels differ.
LobeMips read_lobe_mips(const std::filesystem::path& normals, const std::filesystem::path& anisotropy);

}  // namespace sateen::texture
