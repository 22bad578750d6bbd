// SPDX-License-Identifier: MIT
#include "sateen/capture/report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "sateen/amc/sheet.h"
#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image_encode.h"

namespace sateen::capture {
namespace fs = std::filesystem;

namespace {

std::string base64(const std::vector<std::byte>& bytes) {
  static constexpr char kAlphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      group = group << 8 | (i + j < bytes.size() ? std::to_integer<unsigned>(bytes[i + j]) : 0u);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      text += i + j > bytes.size() ? '=' : kAlphabet[group >> (18 - 6 * j) & 63];
    }
  }
  return text;
}

std::string data_url(const Image& image) {
  return "data:image/png;base64," + base64(io::encode_png(image));
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '<') {
      result += "&lt;";
    } else if (c == '&') {
      result += "&amp;";
    } else {
      result += c;
    }
  }
  return result;
}

/// A small line chart over the frames, as SVG. Frames that are not used are left out.
std::string chart(const CaptureResult& result, const std::string& title, const std::string& unit,
                  const std::function<double(const CaptureFrame&)>& value) {
  double low = 1e300;
  double high = -1e300;
  for (const CaptureFrame& frame : result.frames) {
    if (!frame.used()) continue;
    low = std::min(low, value(frame));
    high = std::max(high, value(frame));
  }
  const double range = std::max(high - low, 1e-6);
  std::string points;
  std::string dropped;
  const double n = static_cast<double>(std::max<std::size_t>(2, result.frames.size()));
  for (std::size_t i = 0; i < result.frames.size(); ++i) {
    const double x = 64 + 376 * static_cast<double>(i) / (n - 1);
    if (!result.frames[i].used()) {
      dropped += fmt::format("<line x1='{0:.1f}' x2='{0:.1f}' y1='16' y2='104' class='drop'/>", x);
      continue;
    }
    points += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='1.4'/>", x,
                          100 - 80 * (value(result.frames[i]) - low) / range);
  }
  return fmt::format(
      "<figure><svg viewBox='0 0 450 120' role='img' aria-label='{0}'><rect x='64' y='16' width='376' "
      "height='88' "
      "class='frame'/>{1}{2}<text x='58' y='27' text-anchor='end'>{3:.4g}</text><text x='58' y='104' "
      "text-anchor='end'>{4:.4g}</text></svg><figcaption>{0} ({5}) over the frames</figcaption></figure>",
      title, dropped, points, high, low, unit);
}

/// How alike the material is after each turn, with the threshold from which it counts as the same.
std::string symmetry_chart(const amc::SymmetryReport& symmetry) {
  constexpr double kMost = 60;  // dB: alike for every purpose
  const auto across = [=](double psnr) { return 64 + 376 * std::clamp(psnr, 0.0, kMost) / kMost; };
  std::string bars;
  double y = 16;
  for (const amc::Similarity& s : symmetry.similarities) {
    if (s.turns < 2) continue;
    bars += fmt::format(
        "<rect x='64' y='{0:.0f}' width='{1:.1f}' height='20' class='{2}'/><text x='58' y='{3:.0f}' "
        "text-anchor='end'>R = {4}</text><text x='{5:.1f}' y='{3:.0f}' class='over'>{6:.1f}</text>",
        y, across(s.psnr) - 64, s.psnr >= symmetry.threshold ? "same" : "other", y + 15, s.turns,
        std::min(across(s.psnr) + 6, 400.0), s.psnr);
    y += 30;
  }
  const double limit = across(symmetry.threshold);
  return fmt::format(
      "<figure class='half'><svg viewBox='0 0 450 120' role='img' aria-label='Symmetry'><line x1='{1:.1f}' "
      "x2='{1:.1f}' "
      "y1='10' y2='106' class='limit'/>{0}</svg><figcaption>Alike after 1/R of a turn, dB; right of the line "
      "({2:.0f} dB) it counts as the same</figcaption></figure>",
      bars, limit, symmetry.threshold);
}

