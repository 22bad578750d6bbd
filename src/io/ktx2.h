// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace sateen::io {

/// The texel formats Sateen reads and writes; values are Vulkan's.
enum class VkFormat : std::uint32_t {
  r8_unorm = 9,
  rg8_unorm = 16,
  rgba8_unorm = 37,
  rgba8_srgb = 43,
  rgba16_sfloat = 97,
  rgba32_sfloat = 109,
  bc1_rgb_unorm = 131,
  bc3_unorm = 137,
  bc4_unorm = 139,
  bc5_unorm = 141,
  bc6h_ufloat = 143,
  bc7_unorm = 145,
  bc7_srgb = 146,
};

/// A KTX 2.0 texture file. Levels hold what the GPU takes: layer by layer, face by face, slice by slice, rows
/// from the file's row 0, texels or 4 x 4 blocks tightly packed.
struct Ktx2 {
  VkFormat format = VkFormat::rgba8_srgb;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t depth = 0;                      ///< 0: two-dimensional; otherwise a 3D texture
  std::uint32_t layers = 0;                     ///< 0: no array
  std::uint32_t faces = 1;                      ///< 6: a cube
  std::vector<std::vector<std::byte>> levels;   ///< level 0 is the largest
  std::map<std::string, std::string> metadata;  ///< key/value data as UTF-8 text, such as KTXorientation "rd"
};

/// The bytes of one level, from format and dimensions; throws Error for sizes no memory could hold.
std::size_t ktx2_level_bytes(const Ktx2& texture, std::uint32_t level);

/// Reads any KTX2 in the formats above, uncompressed or with Zstandard supercompression.
/// `check` is shown all but the levels before there is memory for them, and may throw. Throws Error naming
/// the file when it is no KTX2, truncated, larger than its bytes can hold, in another format, or of more
/// texels than max_pixels() (image.h).
Ktx2 read_ktx2(const std::filesystem::path& path, const std::function<void(const Ktx2&)>& check = {});

/// What a KTX2 says of itself: all of the above but the levels, which stay empty. None is inflated, nor read
/// from the disk. Throws Error as read_ktx2, but not for what is wrong with a level.
Ktx2 read_ktx2_info(const std::filesystem::path& path);

/// Whether every byte of a file of ours ("sateen.kind") is as write_ktx2 left it. Throws Error when it cannot
/// be read.
bool ktx2_is_whole(const std::filesystem::path& path);

/// Writes with Zstandard supercompression at `zstd_level` (0: none), a correct basic data format descriptor,
/// KTXwriter, and in textures with "sateen.kind" a "sateen.checksum" of the whole file. Atomic. Throws Error
/// when a level's size does not fit the dimensions or the file cannot be written.
void write_ktx2(const std::filesystem::path& path, const Ktx2& texture, int zstd_level = 9);

/// The same for textures that belong together: all files appear, or none. One path a texture.
void write_ktx2(std::span<const std::filesystem::path> paths, std::span<const Ktx2> textures,
                int zstd_level = 9);

}  // namespace sateen::io
