// SPDX-License-Identifier: MIT
#include "sateen/matcap/contact_sheet.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "sateen/core/colour.h"
#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/core/parallel.h"
#include "sateen/io/file.h"
#include "sateen/io/folder_lock.h"
#include "sateen/io/image.h"
#include "sateen/matcap/bake.h"
#include "sateen/matcap/decomposition_file.h"

namespace sateen::matcap {
namespace {

namespace fs = std::filesystem;

constexpr int kPreviewSize = 128;
constexpr double kTurn = 50;  // degrees
constexpr const char* kTiles[] = {"MatCap",     "low",       "high",       "low front",   "low back",
                                  "high front", "high back", "light left", "light right", "light from above"};

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

/// A file name as part of a URL.
std::string url_of(const std::string& name) {
  std::string result;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '_' || c == '.';
    result += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return result;
}

Image on_black(Image image, const Disc& disc) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (!on_disc(disc, x, y)) image.set_rgb(x, y, Vec3f::Constant(0.01F));
    }
  }
  return image;
}

/// Tiles in the order of kTiles, side by side.
Image strip_of(MatcapDecomposition matcap) {
  matcap.width = matcap.height = kPreviewSize;
  matcap.disc = inscribed_disc(kPreviewSize, kPreviewSize);
  const Disc disc = matcap.disc;
  EditedMatcap edited = unedited(std::move(matcap));
  std::vector<Image> tiles{bake(edited)};
  for (const Part part : kParts) {
    EditedMatcap alone = edited;
    alone.look(part == Part::low ? Part::high : Part::low).intensity = 0;
    tiles.push_back(bake(alone));
  }
  for (Image& tile : tiles) tile = on_black(std::move(tile), disc);
  for (const Part part : kParts) {
    const SphereMap& map = edited.matcap[part].map.levels.front();
    for (const Image* side : {&map.front, &map.back}) {
      Image tile = resized(*side, kPreviewSize, kPreviewSize);
      if (edited.matcap.space == AddUpSpace::display) tile = srgb_decoded(std::move(tile));
      tiles.push_back(std::move(tile));
    }
  }
  for (const Vec3& degrees_about : {Vec3(0, -kTurn, 0), Vec3(0, kTurn, 0), Vec3(-kTurn, 0, 0)}) {
    edited.light = rotation_xyz(degrees_about * (kPi / 180));
    tiles.push_back(on_black(bake(edited), disc));
  }
  Image strip(kPreviewSize * static_cast<int>(tiles.size()), kPreviewSize, 3);
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    for (int y = 0; y < kPreviewSize; ++y) {
      for (int x = 0; x < kPreviewSize; ++x)
        strip.set_rgb(static_cast<int>(i) * kPreviewSize + x, y, tiles[i].rgb(x, y));
    }
  }
  return strip;
}

std::string describe(const MatcapPart& part, const char* name) {
  return fmt::format("{}: filter {:.1f}&deg; ({}), slope {:.3f}, base colour {:.2f} {:.2f} {:.2f}", name,
                     degrees(std::sqrt(part.variance)), part.measured ? "measured" : "assumed", part.slope(),
                     part.base_color.x(), part.base_color.y(), part.base_color.z());
}

/// Where the page's parts for one entry lie.
fs::path strip_path(const fs::path& folder, const BatchEntry& entry) {
  return folder / "sheet" / (entry.output.stem().string() + ".png");
}
fs::path failure_path(const fs::path& folder, const BatchEntry& entry) {
  return folder / "sheet" / (entry.output.stem().string() + ".txt");
}

/// The entry's strip, or why there is none, beside the page.
void write_parts(const fs::path& folder, const BatchEntry& entry) {
  const fs::path strip = strip_path(folder, entry);
  std::error_code code;
  if (!entry.failure.empty()) {
    io::write_text(failure_path(folder, entry), entry.failure);
    fs::remove(strip, code);
    return;
  }
  if (!fs::exists(strip, code) || fs::last_write_time(strip) < fs::last_write_time(entry.output)) {
    io::write_image(strip, strip_of(read_matcap(entry.output)));
  }
  fs::remove(failure_path(folder, entry), code);
}

/// From what lies in the folder, so that the page is the same whichever process writes it last.
std::string row_of(const fs::path& folder, const BatchEntry& entry) {
  const std::string name = entry.output.stem().string();
  const auto without_strip = [&](const std::string& why) {
    return fmt::format("<section class=\"failed\"><h2>{}</h2><p>{}</p></section>\n", escaped(name),
                       escaped(why));
  };
  std::error_code code;
  if (fs::exists(failure_path(folder, entry), code)) {
    return without_strip(io::read_text(failure_path(folder, entry)));
  }
  if (!fs::exists(strip_path(folder, entry), code)) return without_strip("not made yet");
  const MatcapDecomposition matcap = read_matcap_parameters(entry.output);
  return fmt::format(
      "<section><h2>{}</h2><img loading=\"lazy\" src=\"sheet/{}\" width=\"{}\" height=\"{}\" alt=\"{}\">"
      "<p>{}<br>{}</p></section>\n",
      escaped(name), url_of(name + ".png"), kPreviewSize * static_cast<int>(std::size(kTiles)), kPreviewSize,
      escaped(name + ": MatCap, parts, maps, turned lights"), describe(matcap[Part::low], "low"),
      describe(matcap[Part::high], "high"));
}

}  // namespace

void write_contact_sheet(const fs::path& folder, std::span<const BatchEntry> entries,
                         const Progress& progress) {
  io::make_folder(folder / "sheet");
  std::vector<std::string> failures(entries.size());
  std::atomic<int> done = 0;
  const int count = static_cast<int>(entries.size());
  parallel_for(count, [&](int i) {
    const BatchEntry& entry = entries[static_cast<std::size_t>(i)];
    if (!entry.elsewhere) {
      failures[static_cast<std::size_t>(i)] =
          failure_of(entry.output.string(), [&] { write_parts(folder, entry); });
    }
    report(progress, static_cast<double>(++done) / count);
  });
  const io::FolderLock lock(folder);
  std::string html =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Decomposed "
      "MatCaps</title>\n<style>"
      "body{background:#1b1b1b;color:#ddd;font:14px sans-serif;margin:1em}h2{font-size:1em;margin:1.2em 0 "
      ".3em}"
      "p{margin:.3em "
      "0;color:#aaa}.failed{color:#f88}header{display:flex;position:sticky;top:0;background:#1b1b1b}"
      "header span{width:128px}img{display:block;max-width:none}</style></head><body>\n<header>";
  for (const char* tile : kTiles) html += fmt::format("<span>{}</span>", tile);
  html += "</header>\n";
  for (const BatchEntry& entry : entries) html += row_of(folder, entry);
  io::write_text(folder / "index.html", html + "</body></html>\n");
  const auto failed = std::ranges::find_if_not(failures, &std::string::empty);
  if (failed != failures.end()) throw Error(*failed);
}

}  // namespace sateen::matcap
