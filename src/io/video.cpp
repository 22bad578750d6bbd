// SPDX-License-Identifier: MIT
#include "sateen/io/video.h"

#include <algorithm>

#include <fmt/format.h>

#include "sateen/core/colour.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/film_formats.h"
#include "sateen/io/module.h"
#include "sateen/io/picture_sink.h"

namespace sateen::io {
namespace {

namespace fs = std::filesystem;

Picture8 frame_of(const Image& linear) {
  const Image encoded = srgb_encoded(with_channels(linear, 3));
  Picture8 frame{encoded.width, encoded.height, std::vector<std::uint8_t>(encoded.data.size())};
  std::ranges::transform(encoded.data, frame.rgb.begin(),
                         [](float v) { return static_cast<std::uint8_t>(quantised(v, 255)); });
  return frame;
}

}  // namespace

bool is_video_path(const fs::path& path) {
  const std::string extension = extension_of(path);
  return std::ranges::any_of(film_formats(), [&](const FilmFormat& format) {
    return format.written && format.extension == extension;
  });
}

void write_video(const fs::path& path, int count, double frames_per_second,
                 const std::function<Image(int)>& picture) {
  if (!is_video_path(path))
    throw Error(fmt::format("{}: films are written as .mp4, .mov or .avi", path.string()));
  const VideoModule& module = video_module(path.string() + ": writing a film");
  write_atomically(path, [&](const fs::path& temporary) {
    FilmSettings settings{temporary.string(), path.string(), extension_of(path).substr(1), 0, 0,
                          frames_per_second};
    std::unique_ptr<FrameSink> film;
    for (int i = 0; i < count; ++i) {
      const Image image = picture(i);
      if (i == 0) {
        if (image.width % 2 != 0 || image.height % 2 != 0) {
          throw Error(fmt::format("{}: a film needs an even width and height, not {} x {}", path.string(),
                                  image.width, image.height));
        }
        settings.width = image.width;
        settings.height = image.height;
        film = module.create_film(settings);
      }
      if (image.width != settings.width || image.height != settings.height) {
        throw Error(fmt::format("{}: picture {} is {} x {}, the first one {} x {}; a film's must be alike",
                                path.string(), i, image.width, image.height, settings.width,
                                settings.height));
      }
      film->write(frame_of(image));
    }
    if (!film) throw Error(fmt::format("{}: a film needs a picture at least", path.string()));
    film->finish();
  });
}

}  // namespace sateen::io
