// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "sateen/core/vector.h"

namespace sateen::appearance {

/// A parameter's value: a number or angle, a colour (linear Rec. 709), a switch, one of several words.
using ParameterValue = std::variant<double, Vec3, bool, std::string>;

/// What is said once of one parameter of an appearance; reading of JSON, sliders and the documentation come
/// from it.
struct Parameter {
  enum class Kind { number, integer, color, flag, choice };
  std::string name = {};  ///< the path in a material's JSON, "fuzz.density"
  Kind kind = Kind::number;
  std::string unit = {};  ///< "degrees", "1/m"; empty: a ratio or none
  double low = 0;         ///< smallest and largest value, of each channel for a colour
  double high = 1;
  bool low_open = false;  ///< the end itself is not allowed
  bool high_open = false;
  std::vector<std::string> choices = {};  ///< of Kind::choice
  ParameterValue standard = 0.0;          ///< the value where nothing is said
  std::string help = {};                  ///< one line
};

/// What would be right: "a number in [0, 100]", "one of sggx, schlick".
std::string expectation(const Parameter& parameter);

/// Whether the value is of the parameter's kind and inside its range.
bool allows(const Parameter& parameter, const ParameterValue& value);

/// A parameter tied to a place in a struct of parameters, in the units of Parameter (angles in degrees there,
/// in radians in the struct).
template <class Owner>
struct ParameterField {
  Parameter parameter;
  std::function<ParameterValue(const Owner&)> get;
  std::function<void(Owner&, const ParameterValue&)> set;
};

/// The descriptions alone.
template <class Owner>
std::vector<Parameter> descriptions(std::span<const ParameterField<Owner>> fields) {
  std::vector<Parameter> result;
  for (const auto& field : fields) result.push_back(field.parameter);
  return result;
}

/// The field of that name. Throws Error that lists the names there are.
[[noreturn]] void unknown_parameter(const std::string& name, std::span<const Parameter> known);
template <class Owner>
const ParameterField<Owner>& field_named(std::span<const ParameterField<Owner>> fields,
                                         const std::string& name) {
  for (const auto& field : fields) {
    if (field.parameter.name == name) return field;
  }
  unknown_parameter(name, descriptions(fields));
}

/// Throws Error with name, value and what would be right unless `allows`.
void check(const Parameter& parameter, const ParameterValue& value);

/// A table of the parameters in Markdown: name, meaning, range, default.
std::string markdown(std::span<const Parameter> parameters);

}  // namespace sateen::appearance
