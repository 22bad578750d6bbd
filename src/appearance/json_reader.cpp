// SPDX-License-Identifier: MIT
#include "sateen/appearance/json_reader.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sateen/core/error.h"
#include "sateen/io/json.h"

namespace sateen::appearance {

namespace {

std::string short_dump(const nlohmann::json& value) {
  std::string text = io::json_text(value);
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

bool three_numbers(const nlohmann::json& value) {
  return value.is_array() && value.size() == 3 && value[0].is_number() && value[1].is_number() &&
         value[2].is_number();
}

Vec3 vector_of(const nlohmann::json& value) {
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

}  // namespace

JsonObject::JsonObject(const nlohmann::json& value, std::string where)
    : value_(&value), where_(std::move(where)) {
  if (!value.is_object()) {
    throw Error(fmt::format("{}: expected an object {{...}}, found {}", where_, short_dump(value)));
  }
}

void JsonObject::fail(const std::string& key, const std::string& what) const {
  const std::string found = has(key) ? short_dump((*value_)[spelled(key)]) : "nothing";
  throw Error(fmt::format("{}: \"{}\" must be {}, found {}", where_, key, what, found));
}

std::string JsonObject::spelled(const std::string& key) const {
  const std::size_t at = key.find("color");
  if (at == std::string::npos || value_->contains(key)) return key;
  std::string british = key;
  british.replace(at, 5, "colour");
  return value_->contains(british) ? british : key;
}

bool JsonObject::has(const std::string& key) const {
  return value_->contains(spelled(key));
}

const nlohmann::json& JsonObject::raw(const std::string& key) {
  known_.insert(key);
  if (!has(key)) throw Error(fmt::format("{}: \"{}\" is missing", where_, key));
  return (*value_)[spelled(key)];
}

double JsonObject::number(const std::string& key, double fallback, Range range) {
  known_.insert(key);
  if (!has(key)) return fallback;
  const nlohmann::json& value = raw(key);
  const double x = value.is_number() ? value.get<double>() : std::nan("");
  const bool inside = (range.low_open ? x > range.low : x >= range.low) &&
                      (range.high_open ? x < range.high : x <= range.high);
  if (!inside) {
    fail(key, fmt::format("a number in {}{}, {}{}", range.low_open ? '(' : '[', range.low, range.high,
                          range.high_open ? ')' : ']'));
  }
  return x;
}

bool JsonObject::flag(const std::string& key, bool fallback) {
  known_.insert(key);
  if (!has(key)) return fallback;
  if (!raw(key).is_boolean()) fail(key, "true or false");
  return raw(key).get<bool>();
}

std::string JsonObject::text(const std::string& key, const std::string& fallback) {
  known_.insert(key);
  if (!has(key)) return fallback;
  if (!raw(key).is_string()) fail(key, "a string");
  return raw(key).get<std::string>();
}

std::string JsonObject::choice(const std::string& key, const std::string& fallback,
                               std::span<const std::string> choices) {
  const std::string chosen = has(key) && !raw(key).is_string() ? "" : text(key, fallback);
  for (const std::string& candidate : choices) {
    if (chosen == candidate) return chosen;
  }
  fail(key, fmt::format("one of {}", fmt::join(choices, ", ")));
}

Vec3 JsonObject::color(const std::string& key, const Vec3& fallback, double high) {
  known_.insert(key);
  if (!has(key)) return fallback;
  const nlohmann::json& value = raw(key);
  const std::string expected = fmt::format("[r, g, b] or one number, each in [0, {}]", high);
  if (!value.is_number() && !three_numbers(value)) fail(key, expected);
  const Vec3 rgb = value.is_number() ? Vec3::Constant(value.get<double>()) : vector_of(value);
  if (!(rgb.minCoeff() >= 0 && rgb.maxCoeff() <= high)) fail(key, expected);
  return rgb;
}

Vec2 JsonObject::pair(const std::string& key, const Vec2& fallback, Range range) {
  known_.insert(key);
  if (!has(key)) return fallback;
  const nlohmann::json& value = raw(key);
  const bool listed = value.is_array() && value.size() == 2 && value[0].is_number() && value[1].is_number();
  const std::string expected = fmt::format("a number or [x, y] in [{}, {}]", range.low, range.high);
  if (!listed && !value.is_number()) fail(key, expected);
  const Vec2 xy =
      listed ? Vec2(value[0].get<double>(), value[1].get<double>()) : Vec2::Constant(value.get<double>());
  if (!(xy.minCoeff() >= range.low && xy.maxCoeff() <= range.high)) fail(key, expected);
  return xy;
}

ParameterValue JsonObject::read(const Parameter& parameter) {
  const std::string key = parameter.name.substr(parameter.name.rfind('.') + 1);
  known_.insert(key);
  if (!has(key)) return parameter.standard;
  const nlohmann::json& value = raw(key);
  ParameterValue result = std::nan("");
  if (parameter.kind == Parameter::Kind::color && (value.is_number() || three_numbers(value))) {
    result = value.is_number() ? Vec3(Vec3::Constant(value.get<double>())) : vector_of(value);
  } else if (value.is_boolean()) {
    result = value.get<bool>();
  } else if (value.is_string()) {
    result = value.get<std::string>();
  } else if (value.is_number()) {
    result = value.get<double>();
  }
  if (!allows(parameter, result)) fail(key, expectation(parameter));
  return result;
}

void JsonObject::allow(std::initializer_list<const char*> keys) {
  known_.insert(keys.begin(), keys.end());
}

Vec3 JsonObject::direction(const std::string& key) {
  const nlohmann::json& value = raw(key);
  const std::string expected = "[x, y, z], a direction of positive length";
  if (!three_numbers(value)) fail(key, expected);
  const Vec3 v = vector_of(value);
  const double largest = v.cwiseAbs().maxCoeff();
  if (!(largest > 0) || !std::isfinite(largest)) fail(key, expected);
  return (v / largest).normalized();
}

Vec3 JsonObject::point(const std::string& key) {
  const nlohmann::json& value = raw(key);
  if (!three_numbers(value)) fail(key, "[x, y, z]");
  return vector_of(value);
}

void JsonObject::finish() const {
  for (const auto& [key, value] : value_->items()) {
    if (std::ranges::none_of(known_, [&, &name = key](const std::string& k) { return spelled(k) == name; })) {
      throw Error(
          fmt::format("{}: unknown key \"{}\"; known here: {}", where_, key, fmt::join(known_, ", ")));
    }
  }
}

}  // namespace sateen::appearance
