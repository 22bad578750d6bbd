// SPDX-License-Identifier: MIT
#include "parse.h"

#include <charconv>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "sateen/core/colour.h"

namespace sateen::cli {
namespace {

[[noreturn]] void fail(const std::string& option, const std::string& text, const std::string& right) {
  throw CLI::ValidationError(option, fmt::format("\"{}\" is not understood; write {}", text, right));
}

template <class Number>
bool read_number(std::string_view text, Number& value) {
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  return code == std::errc{} && end == text.data() + text.size();
}

/// Three finite numbers between commas; nothing otherwise.
std::optional<Vec3> three_numbers(const std::string& text) {
  Vec3 result;
  std::size_t begin = 0;
  for (int i = 0; i < 3; ++i) {
    const std::size_t comma = text.find(',', begin);
    if ((i < 2) == (comma == std::string::npos)) return std::nullopt;
    if (!read_number(std::string_view(text).substr(begin, comma - begin), result[i])) return std::nullopt;
    begin = comma + 1;
  }
  return result.allFinite() ? std::optional(result) : std::nullopt;
}

/// The two numbers on either side of a character; nothing otherwise.
std::optional<std::pair<int, int>> two_numbers(std::string_view text, char between) {
  const std::size_t at = text.find(between);
  std::pair<int, int> result;
  if (at == std::string_view::npos || !read_number(text.substr(0, at), result.first) ||
      !read_number(text.substr(at + 1), result.second))
    return std::nullopt;
  return result;
}

}  // namespace

std::pair<int, int> parse_size(const std::string& option, const std::string& text) {
  int square = 0;
  const auto size = read_number(text, square) ? std::pair{square, square}
                                              : two_numbers(text, 'x').value_or(std::pair{0, 0});
  const auto [width, height] = size;
  constexpr int largest = 65536;
  if (width < 1 || height < 1 || width > largest || height > largest) {
    fail(option, text, "WIDTHxHEIGHT in pixels, such as 1024x768");
  }
  return size;
}

std::pair<int, int> parse_shard(const std::string& option, const std::string& text) {
  const auto shard = two_numbers(text, '/').value_or(std::pair{0, 0});
  if (shard.first < 1 || shard.first > shard.second)
    fail(option, text, "I/N with I from 1 to N, such as 2/8");
  return shard;
}

Vec3 parse_vector(const std::string& option, const std::string& text) {
  const auto value = three_numbers(text);
  if (!value) fail(option, text, "three numbers X,Y,Z");
  return *value;
}

Vec3 parse_axis(const std::string& option, const std::string& text) {
  if (text == "x") return Vec3::UnitX();
  if (text == "y") return Vec3::UnitY();
  if (text == "z") return Vec3::UnitZ();
  const auto value = three_numbers(text);
  if (!value || !(value->norm() > 0)) fail(option, text, "x, y, z or X,Y,Z");
  return value->normalized();
}

std::optional<Vec3f> parse_background(const std::string& option, const std::string& text) {
  if (text == "transparent") return std::nullopt;
  if (text.size() == 7 && text[0] == '#') {
    Vec3f colour;
    for (int c = 0; c < 3; ++c) {
      int value = 0;
      const char* begin = text.data() + 1 + 2 * c;
      const auto [end, code] = std::from_chars(begin, begin + 2, value, 16);
      if (code != std::errc{} || end != begin + 2) fail(option, text, "#rrggbb, R,G,B or transparent");
      colour[c] = srgb_decode(static_cast<float>(value) / 255);
    }
    return colour;
  }
  const auto value = three_numbers(text);
  if (!value) fail(option, text, "#rrggbb (sRGB), R,G,B (linear light) or transparent");
  return Vec3f(value->cast<float>());
}

}  // namespace sateen::cli
