// SPDX-License-Identifier: MIT
#include "sateen/brdf/plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "sateen/brdf/quadrature.h"
#include "sateen/core/colour.h"
#include "sateen/core/parallel.h"

namespace sateen::brdf {

namespace {

constexpr double kPanel = 300;
constexpr double kGap = 40;
constexpr double kTop = 60;
constexpr std::array<const char*, 6> kColours = {"#1b6ca8", "#d1495b", "#2e8b57",
                                                 "#8a5fb4", "#c77d0a", "#555555"};

/// A direction in the plane of the tangent (0) or bitangent (1); positive angles lean towards that axis.
Vec3 in_plane(int plane, double angle) {
  return plane == 0 ? Vec3(std::sin(angle), 0, std::cos(angle)) : Vec3(0, std::sin(angle), std::cos(angle));
}

struct Curve {
  std::vector<double> angles;
  std::vector<double> values;
};

struct Lobes {
  std::string title;
  std::vector<Curve> curves;
};

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else {
      result += c;
    }
  }
  return result;
}

std::string label(double x, double y, const std::string& text, const char* anchor = "middle",
                  const char* colour = "#222") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" fill=\"{}\">{}</text>\n", x, y,
                     anchor, colour, escaped(text));
}

std::string line(double x0, double y0, double x1, double y1, const char* style) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x0, y0, x1, y1,
                     style);
}

std::string path(const std::vector<Vec2>& points, const char* colour, const char* dash = "") {
  std::string text = "<path d=\"";
  for (std::size_t i = 0; i < points.size(); ++i) {
    text += fmt::format("{}{:.2f} {:.2f}", i == 0 ? "M" : "L", points[i].x(), points[i].y());
  }
  return text + fmt::format("\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\" {}/>\n", colour, dash);
}

constexpr const char* kFaint = "stroke=\"#ccc\"";
constexpr const char* kAxis = "stroke=\"#444\"";

double largest_value(const std::vector<Lobes>& panels) {
  double largest = 1e-12;
  for (const Lobes& lobes : panels) {
    for (const Curve& curve : lobes.curves) {
      for (const double value : curve.values) largest = std::max(largest, value);
    }
  }
  return largest;
}

/// Half-circle rings at a third, two thirds and the whole of `scale`, and the curves.
std::string draw_lobes(const Lobes& lobes, double left, double scale, const PlotSettings& settings) {
  const double x = left + kPanel / 2;
  const double y = kTop + kPanel * 0.62;
  const double radius = kPanel / 2;
  std::string text = label(x, kTop - 8, lobes.title);
  for (int ring = 1; ring <= 3; ++ring) {
    const double r = radius * ring / 3;
    text += fmt::format("<path d=\"M{:.1f} {:.1f}A{:.1f} {:.1f} 0 0 1 {:.1f} {:.1f}\" fill=\"none\" {}/>\n",
                        x - r, y, r, r, x + r, y, kFaint);
    text += label(x + r, y + 16, fmt::format("{:.3g}", scale * ring / 3));
  }
  text += line(x - radius, y, x + radius, y, kAxis);
  text += line(x, y, x, y - radius, kFaint);
  for (std::size_t i = 0; i < lobes.curves.size(); ++i) {
    const char* colour = kColours[i % kColours.size()];
    std::vector<Vec2> points;
    const Curve& curve = lobes.curves[i];
    for (std::size_t j = 0; j < curve.angles.size(); ++j) {
      const double r = radius * curve.values[j] / scale;
      points.emplace_back(x + r * std::sin(curve.angles[j]), y - r * std::cos(curve.angles[j]));
    }
    text += path(points, colour);
    if (settings.view_independent) continue;
    // The light, as a tick on the rim.
    const double angle = settings.light_angles[i];
    text += line(x + radius * std::sin(angle), y - radius * std::cos(angle),
                 x + 0.94 * radius * std::sin(angle), y - 0.94 * radius * std::cos(angle),
                 fmt::format("stroke=\"{}\" stroke-width=\"3\"", colour).c_str());
    text += label(left + 10, y + 40 + 18 * static_cast<double>(i),
                  fmt::format("light at {:.0f} degrees", degrees(angle)), "start", colour);
  }
  return text;
}

