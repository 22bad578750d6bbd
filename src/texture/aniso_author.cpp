// SPDX-License-Identifier: MIT
#include "sateen/texture/aniso_author.h"

#include <array>
#include <charconv>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "sateen/brdf/conventions.h"
#include "sateen/core/error.h"
#include "sateen/core/parallel.h"
#include "sateen/io/file.h"
#include "sateen/io/image_rows.h"

namespace sateen::texture {
namespace {

namespace fs = std::filesystem;

constexpr int kRows = 32;

template <typename Enum, std::size_t N>
Enum from_name(const std::string& name, const std::array<std::pair<const char*, Enum>, N>& known,
               const char* what) {
  std::string list;
  for (const auto& [text, value] : known) {
    if (name == text) return value;
    list += list.empty() ? text : std::string(", ") + text;
  }
  throw Error(fmt::format("unknown {} {}: use one of {}", what, name, list));
}

io::RowSamples samples_for(const fs::path& output, int bits) {
  const std::string extension = io::extension_of(output);
  if (extension == ".exr") return io::RowSamples::f32;
  if (extension == ".png") return bits == 8 ? io::RowSamples::u8 : io::RowSamples::u16;
  throw Error(fmt::format("{}: maps are written as .png or .exr", output.string()));
}

/// Several pictures of one size, read in step.
class InputRows {
 public:
  /// Index by which `value` knows the input.
  std::size_t add(const MapInput& input, int channels_needed = 1) {
    inputs_.push_back({input, nullptr, {}});
    if (input.file.empty()) return inputs_.size() - 1;
    Input& added = inputs_.back();
    added.reader = std::make_unique<io::ImageRowReader>(input.file);
    const io::ImageRowReader& r = *added.reader;
    if (first_ != nullptr && (r.width() != first_->width() || r.height() != first_->height())) {
      throw Error(fmt::format("{}: is {} x {} but {} is {} x {}; all maps need the same size",
                              r.path().string(), r.width(), r.height(), first_->path().string(),
                              first_->width(), first_->height()));
    }
    if (r.channels() < input.channel + channels_needed) {
      throw Error(fmt::format("{}: has {} channels, channel {} is asked for", r.path().string(), r.channels(),
                              input.channel + channels_needed));
    }
    if (first_ == nullptr) first_ = &r;
    return inputs_.size() - 1;
  }

  int width() const { return first_ != nullptr ? first_->width() : 4; }
  int height() const { return first_ != nullptr ? first_->height() : 4; }

  void read(int rows) {
    for (Input& input : inputs_) {
      if (!input.reader) continue;
      input.rows.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(width()) *
                        static_cast<std::size_t>(input.reader->channels()));
      input.reader->read(input.rows);
    }
  }

  double value(std::size_t index, std::size_t texel, int extra_channel = 0) const {
    const Input& input = inputs_[index];
    if (!input.reader) return input.source.value;
    return input.rows[texel * static_cast<std::size_t>(input.reader->channels()) +
                      static_cast<std::size_t>(input.source.channel + extra_channel)];
  }

