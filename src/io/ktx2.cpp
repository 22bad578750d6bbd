// SPDX-License-Identifier: MIT
#include "sateen/io/ktx2.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <memory>
#include <numeric>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <zstd.h>

#include "sateen/core/error.h"
#include "sateen/core/parallel.h"
#include "sateen/io/checksum.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "sateen/io/ktx2_format.h"

// The file as KTX 2.0 (section 3) lays it out: identifier, header, level index, data format descriptor,
// key/value data, levels from the smallest to the largest. All numbers are little-endian.
static_assert(std::endian::native == std::endian::little,
              "KTX2 files are little-endian; so is every machine so far");

namespace sateen::io {
namespace {

namespace fs = std::filesystem;

constexpr std::array<unsigned char, 12> kIdentifier{0xab, 'K',  'T',  'X',  ' ',  '2',
                                                    '0',  0xbb, '\r', '\n', 0x1a, '\n'};
constexpr std::uint32_t kNoSupercompression = 0;
constexpr std::uint32_t kZstandard = 2;

struct Header {
  std::uint32_t format;
  std::uint32_t type_size;
  std::uint32_t width;
  std::uint32_t height;
  std::uint32_t depth;
  std::uint32_t layers;
  std::uint32_t faces;
  std::uint32_t levels;
  std::uint32_t supercompression;
  std::uint32_t descriptor_offset;
  std::uint32_t descriptor_bytes;
  std::uint32_t metadata_offset;
  std::uint32_t metadata_bytes;
  std::uint32_t global_offset[2];  // 64 bit, in halves so that the struct has no padding
  std::uint32_t global_bytes[2];
};
static_assert(sizeof(Header) == 68);

struct LevelEntry {
  std::uint64_t offset;
  std::uint64_t bytes;
  std::uint64_t uncompressed_bytes;
};

constexpr std::size_t kIndexOffset = sizeof kIdentifier + sizeof(Header);

std::uint32_t level_count_limit(const Ktx2& texture) {
  return static_cast<std::uint32_t>(std::bit_width(std::max({texture.width, texture.height, texture.depth})));
}

constexpr double kMostBytes =
    64e9;  // more memory than any machine has for one texture, and exact as a double

/// The bytes of one level of a known format; a double holds whatever the dimensions claim.
double level_bytes(const Ktx2& texture, std::uint32_t level) {
  const TexelLayout& layout = *find_texel_layout(texture.format);
  const auto texels = [&](std::uint32_t size) { return level < 32 ? std::max(1u, size >> level) : 1u; };
  const auto blocks = [&](std::uint32_t size) { return (texels(size) - 1) / layout.block + 1; };
  return 1.0 * blocks(texture.width) * blocks(texture.height) * texels(texture.depth) *
         std::max(1u, texture.layers) * std::max(1u, texture.faces) * layout.block_bytes;
}

std::string too_large(const Ktx2& texture, double bytes) {
  return fmt::format("{} x {} x {} texels in {} layers would need {:.0f} GB", texture.width, texture.height,
                     std::max(1u, texture.depth), std::max(1u, texture.layers), bytes / 1e9);
}

/// What is wrong with format and dimensions, if anything.
std::optional<std::string> dimension_fault(const Ktx2& texture, std::size_t levels) {
  if (find_texel_layout(texture.format) == nullptr) {
    return fmt::format(
        "the texel format {} (VkFormat) is not supported; 8-bit, half and float RGBA, BC1 and BC3 to BC7 are",
        static_cast<std::uint32_t>(texture.format));
  }
  if (texture.width == 0) return "the width is 0";
  if (texture.height == 0) return "it is one-dimensional; 2D and 3D textures are supported";
  if (texture.faces != 1 && texture.faces != 6)
    return fmt::format("it has {} faces instead of 1 or 6", texture.faces);
  if (texture.faces == 6 && (texture.width != texture.height || texture.depth != 0)) {
    return "it is a cube whose faces are not square pictures";
  }
  if (const double bytes = level_bytes(texture, 0); bytes > kMostBytes) return too_large(texture, bytes);
  if (levels == 0) return "it has no mip level";
  if (levels > level_count_limit(texture)) {
    return fmt::format("it has {} mip levels where its size allows {}", levels, level_count_limit(texture));
  }
  return std::nullopt;
}

// ---- reading

/// A file's bytes; every access is checked against its length.
class Reader {
 public:
  Reader(const fs::path& path, std::span<const std::byte> bytes) : path_(path), bytes_(bytes) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(fmt::format("{}: {}", path_.string(), what));
  }