/// Value against angle, -90 to 90 degrees, in both planes.
std::string draw_angles(const std::array<Curve, 2>& curves, double left, const std::string& title,
                        double top_value) {
  const double bottom = kTop + kPanel * 0.62;
  const double height = kPanel / 2;
  std::string text = label(left + kPanel / 2, kTop - 8, title);
  for (int i = 0; i <= 4; ++i) {
    const double y = bottom - height * i / 4;
    text += line(left, y, left + kPanel, y, i == 0 ? kAxis : kFaint);
    text += label(left - 6, y + 4, fmt::format("{:.3g}", top_value * i / 4), "end");
  }
  for (const int angle : {-90, -45, 0, 45, 90}) {
    text += label(left + kPanel * (angle + 90) / 180, bottom + 16, fmt::format("{}", angle));
  }
  const std::array<const char*, 2> names = {"along the tangent", "along the bitangent"};
  for (std::size_t i = 0; i < 2; ++i) {
    std::vector<Vec2> points;
    for (std::size_t j = 0; j < curves[i].angles.size(); ++j) {
      points.emplace_back(left + kPanel * (curves[i].angles[j] / kPi + 0.5),
                          bottom - height * curves[i].values[j] / top_value);
    }
    text += path(points, kColours[i], i == 1 ? "stroke-dasharray=\"6 3\"" : "");
    text += label(left + 10, bottom + 40 + 18 * static_cast<double>(i), names[i], "start", kColours[i]);
  }
  return text;
}

}  // namespace

double directional_albedo(const BrdfFunction& brdf, const Vec3& light) {
  if (light.z() <= 0) return 0;
  // Nodes gather about the mirror direction and its neighbourhood, where sharp lobes are.
  const Vec3 mirror(-light.x(), -light.y(), light.z());
  constexpr std::array<double, 4> cones = {0.03, 0.12, 0.4, 1.0};
  double sum = 0;
  for (const SphereNode& node : hemisphere_nodes(mirror, cones, 28)) {
    sum += node.weight * std::max(0.0, node.direction.z()) * luminance(brdf({light, node.direction}));
  }
  return sum;
}

std::string brdf_plot(const BrdfFunction& brdf, const PlotSettings& settings) {
  constexpr int kSteps = 361;
  constexpr int kAlbedoSteps = 45;
  const auto angle_of = [](int i, int steps) { return kPi * ((i + 0.5) / steps - 0.5); };

  std::vector<Lobes> panels(2);
  std::array<Curve, 2> albedo;
  for (int plane = 0; plane < 2; ++plane) {
    Lobes& lobes = panels[static_cast<std::size_t>(plane)];
    lobes.title = fmt::format("{} in the plane of the {}", settings.view_independent ? "lights" : "views",
                              plane == 0 ? "tangent" : "bitangent");
    const std::vector<double> lights =
        settings.view_independent ? std::vector<double>{0} : settings.light_angles;
    for (const double light : lights) {
      Curve curve;
      for (int i = 0; i < kSteps; ++i) {
        const double angle = angle_of(i, kSteps);
        const Vec3 moving = in_plane(plane, angle);
        const DirectionPair pair = settings.view_independent ? DirectionPair{moving, Vec3::UnitZ()}
                                                             : DirectionPair{in_plane(plane, light), moving};
        curve.angles.push_back(angle);
        curve.values.push_back(luminance(brdf(pair)) * (settings.with_cosine ? moving.z() : 1));
      }
      lobes.curves.push_back(std::move(curve));
    }
    Curve& curve = albedo[static_cast<std::size_t>(plane)];
    curve.angles.resize(kAlbedoSteps);
    curve.values.resize(kAlbedoSteps);
    parallel_for(kAlbedoSteps, [&](int i) {
      const Vec3 light = in_plane(plane, angle_of(i, kAlbedoSteps));
      const auto at = static_cast<std::size_t>(i);
      curve.angles[at] = angle_of(i, kAlbedoSteps);
      curve.values[at] = settings.view_independent ? luminance(brdf({light, Vec3::UnitZ()}))
                                                   : directional_albedo(brdf, light);
    });
  }

  const double width = 3 * kPanel + 4 * kGap;
  const double bottom = kTop + kPanel * 0.62 + 40 +
                        18.0 * static_cast<double>(std::max<std::size_t>(2, settings.light_angles.size()));
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      width, bottom);
  text += fmt::format("<g font-size=\"15\">{}</g>\n", label(width / 2, 24, settings.title));
  const double scale = largest_value(panels);
  text += draw_lobes(panels[0], kGap, scale, settings);
  text += draw_lobes(panels[1], 2 * kGap + kPanel, scale, settings);
  double top_value = 1e-12;
  for (const Curve& curve : albedo) {
    for (const double value : curve.values) top_value = std::max(top_value, value);
  }
  text += draw_angles(albedo, 3 * kGap + 2 * kPanel,
                      settings.view_independent ? "value against the light's angle, degrees"
                                                : "albedo against the light's angle, degrees",
                      std::min(top_value * 1.05, std::max(1.0, top_value)));
  return text + "</svg>\n";
}

}  // namespace sateen::brdf
