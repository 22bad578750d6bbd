// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/json.h"
#include "sateen/matcap/edits.h"

namespace sateen::matcap {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One edit's object; each key that is read is crossed off, and what is left at the end is unknown.
class Keys {
 public:
  Keys(const json& object, fs::path folder, std::string where)
      : object_(object), folder_(std::move(folder)), where_(std::move(where)) {
    if (!object.is_object()) fail("is no object {\"edit\": ...}");
    for (const auto& [key, value] : object.items()) left_.insert(key);
  }

  [[noreturn]] void fail(const std::string& what) const { throw Error(where_ + ": " + what); }

  bool has(const std::string& key) const { return object_.contains(key); }

  double number(const std::string& key, double standard, double least = -kInfinity, double most = kInfinity) {
    left_.erase(key);
    if (!has(key)) return standard;
    return checked(object_[key], key, least, most);
  }

  template <int N>
  Eigen::Matrix<double, N, 1> vector(const std::string& key, const Eigen::Matrix<double, N, 1>& standard,
                                     double least = -kInfinity, double most = kInfinity) {
    left_.erase(key);
    if (!has(key)) return standard;
    const json& value = object_[key];
    if (!value.is_array() || value.size() != N)
      fail(fmt::format("\"{}\" must be a list of {} numbers", key, N));
    Eigen::Matrix<double, N, 1> result;
    for (int i = 0; i < N; ++i) result[i] = checked(value[static_cast<std::size_t>(i)], key, least, most);
    return result;
  }

  std::string text(const std::string& key) {
    left_.erase(key);
    if (!has(key) || !object_[key].is_string()) fail(fmt::format("\"{}\" is needed, as text", key));
    return object_[key];
  }

  fs::path file(const std::string& key) {
    const fs::path path = text(key);
    return path.is_absolute() ? path : folder_ / path;
  }

  Part part() {
    const std::string name = text("part");
    if (name != "low" && name != "high")
      fail(fmt::format("\"part\" is \"{}\"; it must be low or high", name));
    return name == "low" ? Part::low : Part::high;
  }

  Vec2 disc_point(const std::string& key) {
    if (!has(key)) fail(fmt::format("\"{}\" is needed, the [x, y] of a normal", key));
    const Vec2 point = vector<2>(key, Vec2::Zero(), -1, 1);
    if (point.norm() > 1) fail(fmt::format("\"{}\" lies off the sphere; x^2 + y^2 must not exceed 1", key));
    return point;
  }

  double angle(const std::string& key, double standard_degrees, double least = -kInfinity,
               double most = kInfinity) {
    return radians(number(key, standard_degrees, least, most));
  }

  void finish() const {
    if (!left_.empty()) fail(fmt::format("the key \"{}\" is unknown", *left_.begin()));
  }

 private:
  double checked(const json& value, const std::string& key, double least, double most) const {
    if (!value.is_number()) fail(fmt::format("\"{}\" must be a number", key));
    const double number = value;
    if (!std::isfinite(number) || number < least || number > most) {
      fail(fmt::format("\"{}\" is {}; it must be within {} and {}", key, number, least, most));
    }
    return number;
  }

  const json& object_;
  fs::path folder_;
  std::string where_;
  std::set<std::string> left_;
};

Vec3 light_color(Keys& keys) {
  const Vec3 color = keys.vector<3>("color", Vec3::Ones(), 0, 1000);
  return keys.number("intensity", 1, 0, 1000) * color;
}

Edit parse_paint(Keys& keys) {
  Paint paint;
  paint.part = keys.part();
  paint.at = keys.disc_point("at");
  paint.turn = keys.angle("turn", 0);
  paint.footprint.softness = keys.angle("softness", 0, 0, 90);
  const std::string shape = keys.has("shape") ? keys.text("shape") : "gaussian";
  if (shape == "gaussian") {
    paint.footprint.size = Vec2::Constant(keys.angle("size", 5, 0.01, 90));
  } else if (shape == "box") {
    paint.footprint.shape = Footprint::Shape::box;
    paint.footprint.size =
        keys.vector<2>("size", Vec2(10, 10), 0.01, 180) * (kPi / 360);  // full size in degrees to half
  } else {
    keys.fail(fmt::format("\"shape\" is \"{}\"; it must be gaussian or box", shape));
  }
  paint.color = light_color(keys);
  return paint;
}

Edit parse_bitmap(Keys& keys) {
  Bitmap bitmap;
  bitmap.part = keys.part();
  bitmap.file = keys.file("file");
  bitmap.at = keys.disc_point("at");
  bitmap.turn = keys.angle("turn", 0);
  bitmap.width = keys.angle("size", 30, 0.1, 180);
  bitmap.color = light_color(keys);
  return bitmap;
}

Edit parse_roughness(Keys& keys) {
  const Part part = keys.part();
  if (keys.has("add") == keys.has("degrees")) {
    keys.fail(
        "needs either \"add\", a variance in radians^2, or \"degrees\", the filter's new standard deviation");
  }
  if (keys.has("add")) return Roughness{part, false, keys.number("add", 0, -kFlattest, kFlattest)};
  const double deviation = keys.angle("degrees", 0, 0.2, 52);
  return Roughness{part, true, deviation * deviation};
}

Edit parse_edit(Keys& keys) {
  const std::string kind = keys.text("edit");
  if (kind == "turn") return Turn{keys.vector<3>("degrees", Vec3::Zero()) * (kPi / 180)};
  if (kind == "align") return Align{keys.disc_point("to")};
  if (kind == "paint") return parse_paint(keys);
  if (kind == "bitmap") return parse_bitmap(keys);
  if (kind == "roughness") return parse_roughness(keys);
  if (kind == "color") {
    return Recolor{keys.part(), keys.number("hue", 0) / 360, keys.number("saturation", 1, 0, 100),
                   keys.number("value", 1, 0, 100)};
  }
  if (kind == "intensity") return Intensity{keys.part(), keys.number("factor", 1, 0, 1000)};
  if (kind == "silhouette") {
    return SetSilhouette{keys.part(),
                         {keys.angle("theta0", 45, 0, 89), keys.number("m1", 0, -100, 100),
                          keys.number("alpha1", 1, -100, 100)}};
  }
  if (kind == "mix") return Mix{keys.part(), keys.file("from")};
  keys.fail(
      fmt::format("\"{}\" is unknown; known are turn, align, paint, bitmap, roughness, color, intensity, "
                  "silhouette and mix",
                  kind));
}

}  // namespace

std::vector<Edit> parse_edits(const std::string& text, const fs::path& folder, const std::string& name) {
  const json list = io::parse_json(text, name);
  if (!list.is_array())
    throw Error(name + ": is no list of edits; [{\"edit\": \"turn\", ...}, ...] is needed");
  std::vector<Edit> edits;
  for (std::size_t i = 0; i < list.size(); ++i) {
    Keys keys(list[i], folder, fmt::format("{}: edit {}", name, i + 1));
    edits.push_back(parse_edit(keys));
    keys.finish();
  }
  return edits;
}

std::vector<Edit> read_edits(const fs::path& path) {
  return parse_edits(io::read_text(path), path.parent_path(), path.string());
}

}  // namespace sateen::matcap