  std::span<const std::byte> part(std::uint64_t offset, std::uint64_t length, const std::string& what) const {
    if (offset > bytes_.size() || length > bytes_.size() - offset) {
      fail(fmt::format("is truncated or corrupt: {} would reach beyond its {} bytes", what, bytes_.size()));
    }
    return bytes_.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
  }

  /// The first `length` bytes, or as many as there are.
  std::span<const std::byte> head(std::size_t length) const {
    return bytes_.first(std::min(length, bytes_.size()));
  }

  template <typename T>
  T get(std::uint64_t offset, const std::string& what) const {
    T value;
    std::memcpy(&value, part(offset, sizeof value, what).data(), sizeof value);
    return value;
  }

 private:
  const fs::path& path_;
  std::span<const std::byte> bytes_;
};

void check_descriptor(const Reader& file, const Header& header) {
  const std::string what = "its data format descriptor";
  file.part(header.descriptor_offset, header.descriptor_bytes, what);
  if (header.descriptor_bytes < 4 || header.descriptor_offset < kIndexOffset ||
      file.get<std::uint32_t>(header.descriptor_offset, what) != header.descriptor_bytes) {
    file.fail("is corrupt: its data format descriptor has a wrong length");
  }
}

std::map<std::string, std::string> read_metadata(const Reader& file, const Header& header) {
  const std::string what = "its key/value data";
  const auto bytes = file.part(header.metadata_offset, header.metadata_bytes, what);
  std::map<std::string, std::string> metadata;
  std::size_t at = 0;
  while (at < bytes.size()) {
    std::uint32_t length = 0;
    if (bytes.size() - at >= sizeof length) std::memcpy(&length, bytes.data() + at, sizeof length);
    at += sizeof length;
    if (length < 2 || at > bytes.size() || length > bytes.size() - at) {
      file.fail("is corrupt: its key/value data have an entry of a wrong length");
    }
    const std::string entry(reinterpret_cast<const char*>(bytes.data()) + at, length);
    const std::size_t end = entry.find('\0');
    if (end == 0 || end == std::string::npos)
      file.fail("is corrupt: its key/value data have an entry without a key");
    std::string value = entry.substr(end + 1);
    if (value.ends_with('\0')) value.pop_back();
    // Values with zeros inside are binary, such as KTXglFormat: nothing a table of texts could hold.
    if (value.find('\0') == std::string::npos) metadata[entry.substr(0, end)] = std::move(value);
    at = std::min(bytes.size(), (at + length + 3) / 4 * 4);
  }
  return metadata;
}

/// A texture without its levels, and how many those are.
struct Opened {
  Ktx2 texture;
  std::uint32_t levels = 0;
  bool compressed = false;
};

Opened read_header(const Reader& file) {
  const auto start = file.head(sizeof kIdentifier);
  if (start.size() < sizeof kIdentifier || std::memcmp(start.data(), kIdentifier.data(), start.size()) != 0) {
    file.fail("is no KTX2 texture");
  }
  const auto header = file.get<Header>(sizeof kIdentifier, "its header");
  Ktx2 texture{static_cast<VkFormat>(header.format),
               header.width,
               header.height,
               header.depth,
               header.layers,
               header.faces,
               {},
               {}};
  const std::uint32_t levels = std::max(1u, header.levels);  // 0 asks the reader to make the smaller ones
  if (const auto fault = dimension_fault(texture, levels)) file.fail("cannot be read: " + *fault);
  if (header.supercompression != kNoSupercompression && header.supercompression != kZstandard) {
    file.fail(
        fmt::format("cannot be read: supercompression scheme {} is not supported; none and Zstandard are",
                    header.supercompression));
  }
  if (header.type_size != find_texel_layout(texture.format)->type_size) {
    file.fail(fmt::format("is corrupt: a number of its format does not have {} bytes", header.type_size));
  }
  check_descriptor(file, header);
  texture.metadata = read_metadata(file, header);
  return {std::move(texture), levels, header.supercompression == kZstandard};
}

/// A file up to where its key/value data end, as its header says; less where the file ends before.
std::vector<std::byte> first_bytes(const fs::path& path) {
  std::error_code code;
  if (!fs::is_regular_file(path, code)) return read_bytes(path);  // which says what is wrong, or reads a pipe
  std::ifstream in(path, std::ios::binary);
  if (!in) return read_bytes(path);
  std::vector<std::byte> bytes(kIndexOffset);
  const auto read_on = [&](std::size_t from) {
    in.read(reinterpret_cast<char*>(bytes.data() + from), static_cast<std::streamsize>(bytes.size() - from));
    bytes.resize(from + static_cast<std::size_t>(in.gcount()));
  };
  read_on(0);
  if (bytes.size() < kIndexOffset) return bytes;
  Header header{};
  std::memcpy(&header, bytes.data() + sizeof kIdentifier, sizeof header);
  const std::uint64_t end = std::max(std::uint64_t{header.descriptor_offset} + header.descriptor_bytes,
                                     std::uint64_t{header.metadata_offset} + header.metadata_bytes);
  bytes.resize(
      static_cast<std::size_t>(std::clamp<std::uint64_t>(end, kIndexOffset, fs::file_size(path, code))));
  read_on(kIndexOffset);
  return bytes;
}

std::vector<std::byte> inflate(const Reader& file, std::span<const std::byte> packed, std::size_t bytes,
                               std::uint32_t level) {
  // A Zstandard block holds at most 128 KiB and takes at least 4 bytes; a claim beyond that is not worth its
  // memory.
  constexpr std::size_t kBlock = std::size_t{128} << 10;
  if (bytes / kBlock > packed.size() / 4) {
    file.fail(
        fmt::format("is corrupt: mip level {} claims {} bytes, more than its {} compressed bytes can hold",
                    level, bytes, packed.size()));
  }
  const unsigned long long claimed =
      ZSTD_getFrameContentSize(packed.data(), packed.size());  // of the first frame
  if (claimed == ZSTD_CONTENTSIZE_ERROR || (claimed != ZSTD_CONTENTSIZE_UNKNOWN && claimed > bytes)) {
    file.fail(fmt::format("is truncated or corrupt: mip level {} does not hold {} bytes", level, bytes));
  }
  std::vector<std::byte> result(bytes);
  const std::size_t done = ZSTD_decompress(result.data(), result.size(), packed.data(), packed.size());
  if (ZSTD_isError(done) != 0) {
    file.fail(fmt::format("is truncated or corrupt: mip level {}: {}", level, ZSTD_getErrorName(done)));
  }
  if (done != bytes) {
    file.fail(fmt::format("is corrupt: mip level {} holds {} bytes instead of {}", level, done, bytes));
  }
  return result;
}

std::vector<std::byte> read_level(const Reader& file, const Ktx2& texture, std::uint32_t level,
                                  bool compressed) {
  const auto entry = file.get<LevelEntry>(kIndexOffset + level * sizeof(LevelEntry), "its level index");
  const std::string what = fmt::format("mip level {}", level);
  const auto stored = file.part(entry.offset, entry.bytes, what);
  const std::size_t bytes = ktx2_level_bytes(texture, level);
  if (entry.uncompressed_bytes != bytes || (!compressed && entry.bytes != bytes)) {
    file.fail(fmt::format("is corrupt: {} has {} bytes where its size and format need {}", what,
                          compressed ? entry.uncompressed_bytes : entry.bytes, bytes));
  }
  if (compressed) return inflate(file, stored, bytes, level);
  return {stored.begin(), stored.end()};
}

// ---- writing

void append(std::vector<std::byte>& out, const void* data, std::size_t bytes) {
  const auto* begin = static_cast<const std::byte*>(data);
  out.insert(out.end(), begin, begin + bytes);
}

// The checksum of a file is that of its bytes with zeros for the checksum's digits.
constexpr const char* kChecksumKey = "sateen.checksum";
const std::string kNoChecksum(32, '0');

/// The digits of a file's checksum; empty if it has none.
std::span<std::byte> checksum_digits(std::vector<std::byte>& file) {
  const std::string entry = std::string(kChecksumKey) + '\0';
  const auto key = std::as_bytes(std::span(entry));
  const auto found = std::search(file.begin(), file.end(), key.begin(), key.end());
  const auto digits = static_cast<std::size_t>(found - file.begin()) + key.size();
  if (found == file.end() || digits + kNoChecksum.size() > file.size()) return {};
  return std::span(file).subspan(digits, kNoChecksum.size());
}

void set_digits(std::span<std::byte> digits, const std::string& text) {
  std::ranges::copy(std::as_bytes(std::span(text)), digits.begin());
}

std::vector<std::byte> packed_metadata(std::map<std::string, std::string> metadata) {
  metadata["KTXwriter"] = "Sateen " SATEEN_VERSION;
  if (metadata.contains("sateen.kind")) metadata[kChecksumKey] = kNoChecksum;
  std::vector<std::byte> out;
  for (const auto& [key, value] : metadata) {  // a map is sorted, as the format demands
    const auto length = static_cast<std::uint32_t>(key.size() + value.size() + 2);
    append(out, &length, sizeof length);
    append(out, key.c_str(), key.size() + 1);
    append(out, value.c_str(), value.size() + 1);
    out.resize((out.size() + 3) / 4 * 4);
  }
  return out;
}

std::vector<std::byte> deflate(const fs::path& path, std::span<const std::byte> level, int zstd_level) {
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), ZSTD_freeCCtx);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, zstd_level);
  // Jobs of a megabyte, whatever the number of threads, so that the file is always the same. A library built
  // without threads refuses them and does without.
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_nbWorkers, thread_limit());
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_jobSize, 1 << 20);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);  // readers see a flipped bit
  std::vector<std::byte> packed(ZSTD_compressBound(level.size()));
  const std::size_t bytes =
      ZSTD_compress2(context.get(), packed.data(), packed.size(), level.data(), level.size());
  if (ZSTD_isError(bytes) != 0) {
    throw Error(fmt::format("{}: cannot be compressed: {}", path.string(), ZSTD_getErrorName(bytes)));
  }
  packed.resize(bytes);
  return packed;
}

