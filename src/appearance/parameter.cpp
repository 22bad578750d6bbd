// SPDX-License-Identifier: MIT
#include "sateen/appearance/parameter.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sateen/core/error.h"

namespace sateen::appearance {
namespace {

std::string interval(const Parameter& parameter) {
  return fmt::format("{}{}, {}{}", parameter.low_open ? '(' : '[', parameter.low, parameter.high,
                     parameter.high_open ? ')' : ']');
}

std::string shown(const ParameterValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{:.6g}", *number);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  const Vec3& color = std::get<Vec3>(value);
  if (color.x() == color.y() && color.y() == color.z()) return fmt::format("{:.6g}", color.x());
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", color.x(), color.y(), color.z());
}

}  // namespace

std::string expectation(const Parameter& parameter) {
  switch (parameter.kind) {
    case Parameter::Kind::number:
      return "a number in " + interval(parameter);
    case Parameter::Kind::integer:
      return "a whole number in " + interval(parameter);
    case Parameter::Kind::color:
      return fmt::format("[r, g, b] or one number, each in {}", interval(parameter));
    case Parameter::Kind::flag:
      return "true or false";
    case Parameter::Kind::choice:
      break;
  }
  return fmt::format("one of {}", fmt::join(parameter.choices, ", "));
}

bool allows(const Parameter& parameter, const ParameterValue& value) {
  const auto inside = [&](double x) {
    return (parameter.low_open ? x > parameter.low : x >= parameter.low) &&
           (parameter.high_open ? x < parameter.high : x <= parameter.high);
  };
  switch (parameter.kind) {
    case Parameter::Kind::number:
      return std::holds_alternative<double>(value) && inside(std::get<double>(value));
    case Parameter::Kind::integer:
      return std::holds_alternative<double>(value) && inside(std::get<double>(value)) &&
             std::get<double>(value) == std::floor(std::get<double>(value));
    case Parameter::Kind::color:
      return std::holds_alternative<Vec3>(value) && inside(std::get<Vec3>(value).minCoeff()) &&
             inside(std::get<Vec3>(value).maxCoeff());
    case Parameter::Kind::flag:
      return std::holds_alternative<bool>(value);
    case Parameter::Kind::choice:
      break;
  }
  return std::holds_alternative<std::string>(value) &&
         std::ranges::count(parameter.choices, std::get<std::string>(value)) > 0;
}

void unknown_parameter(const std::string& name, std::span<const Parameter> known) {
  std::vector<std::string> names;
  for (const Parameter& parameter : known) names.push_back(parameter.name);
  throw Error(fmt::format("there is no parameter \"{}\"; known here: {}", name, fmt::join(names, ", ")));
}

void check(const Parameter& parameter, const ParameterValue& value) {
  if (allows(parameter, value)) return;
  throw Error(
      fmt::format("\"{}\" must be {}, found {}", parameter.name, expectation(parameter), shown(value)));
}

std::string markdown(std::span<const Parameter> parameters) {
  std::string table = "| parameter | meaning | range | default |\n|---|---|---|---|\n";
  for (const Parameter& parameter : parameters) {
    const bool words = parameter.kind == Parameter::Kind::choice || parameter.kind == Parameter::Kind::flag;
    const std::string range =
        words ? expectation(parameter)
              : interval(parameter) + (parameter.unit.empty() ? "" : " " + parameter.unit);
    table += fmt::format("| `{}` | {} | {} | {} |\n", parameter.name, parameter.help, range,
                         shown(parameter.standard));
  }
  return table;
}

}  // namespace sateen::appearance