/// The preview frame with the sphere's outline, centre and axis drawn on it.
std::string framing(const CaptureResult& result, const std::string& picture) {
  const double scale = static_cast<double>(result.preview.width) / result.lens.camera.width;
  const CaptureFrame& frame = result.frames[static_cast<std::size_t>(result.preview_frame)];
  const Camera& camera = result.lens.camera;
  const SphereView sphere = sphere_at(camera, frame.centre, frame.radius);
  std::string outline;
  for (int i = 0; i < 180; ++i) {
    const Vec2 p = scale * sphere.outline_pixel(camera, radians(2 * i));
    outline += fmt::format("{:.1f},{:.1f} ", p.x(), p.y());
  }
  const Vec2 centre = scale * frame.centre;
  const Vec2 pole = scale * camera.project(sphere.centre + result.turn.axis);
  const double radius = scale * frame.radius;
  const Vec2 tangent(std::cos(frame.angle), -std::sin(frame.angle));
  const Vec2 from = pole - 0.45 * radius * tangent;
  const Vec2 to = pole + 0.45 * radius * tangent;
  return fmt::format(
      "<svg viewBox='0 0 {0} {1}' class='wide' role='img' aria-label='What was found'><image width='{0}' "
      "height='{1}' "
      "href='{2}'/><polygon points='{3}' class='outline'/><circle cx='{4:.1f}' cy='{5:.1f}' r='3' "
      "class='outline'/><path "
      "d='M{6:.1f} {7:.1f}m-9 0h18m-9 -9v18' class='axis'/><line x1='{8:.1f}' y1='{9:.1f}' x2='{10:.1f}' "
      "y2='{11:.1f}' "
      "class='tangent'/><circle cx='{10:.1f}' cy='{11:.1f}' r='4' class='tangent'/></svg>",
      result.preview.width, result.preview.height, picture, outline, centre.x(), centre.y(), pole.x(),
      pole.y(), from.x(), from.y(), to.x(), to.y());
}

/// The body seen along the axis in the first frame: grey, lighter or darker where it deviates, red where it
/// is masked.
Image mask_picture(const CaptureResult& result) {
  const SurfaceMask& mask = result.seams.mask;
  const int size = mask.size > 0 ? mask.size : result.table.amc.size;
  Image picture(size, size, 3, 0.02f);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      if (disc_of_pixel(x, y, size).norm() >= 1) continue;
      const auto i = pixel_index(x, y, size);
      const float deviation = mask.size > 0 ? mask.deviation[i] : 0;
      const float grey = std::clamp(0.25f * std::exp(deviation), 0.0f, 1.0f);
      const bool masked = mask.size > 0 && mask.masked[i] != 0;
      picture.set_rgb(x, y, masked ? Vec3f(0.7f, 0.05f, 0.03f) : Vec3f(grey, grey, grey));
    }
  }
  return resized(picture, 256, 256);
}

Image clipped_picture(const Image& clipped) {
  Image picture(clipped.width, clipped.height, 3, 0.02f);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (disc_of_pixel(x, y, picture.width).norm() >= 1) continue;
      const float share = std::sqrt(clipped.at(x, y, 0));
      picture.set_rgb(x, y, {0.1f + 0.9f * share, 0.1f + 0.5f * share, 0.1f});
    }
  }
  return resized(picture, 256, 256);
}