void check_writable(const fs::path& path, const Ktx2& texture, int zstd_level) {
  const auto fail = [&](const std::string& what) {
    throw Error(fmt::format("{}: cannot be written: {}", path.string(), what));
  };
  if (const auto fault = dimension_fault(texture, texture.levels.size())) fail(*fault);
  for (std::uint32_t i = 0; i < texture.levels.size(); ++i) {
    const std::size_t bytes = ktx2_level_bytes(texture, i);
    if (texture.levels[i].size() != bytes) {
      fail(fmt::format("mip level {} has {} bytes where its size and format need {}", i,
                       texture.levels[i].size(), bytes));
    }
  }
  for (const auto& [key, value] : texture.metadata) {
    if (key.empty() || key.find('\0') != std::string::npos || value.find('\0') != std::string::npos) {
      fail(fmt::format("the metadata '{}' are no plain text", key));
    }
  }
  if (zstd_level < 0 || zstd_level > ZSTD_maxCLevel()) {
    fail(fmt::format("the Zstandard level {} is not in 0 to {}", zstd_level, ZSTD_maxCLevel()));
  }
}

}  // namespace

std::size_t ktx2_level_bytes(const Ktx2& texture, std::uint32_t level) {
  if (find_texel_layout(texture.format) == nullptr) {
    throw Error(
        fmt::format("the texel format {} is not supported", static_cast<std::uint32_t>(texture.format)));
  }
  const double bytes = level_bytes(texture, level);
  if (bytes > kMostBytes) throw Error(too_large(texture, bytes));
  return static_cast<std::size_t>(bytes);
}

