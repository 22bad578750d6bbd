// SPDX-License-Identifier: MIT
// Writes the textures that ktx2.test.mjs reads into the folder given: byte i of level l is (31 i + 7 l + 3)
// mod 251.
#include <cstdio>
#include <filesystem>

#include "sateen/core/error.h"
#include "sateen/io/ktx2.h"

namespace {

sateen::io::Ktx2 texture(sateen::io::VkFormat format, std::uint32_t width, std::uint32_t height,
                         std::uint32_t depth, std::uint32_t layers, std::uint32_t levels) {
  sateen::io::Ktx2 result{format, width, height, depth, layers, 1, {}, {}};
  for (std::uint32_t l = 0; l < levels; ++l) {
    std::vector<std::byte> level(sateen::io::ktx2_level_bytes(result, l));
    for (std::size_t i = 0; i < level.size(); ++i)
      level[i] = static_cast<std::byte>((31 * i + 7 * l + 3) % 251);
    result.levels.push_back(std::move(level));
  }
  result.metadata = {
      {"KTXorientation", depth == 0 ? "rd" : "rdi"}, {"sateen.symmetry", "2"}, {"étoffe", "soie"}};
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  namespace io = sateen::io;
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  try {
    io::write_ktx2(folder / "flat.ktx2", texture(io::VkFormat::rgba8_srgb, 13, 7, 0, 0, 4), 0);
    io::write_ktx2(folder / "volume_srgb.ktx2", texture(io::VkFormat::rgba8_srgb, 8, 8, 6, 0, 1), 9);
    io::write_ktx2(folder / "volume_half.ktx2", texture(io::VkFormat::rgba16_sfloat, 8, 6, 5, 0, 1), 9);
    io::write_ktx2(folder / "volume_half_plain.ktx2", texture(io::VkFormat::rgba16_sfloat, 3, 5, 2, 0, 1), 0);
    io::write_ktx2(folder / "array.ktx2", texture(io::VkFormat::rgba16_sfloat, 4, 4, 0, 4, 1), 9);
    io::write_ktx2(folder / "blocks.ktx2", texture(io::VkFormat::bc7_srgb, 12, 8, 0, 0, 2), 9);
  } catch (const sateen::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
