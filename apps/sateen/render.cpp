// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "command.h"
#include "commands.h"
#include "display_options.h"
#include "parse.h"
#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/gpu/context.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "sateen/io/video.h"
#include "sateen/render/metering.h"
#include "sateen/render/renderer.h"
#include "sateen/scene/surface_images.h"
#include "scene_options.h"

namespace sateen::cli {
namespace {

namespace fs = std::filesystem;

struct RenderArguments {
  SceneArguments scene;
  DisplayArguments display;
  fs::path output;
  std::string size = "1024x1024";
  int samples = 3;
  std::string background = "transparent";
  std::string camera = "perspective";
  double fov = 35;
  std::string rotate = "0,0,0";
  int turntable = 0;
  double frames_per_second = 25;
  std::vector<std::string> aovs;
  std::string compare;
};

scene::Camera camera(const RenderArguments& arguments) {
  scene::Camera result;
  if (arguments.camera == "orthographic") result.kind = scene::Camera::Kind::orthographic;
  if (arguments.camera == "view-space") result.kind = scene::Camera::Kind::view_space;
  result.field_of_view = radians(arguments.fov);
  return result;
}

render::PictureSettings picture_settings(const RenderArguments& arguments) {
  render::PictureSettings settings;
  std::tie(settings.width, settings.height) = parse_size("--size", arguments.size);
  settings.samples = arguments.samples;
  settings.background =
      background_for(arguments.output, parse_background("--background", arguments.background));
  settings.surfaces = !arguments.aovs.empty();
  if (arguments.camera == "view-space" && settings.width != settings.height) {
    throw CLI::ValidationError("--size",
                               "--camera view-space fills a square picture; give as much width as height");
  }
  return settings;
}

/// One rotation for a still, one for each picture of a turntable: the object turns about the view's vertical.
std::vector<Mat3> rotations(const RenderArguments& arguments) {
  const Mat3 still = rotation_xyz(parse_vector("--rotate", arguments.rotate) * (kPi / 180));
  std::vector<Mat3> result;
  for (int i = 0; i < std::max(1, arguments.turntable); ++i) {
    result.push_back(rotation_xyz({0, 2 * kPi * i / std::max(1, arguments.turntable), 0}) * still);
  }
  return result;
}

/// out/turn.png becomes out/turn_0007.png; out/turn, a folder, holds 0007.png.
fs::path numbered(const fs::path& output, int index) {
  if (!output.has_extension()) return output / fmt::format("{:04}.png", index);
  fs::path path = output;
  return path.replace_filename(
      fmt::format("{}_{:04}{}", output.stem().string(), index, output.extension().string()));
}

/// The name of the first picture, or of the film.
fs::path first_picture(const RenderArguments& arguments) {
  const bool many = arguments.turntable > 0 && !io::is_video_path(arguments.output);
  return many ? numbered(arguments.output, 0) : arguments.output;
}

void write_aovs(const render::Picture& frame, const fs::path& picture,
                const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    fs::path path = picture;
    io::write_data(path.replace_extension("." + name + ".exr"), scene::aov(*frame.surfaces, name));
  }
}

/// A scene ready to be drawn, and how.
struct Drawing {
  render::Renderer renderer;
  bool lit;
  render::PictureSettings settings;
};

Drawing drawing(const RenderArguments& arguments, const scene::Scene& scene, const scene::View& first_view,
                const render::PictureSettings& settings) {
  Drawing result{render::Renderer(scene), scene.lit(), settings};
  result.settings.display = display_settings(arguments.display, first_picture(arguments), result.lit, [&] {
    return render::metered_exposure(result.renderer, first_view, settings);
  });
  return result;
}

/// The same scene in the material to compare with, if there is one; under one exposure where both are lit.
std::optional<Drawing> other_drawing(const RenderArguments& arguments, const Drawing& drawn,
                                     const scene::View& first_view, const render::PictureSettings& settings) {
  if (arguments.compare.empty()) return std::nullopt;
  SceneArguments other = arguments.scene;
  other.materials = {arguments.compare};
  const scene::Scene scene = load(other);
  if (scene.lit() != drawn.lit) return drawing(arguments, scene, first_view, settings);
  return Drawing{render::Renderer(scene), drawn.lit, drawn.settings};
}

/// Two pictures of the same size in one.
Image beside(const Image& left, const Image& right) {
  Image both(2 * left.width, left.height, left.channels);
  for (int y = 0; y < left.height; ++y) {
    for (int x = 0; x < left.width; ++x) {
      for (int c = 0; c < left.channels; ++c) {
        both.at(x, y, c) = left.at(x, y, c);
        both.at(left.width + x, y, c) = right.at(x, y, c);
      }
    }
  }
  return both;
}

void check_aovs(const RenderArguments& arguments) {
  for (const std::string& name : arguments.aovs) {
    if (std::ranges::count(scene::aov_names(), name) == 0) {
      throw CLI::ValidationError("--aov", fmt::format("\"{}\" is not known; known are {}", name,
                                                      fmt::join(scene::aov_names(), ", ")));
    }
  }
  if (!arguments.aovs.empty() && io::is_video_path(arguments.output)) {
    throw CLI::ValidationError("--aov", "output variables go beside pictures, not beside a film");
  }
}

/// Throws Error unless every picture could be written.
void check_render_outputs(const RenderArguments& arguments, int count) {
  check_outputs({arguments.output});
  if (io::is_video_path(arguments.output) ||
      !fs::exists(fs::absolute(first_picture(arguments)).parent_path()))
    return;
  for (int i = 0; i < count; ++i) {
    io::check_image_writable(arguments.turntable > 0 ? numbered(arguments.output, i) : arguments.output);
  }
}

void run(const RenderArguments& arguments) {
  const render::PictureSettings settings = picture_settings(arguments);
  const std::vector<Mat3> poses = rotations(arguments);
  check_aovs(arguments);
  const bool film = io::is_video_path(arguments.output);
  if (film && arguments.turntable == 0) {
    throw CLI::ValidationError("--output", "a film needs --turntable N, its number of pictures");
  }
  check_render_outputs(arguments, static_cast<int>(poses.size()));
  const scene::Scene scene = load(arguments.scene);
  const auto views = scene::frame_object(scene.mesh, camera(arguments), poses,
                                         static_cast<double>(settings.width) / settings.height);
  const gpu::Context context;
  const Drawing drawn = drawing(arguments, scene, views.front(), settings);
  const std::optional<Drawing> other = other_drawing(arguments, drawn, views.front(), settings);
  const int count = static_cast<int>(views.size());
  const Progress progress = progress_bar("Drawing");
  const auto draw = [&](int i) {
    const scene::View& view = views[static_cast<std::size_t>(i)];
    render::Picture frame = drawn.renderer.render(
        view, drawn.settings, [&, i](double fraction) { report(progress, (i + fraction) / count); });
    if (other) frame.colour = beside(frame.colour, other->renderer.render(view, other->settings).colour);
    return frame;
  };
  if (film) {
    io::write_video(arguments.output, count, arguments.frames_per_second,
                    [&](int i) { return draw(i).colour; });
    return;
  }
  if (arguments.turntable > 0 && !arguments.output.has_extension()) io::make_folder(arguments.output);
  for (int i = 0; i < count; ++i) {
    const fs::path path = arguments.turntable > 0 ? numbered(arguments.output, i) : arguments.output;
    const render::Picture frame = draw(i);
    io::write_image(path, frame.colour);
    write_aovs(frame, path, arguments.aovs);
  }
}

}  // namespace