 private:
  struct Input {
    MapInput source;
    std::unique_ptr<io::ImageRowReader> reader;
    std::vector<float> rows;
  };
  std::vector<Input> inputs_;
  const io::ImageRowReader* first_ = nullptr;
};

/// Runs `texel` over a picture in strips: it reads from `inputs` and fills three channels of each output.
void write_maps(InputRows& inputs, std::vector<fs::path> outputs, int bits,
                const std::function<void(std::size_t texel, std::vector<std::array<float, 3>>& out)>& texel,
                const Progress& progress) {
  const auto run = [&](std::span<const fs::path> files) {
    const std::size_t width = static_cast<std::size_t>(inputs.width());
    std::vector<std::unique_ptr<io::ImageRowWriter>> writers;
    for (std::size_t i = 0; i < files.size(); ++i) {
      writers.push_back(std::make_unique<io::ImageRowWriter>(
          files[i], outputs[i], inputs.width(), inputs.height(), 3, samples_for(outputs[i], bits)));
    }
    for (int y = 0; y < inputs.height(); y += kRows) {
      const int count = std::min(kRows, inputs.height() - y);
      inputs.read(count);
      std::vector<std::vector<float>> rows(files.size(),
                                           std::vector<float>(static_cast<std::size_t>(count) * width * 3));
      parallel_for(count, [&](int r) {
        std::vector<std::array<float, 3>> values(files.size());
        for (std::size_t i = static_cast<std::size_t>(r) * width;
             i < (static_cast<std::size_t>(r) + 1) * width; ++i) {
          texel(i, values);
          for (std::size_t f = 0; f < files.size(); ++f) {
            std::ranges::copy(values[f], rows[f].begin() + static_cast<std::ptrdiff_t>(i * 3));
          }
        }
      });
      for (std::size_t f = 0; f < files.size(); ++f) writers[f]->write(rows[f]);
      report(progress, static_cast<double>(y + count) / inputs.height());
    }
    for (auto& writer : writers) writer->close();
  };
  for (const fs::path& output : outputs) samples_for(output, bits);
  io::write_atomically(outputs, run);
}

/// What a convention's functions are, for those that store roughness, strength and rotation.
struct Convention {
  brdf::AnisotropicRoughness (*from)(const brdf::AnisotropyParameters&);
  brdf::AnisotropyParameters (*to)(const brdf::AnisotropicRoughness&);
};
constexpr Convention kGltf{brdf::from_gltf, brdf::to_gltf};
constexpr Convention kBlender{brdf::from_blender, brdf::to_blender};
constexpr Convention kSubstance{brdf::from_substance, brdf::to_substance};
constexpr Convention kMaterialX{brdf::from_materialx, brdf::to_materialx};
constexpr Convention kFilament{brdf::from_filament, brdf::to_filament};

Convention convention_of(AnisotropyStyle style) {
  switch (style) {
    case AnisotropyStyle::blender:
      return kBlender;
    case AnisotropyStyle::substance:
      return kSubstance;
    case AnisotropyStyle::materialx:
      return kMaterialX;
    case AnisotropyStyle::filament:
      return kFilament;
    case AnisotropyStyle::gltf:
    case AnisotropyStyle::uv:  // has functions of its own
      break;
  }
  return kGltf;
}

Convention convention_of(DecodeStyle style) {
  switch (style) {
    case DecodeStyle::blender:
      return kBlender;
    case DecodeStyle::substance:
      return kSubstance;
    case DecodeStyle::materialx:
      return kMaterialX;
    case DecodeStyle::filament:
      return kFilament;
    case DecodeStyle::gltf:
    case DecodeStyle::alphas:  // these two are written as they are
    case DecodeStyle::uv:
      break;
  }
  return kGltf;
}

/// Encoded values as float3.
std::array<float, 3> triple(double a, double b, double c) {
  return {static_cast<float>(a), static_cast<float>(b), static_cast<float>(c)};
}

}  // namespace

MapInput parse_map_input(const std::string& text) {
  MapInput input;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), input.value);
  if (code == std::errc() && end == text.data() + text.size()) return input;
  input.value = 0;
  std::string file = text;
  if (text.size() > 2 && text[text.size() - 2] == ':') {
    const std::size_t channel = std::string("rgba").find(text.back());
    if (channel != std::string::npos) {
      input.channel = static_cast<int>(channel);
      file.resize(file.size() - 2);
    }
  }
  input.file = file;
  return input;
}

AnisotropyStyle anisotropy_style_from_name(const std::string& name) {
  return from_name<AnisotropyStyle, 6>(name,
                                       {{{"uv", AnisotropyStyle::uv},
                                         {"gltf", AnisotropyStyle::gltf},
                                         {"blender", AnisotropyStyle::blender},
                                         {"substance", AnisotropyStyle::substance},
                                         {"materialx", AnisotropyStyle::materialx},
                                         {"filament", AnisotropyStyle::filament}}},
                                       "style");
}

DecodeStyle decode_style_from_name(const std::string& name) {
  return from_name<DecodeStyle, 7>(name,
                                   {{{"alphas", DecodeStyle::alphas},
                                     {"uv", DecodeStyle::uv},
                                     {"gltf", DecodeStyle::gltf},
                                     {"blender", DecodeStyle::blender},
                                     {"substance", DecodeStyle::substance},
                                     {"materialx", DecodeStyle::materialx},
                                     {"filament", DecodeStyle::filament}}},
                                   "style");
}