Ktx2 read_ktx2_info(const fs::path& path) {
  const std::vector<std::byte> bytes = first_bytes(path);
  return read_header(Reader(path, bytes)).texture;
}

bool ktx2_is_whole(const fs::path& path) {
  std::vector<std::byte> bytes = read_bytes(path);
  const std::span<std::byte> digits = checksum_digits(bytes);
  const std::string said(reinterpret_cast<const char*>(digits.data()), digits.size());
  set_digits(digits, kNoChecksum.substr(0, digits.size()));
  return said == checksum(bytes);
}

Ktx2 read_ktx2(const fs::path& path, const std::function<void(const Ktx2&)>& check) {
  const std::vector<std::byte> bytes = read_bytes(path);
  const Reader file(path, bytes);
  auto [texture, levels, compressed] = read_header(file);
  if (check) check(texture);
  const double texels = 1.0 * texture.width * texture.height * std::max(1u, texture.depth) *
                        std::max(1u, texture.layers) * texture.faces;
  if (texels > static_cast<double>(max_pixels())) {
    file.fail(fmt::format(
        "has {} x {} x {} texels in {} layers; {} texels are the most that are read (--max-pixels)",
        texture.width, texture.height, std::max(1u, texture.depth), std::max(1u, texture.layers),
        max_pixels()));
  }
  for (std::uint32_t i = 0; i < levels; ++i)
    texture.levels.push_back(read_level(file, texture, i, compressed));
  return texture;
}

