// SPDX-License-Identifier: MIT
// The module sateen-video: everything of the project that needs FFmpeg's libraries.
#include "sateen/io/modules/film/film_sink.h"
#include "sateen/io/modules/film/film_source.h"
#include "sateen/io/modules/film/libav.h"

namespace sateen::io {
namespace {

/// The libraries' own chatter would end up among a program's messages; what matters is told by Error.
void silence_libraries() {
  av_log_set_level(AV_LOG_QUIET);
}

std::unique_ptr<FrameSource> open_film(const std::string& path, int threads) {
  silence_libraries();
  return std::make_unique<FilmSource>(path, threads);
}

std::unique_ptr<FrameSink> create_film(const FilmSettings& settings) {
  silence_libraries();
  return std::make_unique<FilmSink>(settings);
}

constexpr VideoModule kModule{SATEEN_VERSION, open_film, create_film};

}  // namespace
}  // namespace sateen::io

extern "C" __attribute__((visibility("default"))) const sateen::io::VideoModule* sateen_module() {
  return &sateen::io::kModule;
}