void author_anisotropy(const AuthorInputs& in, const fs::path& output, AnisotropyEncoding encoding, int bits,
                       const Progress& progress) {
  InputRows rows;
  const bool uv = in.style == AnisotropyStyle::uv;
  const bool vectors = !in.vectors.empty();
  const bool gltf_texture = vectors && in.style == AnisotropyStyle::gltf;
  const std::size_t first = rows.add(uv ? in.along : in.roughness);
  const std::size_t second = rows.add(uv ? in.across : in.amount);
  const std::size_t rotation = rows.add(in.rotation);
  const std::size_t direction = rows.add({in.vectors, 0, 0}, gltf_texture ? 3 : vectors ? 2 : 1);
  const double turns_at_one = in.rotation.file.empty() ? 1 : in.turns_at_one;

  const Convention convention = convention_of(in.style);

  const auto lobe = [&](std::size_t i) {
    double turns = rows.value(rotation, i) * turns_at_one;
    double amount = rows.value(second, i);
    if (vectors) {
      const double x = 2 * rows.value(direction, i) - 1;
      const double y = 2 * rows.value(direction, i, 1) - 1;
      // A vector of no length has no direction: the axis stays along U.
      if (x * x + y * y > 1e-8) turns += std::atan2(y, x) / (2 * kPi);
      if (gltf_texture) amount *= rows.value(direction, i, 2);
    }
    const double value = rows.value(first, i);
    const double rotation_angle = 2 * kPi * turns;
    if (!uv) return convention.from({value, amount, rotation_angle});
    return in.gloss ? brdf::from_uv({1 - value, 1 - amount, rotation_angle})
                    : brdf::from_uv({value, amount, rotation_angle});
  };
  write_maps(
      rows, {output}, bits,
      [&](std::size_t i, std::vector<std::array<float, 3>>& out) {
        const Vec3 c = encode_anisotropy(brdf::roughness_matrix(lobe(i)), encoding);
        out[0] = triple(c[0], c[1], c[2]);
      },
      progress);
}

std::vector<fs::path> decode_anisotropy_map(const fs::path& map, AnisotropyEncoding encoding,
                                            DecodeStyle style, const fs::path& output, int bits,
                                            const Progress& progress) {
  InputRows rows;
  const std::size_t input = rows.add({map, 0, 0}, 3);
  std::vector<fs::path> outputs{output};
  if (style == DecodeStyle::gltf) {
    fs::path roughness = output;
    roughness.replace_filename(output.stem().string() + "_roughness" + output.extension().string());
    outputs.push_back(roughness);
  }
  const Convention convention = convention_of(style);
  write_maps(
      rows, outputs, bits,
      [&](std::size_t i, std::vector<std::array<float, 3>>& out) {
        const Vec3 c(rows.value(input, i), rows.value(input, i, 1), rows.value(input, i, 2));
        const brdf::AnisotropicRoughness lobe = brdf::roughness_from_matrix(decode_anisotropy(c, encoding));
        switch (style) {
          case DecodeStyle::alphas:
            out[0] = triple(lobe.alpha_t, lobe.alpha_b, lobe.azimuth / kPi);
            break;
          case DecodeStyle::uv: {
            const brdf::UvRoughness s = brdf::to_uv(lobe);
            out[0] = triple(s.along, s.across, s.rotation / kPi);
            break;
          }
          case DecodeStyle::gltf: {
            const brdf::AnisotropyParameters s = convention.to(lobe);
            out[0] = triple(std::cos(s.rotation) / 2 + 0.5, std::sin(s.rotation) / 2 + 0.5, s.anisotropy);
            out[1] = triple(s.roughness, s.roughness, s.roughness);
            break;
          }
          default: {
            const brdf::AnisotropyParameters s = convention.to(lobe);
            out[0] = triple(s.roughness, s.anisotropy, s.rotation / (2 * kPi));
          }
        }
      },
      progress);
  return outputs;
}

}  // namespace sateen::texture