namespace {

/// The whole file; `path` is for messages.
std::vector<std::byte> file_bytes(const fs::path& path, const Ktx2& texture, int zstd_level) {
  check_writable(path, texture, zstd_level);
  const TexelLayout& layout = *find_texel_layout(texture.format);
  const bool compressed = zstd_level > 0;
  const auto descriptor = data_format_descriptor(layout);
  const auto metadata = packed_metadata(texture.metadata);

  Header header{};
  header.format = static_cast<std::uint32_t>(texture.format);
  header.type_size = layout.type_size;
  header.width = texture.width;
  header.height = texture.height;
  header.depth = texture.depth;
  header.layers = texture.layers;
  header.faces = texture.faces;
  header.levels = static_cast<std::uint32_t>(texture.levels.size());
  header.supercompression = compressed ? kZstandard : kNoSupercompression;
  header.descriptor_offset =
      static_cast<std::uint32_t>(kIndexOffset + texture.levels.size() * sizeof(LevelEntry));
  header.descriptor_bytes = static_cast<std::uint32_t>(descriptor.size() * sizeof descriptor[0]);
  header.metadata_offset = header.descriptor_offset + header.descriptor_bytes;
  header.metadata_bytes = static_cast<std::uint32_t>(metadata.size());

  std::vector<std::byte> out;
  append(out, kIdentifier.data(), sizeof kIdentifier);
  append(out, &header, sizeof header);
  out.resize(header.descriptor_offset);  // the level index is filled in below
  append(out, descriptor.data(), header.descriptor_bytes);
  append(out, metadata.data(), metadata.size());
  const std::size_t alignment = compressed ? 1 : std::lcm<std::size_t>(layout.block_bytes, 4);
  for (std::size_t i = texture.levels.size(); i-- > 0;) {
    const std::vector<std::byte> packed =
        compressed ? deflate(path, texture.levels[i], zstd_level) : std::vector<std::byte>();
    const std::span<const std::byte> level = compressed ? packed : texture.levels[i];
    out.resize((out.size() + alignment - 1) / alignment * alignment);
    const LevelEntry entry{out.size(), level.size(), texture.levels[i].size()};
    std::memcpy(out.data() + kIndexOffset + i * sizeof entry, &entry, sizeof entry);
    append(out, level.data(), level.size());
  }
  if (texture.metadata.contains("sateen.kind")) set_digits(checksum_digits(out), checksum(out));
  return out;
}

}  // namespace

void write_ktx2(const fs::path& path, const Ktx2& texture, int zstd_level) {
  write_bytes(path, file_bytes(path, texture, zstd_level));
}

void write_ktx2(std::span<const fs::path> paths, std::span<const Ktx2> textures, int zstd_level) {
  std::vector<std::vector<std::byte>> files;
  for (std::size_t i = 0; i < paths.size(); ++i)
    files.push_back(file_bytes(paths[i], textures[i], zstd_level));
  write_bytes(paths, files);
}

}  // namespace sateen::io
