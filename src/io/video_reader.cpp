// SPDX-License-Identifier: MIT
#include "sateen/io/video_reader.h"

#include <cmath>

#include <fmt/format.h>

#include "sateen/core/error.h"
#include "sateen/core/parallel.h"
#include "sateen/io/film_formats.h"
#include "sateen/io/module.h"

namespace sateen::io {

std::span<const std::string> video_extensions() {
  static const std::vector<std::string> extensions = [] {
    std::vector<std::string> result;
    for (const FilmFormat& format : film_formats()) result.emplace_back(format.extension);
    return result;
  }();
  return extensions;
}

VideoReader::VideoReader(const std::filesystem::path& path) {
  std::error_code code;
  if (!std::filesystem::exists(path, code)) throw Error(fmt::format("{}: no such file", path.string()));
  frames_ = video_module(path.string() + ": reading a film").open_film(path.string(), thread_limit());
}

VideoReader::~VideoReader() = default;
VideoReader::VideoReader(VideoReader&&) noexcept = default;
VideoReader& VideoReader::operator=(VideoReader&&) noexcept = default;

int VideoReader::width() const {
  return frames_->width();
}

int VideoReader::height() const {
  return frames_->height();
}

int VideoReader::promised_frames() const {
  const double frames = frames_->promised_frames();
  return frames > 0 && frames < 1e8 ? static_cast<int>(frames) : 0;
}

double VideoReader::frames_per_second() const {
  const double rate = frames_->frames_per_second();
  return std::isfinite(rate) && rate > 0 ? rate : 0;
}

bool VideoReader::next(Picture8& frame) {
  return frames_->next(frame);
}

bool VideoReader::skip() {
  return frames_->skip();
}

double VideoReader::seconds() const {
  return frames_->seconds();
}

}  // namespace sateen::io
