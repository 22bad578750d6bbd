// SPDX-License-Identifier: MIT
#include "sateen/io/exr_channels.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <span>
#include <string_view>
#include <tuple>

namespace sateen::io {
namespace {

std::string layer_of(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string::npos ? "" : name.substr(0, dot + 1);
}

std::string suffix_of(const std::string& name) {
  return name.substr(layer_of(name).size());
}

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

constexpr std::string_view kColours[] = {"R",    "RED",  "G",  "GREEN", "B",     "BLUE", "Y",
                                         "REAL", "IMAG", "A",  "ALPHA", "AR",    "RA",   "AG",
                                         "GA",   "AB",   "BA", "Z",     "DEPTH", "ZBACK"};
constexpr std::string_view kVectors[] = {"R",  "RED", "G",    "GREEN", "B",  "BLUE",  "X",
                                         "Y",  "Z",   "REAL", "IMAG",  "A",  "ALPHA", "AR",
                                         "RA", "AG",  "GA",   "AB",    "BA", "DEPTH", "ZBACK"};

std::ptrdiff_t rank(std::span<const std::string_view> order, const std::string& suffix) {
  return std::ranges::find(order, upper(suffix)) - order.begin();
}

}  // namespace

std::vector<std::string> in_picture_order(std::vector<std::string> names) {
  std::set<std::string> xs;  // layers with such a channel
  std::set<std::string> ys_or_zs;
  for (const std::string& name : names) {
    const std::string suffix = upper(suffix_of(name));
    if (suffix == "X") xs.insert(layer_of(name));
    if (suffix == "Y" || suffix == "Z") ys_or_zs.insert(layer_of(name));
  }
  const auto key = [&](const std::string& name) {
    const std::string layer = layer_of(name);
    const std::string suffix = suffix_of(name);
    const bool vectors = xs.contains(layer) && ys_or_zs.contains(layer);
    return std::tuple(layer, vectors ? rank(kVectors, suffix) : rank(kColours, suffix), suffix);
  };
  std::ranges::sort(names, [&](const std::string& a, const std::string& b) { return key(a) < key(b); });
  return names;
}

bool is_alpha_channel(const std::string& name) {
  const std::string suffix = upper(suffix_of(name));
  return suffix == "A" || suffix == "ALPHA";
}

}  // namespace sateen::io
