// SPDX-License-Identifier: MIT
#include "sateen/matcap/signature_plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace sateen::matcap {
namespace {

constexpr double kPlotWidth = 640;
constexpr double kPlotHeight = 400;
constexpr double kPlotMargin = 60;
constexpr std::array<const char*, 4> kColours{"#1b6ca8", "#c1440e", "#2e7d32", "#6a1b9a"};

/// A logarithmic axis on the page.
struct Axis {
  double least;
  double most;
  double begin;
  double end;
  double operator()(double v) const {
    return begin + (end - begin) * std::log(v / least) / std::log(most / least);
  }
};

std::string ticks(const Axis& x, const Axis& y) {
  std::string svg;
  for (double decade = 1e-8; decade < 1e3; decade *= 10) {
    for (const double step : {1.0, 3.0}) {
      const double v = decade * step;
      if (v >= y.least && v <= y.most) {
        svg += fmt::format(
            "<path d=\"M{:.1f} {:.1f}H{:.1f}\" stroke=\"#ddd\"/><text x=\"{:.1f}\" y=\"{:.1f}\" "
            "text-anchor=\"end\">{:g}</text>\n",
            x.begin, y(v), x.end, x.begin - 6, y(v) + 4, v);
      }
    }
  }
  for (const double angle : {1.0, 2.0, 5.0, 10.0, 20.0, 45.0, 90.0}) {
    const double v = radians(angle);
    if (v < x.least || v > x.most * 1.0001) continue;
    svg += fmt::format(
        "<path d=\"M{:.1f} {:.1f}V{:.1f}\" stroke=\"#ddd\"/><text x=\"{:.1f}\" y=\"{:.1f}\" "
        "text-anchor=\"middle\">{:g}&#176;</text>\n",
        x(v), y.begin, y.end, x(v), y.begin + 18, angle);
  }
  return svg;
}

std::string curve(const LabelledEstimate& labelled, const Axis& x, const Axis& y, std::size_t number) {
  const Signature& s = labelled.estimate.signature;
  const char* colour = kColours[number % kColours.size()];
  std::string path;
  bool drawing = false;
  for (std::size_t i = 0; i < s.eps.size(); ++i) {
    const bool shown = std::isfinite(s.variance[i]) && s.variance[i] >= y.least && s.variance[i] <= y.most;
    if (shown) path += fmt::format("{}{:.1f} {:.1f}", drawing ? 'L' : 'M', x(s.eps[i]), y(s.variance[i]));
    drawing = shown;
  }
  std::string svg =
      fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n", path, colour);
  if (s.chosen) {
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\" fill=\"{}\"/>\n", x(s.eps[*s.chosen]),
                       y(s.variance[*s.chosen]), colour);
  }
  svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\">{}: {}</text>\n", x.begin + 10,
                     y.end + 18 + 18 * static_cast<double>(number), colour, labelled.label,
                     labelled.estimate.measured ? fmt::format("variance {:.4g}", labelled.estimate.variance)
                                                : std::string("nothing sharp enough to measure"));
  return svg;
}

}  // namespace

std::string signature_svg(std::span<const LabelledEstimate> curves) {
  double least = 1;
  double most = 1e-3;
  double smallest = 0.5;
  for (const LabelledEstimate& c : curves) {
    for (std::size_t i = 0; i < c.estimate.signature.eps.size(); ++i) {
      smallest = std::min(smallest, c.estimate.signature.eps[i]);
      const double v = c.estimate.signature.variance[i];
      if (!std::isfinite(v)) continue;
      least = std::min(least, v);
      most = std::max(most, v);
    }
  }
  const Axis x{smallest, kPi / 2, kPlotMargin, kPlotWidth - 20};
  const Axis y{std::max(least / 1.5, 1e-7), std::min(most * 1.5, 10.0), kPlotHeight - kPlotMargin, 20};
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      kPlotWidth, kPlotHeight);
  svg += ticks(x, y);
  for (std::size_t i = 0; i < curves.size(); ++i) svg += curve(curves[i], x, y, i);
  svg +=
      fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">half width of the window</text>\n",
                  (x.begin + x.end) / 2, kPlotHeight - 18);
  svg += fmt::format(
      "<text transform=\"translate(14 {:.1f}) rotate(-90)\" text-anchor=\"middle\">variance, "
      "radians&#178;</text>\n</svg>\n",
      (y.begin + y.end) / 2);
  return svg;
}

}  // namespace sateen::matcap