void add_render(CLI::App& parent) {
  auto arguments = std::make_shared<RenderArguments>();
  CLI::App* command = add_command(
      parent, "render", "Draw a mesh with a material, without a screen",
      "sateen render examples/garment/jacket.obj --material silk.ktx2 --rotate 0,25,0 -o jacket.png");
  add_scene_options(*command, arguments->scene);
  add_display_options(*command, arguments->display);
  command
      ->add_option("-o,--output", arguments->output,
                   "The picture: .png, .exr, .jpg, .tif or .hdr; with --turntable a name to be numbered, a "
                   "folder, or a film "
                   "(.mp4)")
      ->required();
  command->add_option("--size", arguments->size, "Width x height in pixels");
  command->add_option("--compare", arguments->compare,
                      "Another material: the same is drawn in it, to the right in the same picture");
  command
      ->add_option("--samples", arguments->samples,
                   "N x N samples in each pixel, averaged in linear light after exposure and view")
      ->check(CLI::Range(1, 16));
  command->add_option(
      "--background", arguments->background,
      "transparent (white in .jpg, .hdr and films), R,G,B in linear light, or #rrggbb in sRGB; "
      "shown as it is, whatever the exposure and view");
  command
      ->add_option("--camera", arguments->camera,
                   "The object is framed, unless view-space: its x, y in [-1, 1] then fill a square picture")
      ->check(CLI::IsMember({"perspective", "orthographic", "view-space"}));
  command->add_option("--fov", arguments->fov, "Vertical angle of view of the perspective camera, degrees")
      ->check(CLI::Range(1.0, 150.0));
  command->add_option("--rotate", arguments->rotate,
                      "Turns the object about x, then y, then z, degrees; light and camera stay");
  command->add_option("--turntable", arguments->turntable, "N pictures of a full turn")
      ->check(CLI::Range(1, 100000));
  command->add_option("--fps", arguments->frames_per_second, "Pictures a second of a film")
      ->check(CLI::Range(1.0, 240.0));
  command
      ->add_option("--aov", arguments->aovs,
                   "Output variables, written as float EXR beside the picture: " +
                       fmt::format("{}", fmt::join(scene::aov_names(), ",")))
      ->delimiter(',');
  command->callback([arguments] { run(*arguments); });
}

}  // namespace sateen::cli