constexpr const char* kStyle = R"(
body{font:16px/1.45 system-ui,sans-serif;margin:0 auto;max-width:1000px;padding:1rem;color:#222;background:#fafafa}
h1{font-size:1.4rem}h2{font-size:1.1rem;margin-top:2rem}
.good,.look{padding:.7rem 1rem;border-radius:6px;font-weight:600}
.over{paint-order:stroke;stroke:#fafafa;stroke-width:4px}.half{max-width:30rem}
.good{background:#dcefdc}.look{background:#f7e3c0}
ul{padding-left:1.2rem}li{margin:.3rem 0}
svg,img{max-width:100%}.wide{width:100%;background:#000}
.outline{fill:none;stroke:#3f6;stroke-width:1.5}.axis{fill:none;stroke:#fc3;stroke-width:2}
.tangent{fill:#f4a;stroke:#f4a;stroke-width:2}
.same{fill:#7b7}.other{fill:#bbb}.limit{stroke:#c33;stroke-width:2}
.frame{fill:#fff;stroke:#bbb}.drop{stroke:#e77}circle{fill:#26c}text{font-size:14px;fill:#555}
.row{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,400px),1fr));gap:1rem}figure{margin:0}figcaption{font-size:.85rem;color:#555}
table{border-collapse:collapse}td,th{padding:.15rem .8rem .15rem 0;text-align:left;vertical-align:top}
)";

std::string facts(const CaptureResult& result) {
  const Camera& camera = result.lens.camera;
  const Mounting& mounting = result.mounting;
  const Turn& turn = result.turn;
  const amc::AmcTable& table = result.table.amc;
  const auto used = std::ranges::count_if(result.frames, &CaptureFrame::used);
  const Vec2 centre = mounting.sphere.centre_pixel(camera);
  std::string rows;
  const auto row = [&](const std::string& name, const std::string& value) {
    rows += "<tr><th>" + name + "</th><td>" + escaped(value) + "</td></tr>";
  };
  row("Frames", fmt::format("{} used of {}", used, result.frames.size()));
  row("Sphere",
      fmt::format("centre ({:.1f}, {:.1f}), radius {:.1f} pixels; it wobbles by {:.1f}, {:.2f} unexplained",
                  centre.x(), centre.y(), mounting.sphere.radius_pixel(camera), mounting.wobble,
                  mounting.wobble_rms));
  row("Turn",
      fmt::format("{:.1f} degrees {} from the first to the last frame, {}", std::abs(degrees(turn.turned)),
                  turn.turned >= 0 ? "counter-clockwise" : "clockwise",
                  turn.equal_steps ? "in equal steps" : "in unequal steps"));
  row("Tangent", words(result.first_angle));
  row("Lens", fmt::format("focal length {:.0f} pixels ({})", camera.focal.x(), words(result.lens.source)));
  row("Light", fmt::format("exposure drift {:.1f} %, clipped {:.1f} %", 100 * result.photometry.drift,
                           100 * result.clipping.share));
  row("Seams", fmt::format("{:.1f} % of the surface masked", 100 * result.seams.mask.share));
  std::string similar;
  for (const amc::Similarity& s : result.table.symmetry.similarities) {
    if (s.turns > 1)
      similar += fmt::format("{}R = {}: {:.1f} dB", similar.empty() ? "" : ", ", s.turns, s.psnr);
  }
  row("Symmetry",
      fmt::format("R = {}{} ({})", table.symmetry, table.isotropic ? ", isotropic" : "", similar));
  row("Table", fmt::format("{0} x {0} x {1}, {2:.1f} % measured, the rest filled", table.size, table.slices,
                           100 * result.table.seen_share));
  return "<table>" + rows + "</table>";
}

}  // namespace

void write_report(const fs::path& folder, const CaptureResult& result) {
  io::make_folder(folder);
  std::string warnings;
  for (const std::string& warning : result.warnings) warnings += "<li>" + escaped(warning) + ".</li>";
  const std::string verdict =
      result.warnings.empty()
          ? "<p class='good'>Nothing to complain about: this capture can be used.</p>"
          : fmt::format(
                "<p class='look'>Look at {} before you put the sphere away:</p><ul>{}</ul>",
                result.warnings.size() == 1 ? "one thing" : fmt::format("{} things", result.warnings.size()),
                warnings);
  std::string dropped;
  for (const CaptureFrame& frame : result.frames) {
    if (!frame.used()) dropped += fmt::format("<li>{}: {}</li>", escaped(frame.file), words(frame.dropped));
  }
  if (!dropped.empty()) dropped = "<h2>Frames left out</h2><ul>" + dropped + "</ul>";
  const auto picture = [&](const Image& image, const std::string& caption) {
    return fmt::format("<figure><img src='{}' alt='{}'><figcaption>{}</figcaption></figure>", data_url(image),
                       caption, caption);
  };
  const Vec2 middle = result.mounting.sphere.centre_pixel(result.lens.camera);
  const std::string html = fmt::format(
      "<!doctype html><html lang='en'><meta charset='utf-8'><meta name='viewport' "
      "content='width=device-width'>"
      "<title>Capture report</title><style>{}</style><h1>Capture report</h1>{}{}"
      "<h2>What was found</h2>{}<p><small>Green: the sphere's outline and centre. Yellow cross: where the "
      "turning axis leaves "
      "it. Pink: the tangent's direction in this frame.</small></p><h2>Slices</h2>{}<h2>Frame by frame</h2>"
      "<div class='row'>{}{}{}{}</div><h2>Symmetry</h2><div class='row'>{}</div><h2>Seams and highlights</h2>"
      "<div class='row'>{}{}</div>{}</html>\n",
      kStyle, verdict, facts(result), framing(result, data_url(result.preview)),
      picture(amc::contact_sheet(result.table.amc),
              "Slices at eight tangent angles, and two cuts along the angle"),
      chart(result, "Turned", "degrees", [](const CaptureFrame& f) { return degrees(f.turned); }),
      chart(result, "Exposure", "relative", [](const CaptureFrame& f) { return f.gain.y(); }),
      chart(result, "Centre across", "pixels",
            [&](const CaptureFrame& f) { return f.centre.x() - middle.x(); }),
      chart(result, "Sharpness", "relative", [](const CaptureFrame& f) { return f.sharpness; }),
      symmetry_chart(result.table.symmetry),
      picture(mask_picture(result), "The surface as it lies in the first frame; red: masked"),
      picture(clipped_picture(result.clipping.picture), "Bright: clipped in many frames"), dropped);
  io::write_texts(std::array{folder / kReportFiles[0], folder / kReportFiles[1]},
                  std::array{report_json(result), html});
}

}  // namespace sateen::capture
