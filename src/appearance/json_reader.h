// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <initializer_list>
#include <set>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

#include "sateen/appearance/parameter.h"
#include "sateen/core/vector.h"

// Heavy to compile: include it in .cpp files only.

namespace sateen::appearance {

/// One JSON object of a user's file, read key by key. Every complaint is an Error that names file, key and
/// value, and says what would be right; finish() complains about keys nobody asked for.
class JsonObject {
 public:
  /// `where` names the object in messages: the file, and the place in it where there are several. Throws
  /// Error when `value` is no object.
  JsonObject(const nlohmann::json& value, std::string where);

  bool has(const std::string& key) const;
  /// A number in [low, high] ("open" ends exclude themselves), or `fallback` where the key is missing.
  struct Range {
    double low;
    double high;
    bool low_open = false;
    bool high_open = false;
  };
  double number(const std::string& key, double fallback, Range range);
  bool flag(const std::string& key, bool fallback);
  std::string choice(const std::string& key, const std::string& fallback,
                     std::span<const std::string> choices);
  std::string text(const std::string& key, const std::string& fallback);
  /// [r, g, b] or one number, each in [0, high]. A key "color" may be spelled "colour" in files, here and in
  /// read().
  Vec3 color(const std::string& key, const Vec3& fallback, double high = 1);
  /// One number or [x, y], each in the closed range.
  Vec2 pair(const std::string& key, const Vec2& fallback, Range range);
  /// [x, y, z] of any positive length, returned unit. The key must be there.
  Vec3 direction(const std::string& key);
  /// [x, y, z], anywhere. The key must be there.
  Vec3 point(const std::string& key);
  const nlohmann::json& raw(const std::string& key);
  /// The value of a parameter, whose key is the last part of its name, or its standard value where the key is
  /// missing.
  ParameterValue read(const Parameter& parameter);
  /// Keys that are known without having been asked for: alternatives that this file did not take.
  void allow(std::initializer_list<const char*> keys);

  [[noreturn]] void fail(const std::string& key, const std::string& what) const;
  void finish() const;

 private:
  /// The key as the file spells it.
  std::string spelled(const std::string& key) const;

  const nlohmann::json* value_;
  std::string where_;
  std::set<std::string> known_;
};

}  // namespace sateen::appearance
