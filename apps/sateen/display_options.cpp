// SPDX-License-Identifier: MIT
#include "display_options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "command.h"
#include "sateen/io/file.h"
#include "sateen/io/video.h"

namespace sateen::cli {
namespace {

constexpr double kMostStops = 32;

constexpr std::array<std::pair<const char*, ViewTransform>, 4> kViews{{{"none", ViewTransform::none},
                                                                       {"srgb", ViewTransform::srgb},
                                                                       {"neutral", ViewTransform::neutral},
                                                                       {"agx", ViewTransform::agx}}};

/// Nothing when that is not what the text is.
std::optional<double> read_stops(const std::string& text) {
  const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
  double stops = 0;
  const auto [end, code] = std::from_chars(first, text.data() + text.size(), stops);
  const bool whole = code == std::errc{} && end == text.data() + text.size();
  return whole && std::abs(stops) <= kMostStops ? std::optional(stops) : std::nullopt;
}

/// What is wrong with the text of --exposure, for CLI11.
std::string exposure_fault(const std::string& text) {
  if (text == "auto" || read_stops(text)) return "";
  return fmt::format("\"{}\" is not understood; write auto, or stops from {} to {}, such as 1.5", text,
                     -kMostStops, kMostStops);
}

/// Nothing: automatic.
std::optional<double> exposure(const std::string& text, bool lit) {
  if (text == "auto" || (text.empty() && lit)) return std::nullopt;
  return text.empty() ? 0.0 : read_stops(text);
}

ViewTransform view(const std::string& name) {
  const auto found = std::ranges::find_if(kViews, [&](const auto& entry) { return entry.first == name; });
  return found == kViews.end() ? ViewTransform::srgb : found->second;
}

bool holds_scene_light(const std::filesystem::path& output) {
  const std::string extension = io::extension_of(output);
  return extension == ".exr" || extension == ".hdr";
}

}  // namespace

void add_display_options(CLI::App& command, DisplayArguments& arguments) {
  command
      .add_option("--exposure", arguments.exposure,
                  "Stops: light times 2^EV; or auto, which is the default where all materials are lit by "
                  "lamps or surroundings (others: 0). Not for .exr and .hdr, which hold the scene's light")
      ->check(exposure_fault);
  command
      .add_option("--view", arguments.view,
                  "How light becomes what a screen shows: srgb (clipped at white; the default), neutral "
                  "(Khronos PBR Neutral), agx, or none (linear values, without the sRGB curve)")
      ->check(CLI::IsMember({"none", "srgb", "neutral", "agx"}));
}

std::optional<DisplaySettings> display_settings(const DisplayArguments& arguments,
                                                const std::filesystem::path& output, bool lit,
                                                const std::function<double()>& meter) {
  const std::optional<double> asked = exposure(arguments.exposure, lit);
  if (holds_scene_light(output)) {
    if (!arguments.exposure.empty() || !arguments.view.empty()) {
      warn(
          fmt::format("{} holds the scene's light: --exposure and --view do not change it", output.string()));
    }
    return std::nullopt;
  }
  DisplaySettings settings{.exposure = asked.value_or(0), .view = view(arguments.view)};
  if (!lit && asked == 0.0 && settings.view == ViewTransform::srgb) return std::nullopt;
  if (!asked) {
    settings.exposure = std::clamp(meter(), -kMostStops, kMostStops);
    say(fmt::format("exposure {:+.2f} stops, metered (--exposure {:.2f} repeats it)", settings.exposure,
                    settings.exposure));
  }
  return settings;
}

std::optional<Vec3f> background_for(const std::filesystem::path& output, std::optional<Vec3f> asked) {
  const std::string extension = io::extension_of(output);
  const bool opaque =
      extension == ".jpg" || extension == ".jpeg" || extension == ".hdr" || io::is_video_path(output);
  if (asked || !opaque) return asked;
  say(fmt::format("{} cannot be transparent: the background is white", output.string()));
  return Vec3f::Ones();
}

}  // namespace sateen::cli
