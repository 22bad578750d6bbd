// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <optional>

#include <fmt/format.h>

#include "sateen/core/error.h"
#include "sateen/core/parallel.h"
#include "sateen/io/image_rows.h"
#include "sateen/texture/lobe_files.h"

namespace sateen::texture {

Vec3 decode_normal(std::span<const float> pixel, const NormalMapFormat& format, bool& repaired) {
  const auto component = [&](std::size_t c) {
    const double v = pixel[c];
    return format.is_signed ? v : 2 * v - 1;
  };
  const bool has_blue = pixel.size() > 2 && pixel[2] != 0;
  if (!has_blue && pixel[0] == 0 && pixel[1] == 0 && (pixel.size() > 2 || !format.is_signed)) {
    repaired = true;
    return Vec3::UnitZ();
  }
  Vec3 n(component(0), component(1), 0);
  if (format.green_down) n.y() = -n.y();
  if (has_blue) {
    n.z() = component(2);
  } else {
    const double square = 1 - n.head<2>().squaredNorm();
    repaired = repaired || square < 0;
    n.z() = std::sqrt(std::max(square, 0.0));
  }
  // Tangent-space normals do not point into the surface.
  constexpr double kLeastZ = 1e-3;
  if (n.z() < kLeastZ) n.z() = kLeastZ;
  return n.normalized();
}

struct LobeFileSource::State {
  LobeMapFiles files;
  std::optional<io::ImageRowReader> normals;
  std::optional<io::ImageRowReader> lobes;
  bool isotropic = false;
  int width = 0;
  int height = 0;
  std::vector<float> normal_rows;
  std::vector<float> lobe_rows;
  std::atomic<std::size_t> repaired{0};
};

LobeFileSource::LobeFileSource(const LobeMapFiles& files) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.files = files;
  if (!files.normals.empty()) s.normals.emplace(files.normals);
  s.isotropic = files.anisotropy.empty();
  if (!files.anisotropy.empty()) {
    s.lobes.emplace(files.anisotropy);
  } else if (!files.roughness.empty()) {
    s.lobes.emplace(files.roughness);
  }
  if (!s.normals && !s.lobes) throw Error("nothing to filter: give a normal map, an anisotropy map or both");
  const io::ImageRowReader& first = s.normals ? *s.normals : *s.lobes;
  s.width = first.width();
  s.height = first.height();
  if (s.lobes && (s.lobes->width() != s.width || s.lobes->height() != s.height)) {
    throw Error(fmt::format("{}: is {} x {} but {} is {} x {}; both maps need the same size",
                            s.lobes->path().string(), s.lobes->width(), s.lobes->height(),
                            files.normals.string(), s.width, s.height));
  }
  if (s.normals && s.normals->channels() < 2) {
    throw Error(
        fmt::format("{}: has one channel; a normal map needs at least x and y", files.normals.string()));
  }
  if (s.lobes && !s.isotropic && s.lobes->channels() < 3) {
    throw Error(
        fmt::format("{}: has {} channels; an anisotropy map has three (for a roughness map use --roughness)",
                    files.anisotropy.string(), s.lobes->channels()));
  }
}

LobeFileSource::~LobeFileSource() = default;

int LobeFileSource::width() const {
  return state_->width;
}

int LobeFileSource::height() const {
  return state_->height;
}

std::size_t LobeFileSource::repaired() const {
  return state_->repaired;
}

void LobeFileSource::read(std::span<LobeTexel> out) {
  State& s = *state_;
  const auto load = [&](std::optional<io::ImageRowReader>& reader, std::vector<float>& rows) {
    if (!reader) return std::size_t{0};
    const auto channels = static_cast<std::size_t>(reader->channels());
    rows.resize(out.size() * channels);
    reader->read(rows);
    return channels;
  };
  const std::size_t normal_channels = load(s.normals, s.normal_rows);
  const std::size_t lobe_channels = load(s.lobes, s.lobe_rows);
  const Mat2 constant = guarded(brdf::roughness_matrix(s.files.constant));
  const std::size_t width = static_cast<std::size_t>(s.width);
  parallel_for(static_cast<int>(out.size() / width), [&](int row) {
    std::size_t repaired = 0;
    for (std::size_t i = static_cast<std::size_t>(row) * width;
         i < (static_cast<std::size_t>(row) + 1) * width; ++i) {
      LobeTexel& texel = out[i];
      if (normal_channels > 0) {
        bool mended = false;
        texel.normal = decode_normal(
            std::span(s.normal_rows).subspan(i * normal_channels, std::min<std::size_t>(normal_channels, 3)),
            s.files.normal_format, mended);
        if (mended) ++repaired;
      }
      if (lobe_channels == 0) {
        texel.s = constant;
      } else if (s.isotropic) {
        const double r = std::clamp(static_cast<double>(s.lobe_rows[i * lobe_channels]), 0.0, 1.0);
        texel.s = guarded(brdf::roughness_matrix({r * r, r * r, 0}));
      } else {
        const float* c = s.lobe_rows.data() + i * lobe_channels;
        texel.s = guarded(decode_anisotropy({c[0], c[1], c[2]}, s.files.encoding));
      }
    }
    s.repaired += repaired;
  });
}

}  // namespace sateen::texture
