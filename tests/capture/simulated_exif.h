// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sateen/io/file.h"

namespace sateen::test {

/// Puts an EXIF block (the bytes behind "Exif\0\0") into a JPEG file.
inline void put_exif(const std::filesystem::path& jpeg, const std::string& block) {
  const std::vector<std::byte> old = io::read_bytes(jpeg);
  std::string segment("Exif\0\0", 6);
  segment += block;
  const std::size_t length = segment.size() + 2;
  std::string bytes("\xff\xd8\xff\xe1", 4);
  bytes += static_cast<char>(length >> 8);
  bytes += static_cast<char>(length & 255);
  bytes += segment;
  for (std::size_t i = 2; i < old.size(); ++i) bytes += static_cast<char>(old[i]);
  io::write_text(jpeg, bytes);
}

/// An EXIF block that holds an exposure time (seconds, as a rational number) and nothing else.
inline std::string exposure_time_exif(std::uint32_t numerator, std::uint32_t denominator) {
  std::string block("II*\0", 4);
  const auto put = [&](std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) block += static_cast<char>(value >> (8 * i) & 255);
  };
  const auto directory = [&](std::uint32_t tag, std::uint32_t type, std::uint32_t value) {
    put(1, 2);  // one entry
    put(tag, 2);
    put(type, 2);
    put(1, 4);
    put(value, 4);
    put(0, 4);  // no further directory
  };
  put(8, 4);
  directory(0x8769, 4, 26);  // where the EXIF directory starts
  directory(0x829a, 5, 44);  // where the rational number lies
  put(numerator, 4);
  put(denominator, 4);
  return block;
}

}  // namespace sateen::test
