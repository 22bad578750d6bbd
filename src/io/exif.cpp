// SPDX-License-Identifier: MIT
#include "sateen/io/exif.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <vector>

#include "sateen/io/file_stream.h"

namespace sateen::io {
namespace {

constexpr unsigned kOrientation = 0x0112;
constexpr unsigned kExposureTime = 0x829a;
constexpr unsigned kExifDirectory = 0x8769;
constexpr unsigned kFocalLength = 0x920a;
constexpr unsigned kFocalLengthIn35mm = 0xa405;

/// A TIFF structure in memory; numbers beyond its end are 0.
struct Tiff {
  std::span<const std::byte> bytes;
  bool big_endian = false;

  unsigned number(std::size_t at, std::size_t count) const {
    if (at > bytes.size() || count > bytes.size() - at) return 0;
    unsigned value = 0;
    for (std::size_t i = 0; i < count; ++i)
      value = value << 8 | static_cast<unsigned>(bytes[at + (big_endian ? i : count - 1 - i)]);
    return value;
  }

  /// The first value of the directory entry at `at`: a whole number or a ratio of two.
  double value(std::size_t at) const {
    constexpr unsigned kByte = 1;
    constexpr unsigned kShort = 3;
    constexpr unsigned kLong = 4;
    constexpr unsigned kRational = 5;
    constexpr unsigned kDirectory = 13;
    switch (number(at + 2, 2)) {
      case kByte:
        return number(at + 8, 1);
      case kShort:
        return number(at + 8, 2);
      case kLong:
      case kDirectory:
        return number(at + 8, 4);
      case kRational: {
        const std::size_t ratio = number(at + 8, 4);
        const unsigned divisor = number(ratio + 4, 4);
        return divisor == 0 ? 0 : static_cast<double>(number(ratio, 4)) / divisor;
      }
      default:
        return 0;
    }
  }
};

void read_directory(const Tiff& tiff, std::size_t directory, bool inner, ExifNotes& notes) {
  const unsigned entries = tiff.number(directory, 2);
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + 12 * i;
    if (entry + 12 > tiff.bytes.size()) return;
    const double value = tiff.value(entry);
    const double positive = value > 0 && value < 1e5 ? value : 0;
    switch (tiff.number(entry, 2)) {
      case kOrientation:
        if (!inner && value >= 1 && value <= 8) notes.orientation = static_cast<int>(value);
        break;
      case kExposureTime:
        notes.exposure_time = positive;
        break;
      case kFocalLength:
        notes.focal_mm = positive;
        break;
      case kFocalLengthIn35mm:
        notes.focal_35mm = positive;
        break;
      case kExifDirectory:
        if (!inner) read_directory(tiff, static_cast<std::size_t>(value), true, notes);
        break;
      default:
        break;
    }
  }
}

using Head = std::array<std::byte, 12>;

std::uint32_t number_of(std::span<const std::byte> bytes, std::size_t at, std::size_t count,
                        bool big_endian) {
  return Tiff{bytes, big_endian}.number(at, count);
}

std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

bool read_head(std::FILE* file, std::span<std::byte> head) {
  return std::fread(head.data(), 1, head.size(), file) == head.size();
}

std::vector<std::byte> read_some(std::FILE* file, std::size_t count, std::uintmax_t at_most) {
  if (count > at_most) return {};
  std::vector<std::byte> bytes(count);
  bytes.resize(std::fread(bytes.data(), 1, count, file));
  return bytes;
}

/// What stands behind "Exif" and two zeros, which some writers put before the block.
std::vector<std::byte> without_name(std::vector<std::byte> block) {
  constexpr std::size_t kName = 6;
  if (block.size() >= kName && text_of(block).starts_with("Exif"))
    block.erase(block.begin(), block.begin() + static_cast<std::ptrdiff_t>(kName));
  return block;
}

/// From behind the start marker.
std::vector<std::byte> block_of_jpeg(std::FILE* file, std::uintmax_t size) {
  std::array<std::byte, 4> segment{};
  std::fseek(file, 2, SEEK_SET);
  while (read_head(file, segment)) {
    const unsigned marker = number_of(segment, 0, 2, true);
    const std::size_t length = number_of(segment, 2, 2, true);
    constexpr unsigned kExif = 0xffe1;
    constexpr unsigned kScan = 0xffda;
    if (marker < 0xff00 || marker == kScan || length < 2) return {};
    const long next = std::ftell(file) + static_cast<long>(length) - 2;
    if (marker == kExif) {
      std::vector<std::byte> block = read_some(file, length - 2, size);
      if (text_of(block).starts_with("Exif")) return without_name(std::move(block));
    }
    std::fseek(file, next, SEEK_SET);
  }
  return {};
}

/// Chunks of PNG (`big_endian`, length then name, 4 bytes behind) and RIFF (name then length, even).
std::vector<std::byte> block_in_chunks(std::FILE* file, std::uintmax_t size, long first,
                                       std::string_view wanted, bool png) {
  std::array<std::byte, 8> chunk{};
  std::fseek(file, first, SEEK_SET);
  while (read_head(file, chunk)) {
    const std::size_t length = number_of(chunk, png ? 0 : 4, 4, png);
    if (text_of(chunk).substr(png ? 4 : 0, 4) == wanted) return without_name(read_some(file, length, size));
    if (length > size) return {};
    std::fseek(file, static_cast<long>(png ? length + 4 : length + length % 2), SEEK_CUR);
  }
  return {};
}

}  // namespace

ExifNotes read_exif(std::span<const std::byte> block) {
  ExifNotes notes;
  const std::string_view text = text_of(block);
  if (block.size() < 8 || (!text.starts_with("II") && !text.starts_with("MM"))) return notes;
  const Tiff tiff{block, text[0] == 'M'};
  read_directory(tiff, tiff.number(4, 4), false, notes);
  return notes;
}

ExifNotes read_exif_of_file(const std::filesystem::path& path) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code)) return {};
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  const FileStream file(std::fopen(path.c_str(), "rbe"));
  Head head{};
  if (!file || code || !read_head(file.get(), head)) return {};
  const std::string_view start = text_of(head);
  if (start.starts_with("\xff\xd8")) return read_exif(block_of_jpeg(file.get(), size));
  if (start.starts_with("\x89PNG")) return read_exif(block_in_chunks(file.get(), size, 8, "eXIf", true));
  if (start.starts_with("RIFF") && start.ends_with("WEBP"))
    return read_exif(block_in_chunks(file.get(), size, 12, "EXIF", false));
  if (!start.starts_with("II*") && !start.starts_with(std::string_view("MM\0*", 4))) return {};
  std::rewind(file.get());
  return read_exif(read_some(file.get(), static_cast<std::size_t>(size), size));
}

}  // namespace sateen::io
