// SPDX-License-Identifier: MIT
// Writes a texture and reads it back with the installed library.
#include <sateen/core/image.h>
#include <sateen/io/image.h>
#include <sateen/io/ktx2.h>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  sateen::io::Ktx2 texture{sateen::io::VkFormat::rgba8_srgb, 2, 2, 2, 0, 1, {}, {}};
  texture.levels.emplace_back(sateen::io::ktx2_level_bytes(texture, 0), std::byte{42});
  sateen::io::write_ktx2(argv[1], texture);
  return sateen::io::read_ktx2(argv[1]).levels == texture.levels && !sateen::io::image_extensions().empty()
             ? 0
             : 1;
}
