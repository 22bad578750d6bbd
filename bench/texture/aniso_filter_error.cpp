// SPDX-License-Identifier: MIT
// How well each filter method stands for the averaged lobes: aniso_filter_error NORMALMAP...
// For mips 1 to 6 of every map, blocks of the map under constant lobes are filtered with each method; the
// filtered lobe's radiance is compared with the mean over the block's texels, each with its own lobe, for 48
// lights and three views each. Printed: sqrt(sum of squared differences / sum of squared means), averaged
// over mips (and maps). Normal maps hold n / 2 + 1/2, green up.
#include <array>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "sateen/core/error.h"
#include "sateen/io/image.h"
#include "sateen/texture/lobe_files.h"
#include "texture/lobe_radiance.h"

namespace {

using namespace sateen;

struct Method {
  const char* name;
  texture::FilterOptions options;
};

const std::array<Method, 6> kMethods{
    {{"naive",
      {texture::FilterMethod::naive, texture::NormalSolver::eigen, texture::AnisotropyEncoding::correlation,
       false}},
     {"lean",
      {texture::FilterMethod::lean, texture::NormalSolver::eigen, texture::AnisotropyEncoding::root, false}},
     {"sggx",
      {texture::FilterMethod::sggx, texture::NormalSolver::eigen, texture::AnisotropyEncoding::root, false}},
     {"sggx, power it.",
      {texture::FilterMethod::sggx, texture::NormalSolver::power_iteration, texture::AnisotropyEncoding::root,
       false}},
     {"sggx-variance",
      {texture::FilterMethod::sggx_variance, texture::NormalSolver::eigen, texture::AnisotropyEncoding::root,
       false}},
     {"... isotropic",
      {texture::FilterMethod::sggx_variance, texture::NormalSolver::eigen, texture::AnisotropyEncoding::root,
       true}}}};

// The slides' well-behaved pair and its neighbours, then the two pairs they call a limit.
constexpr std::array<std::array<double, 2>, 5> kLobes{
    {{0.29, 0.04}, {0.2, 0.05}, {0.1, 0.1}, {0.87, 0.04}, {0.87, 0.1}}};
constexpr int kBlocks = 12;
constexpr int kMips = 6;

using Errors = std::array<double, kMethods.size()>;

struct Directions {
  Vec3 light;
  Vec3 view;
};

std::vector<Directions> directions() {
  std::vector<Directions> all;
  for (int i = 0; i < 48; ++i) {
    // Lights are spread evenly over the projected hemisphere.
    const double sine = std::sqrt(0.98 * (i + 0.5) / 48);
    const double turn = 2.399963 * i;
    const Vec3 light(sine * std::cos(turn), sine * std::sin(turn), std::sqrt(1 - sine * sine));
    for (const double tilt : {0.0, 30.0, 60.0}) {
      const double a = radians(tilt);
      const double around = 1.7 * i + tilt;
      all.push_back({light, {std::sin(a) * std::cos(around), std::sin(a) * std::sin(around), std::cos(a)}});
    }
  }
  return all;
}

/// At most 16 x 16 texels spread over a block.
std::vector<texture::LobeTexel> texels_of(const Image& map, int x0, int y0, int size, const Mat2& s) {
  std::vector<texture::LobeTexel> texels;
  const int step = std::max(1, size / 16);
  for (int y = y0; y < y0 + size; y += step) {
    for (int x = x0; x < x0 + size; x += step) {
      bool repaired = false;
      texels.push_back({texture::decode_normal(map.pixel(x, y), {}, repaired), s});
    }
  }
  return texels;
}

texture::LobeTexel filtered(const std::vector<texture::LobeTexel>& texels,
                            const texture::FilterOptions& options) {
  std::array<float, texture::kMoments> mean{};
  for (const texture::LobeTexel& texel : texels) {
    std::array<float, texture::kMoments> moments{};
    texture::pack_moments(texel, options, moments);
    for (std::size_t i = 0; i < texture::kMoments; ++i)
      mean[i] += moments[i] / static_cast<float>(texels.size());
  }
  return texture::unpack_moments(mean, options);
}

Errors measure(const Image& map, const brdf::AnisotropicRoughness& lobe) {
  static const std::vector<Directions> kDirections = directions();
  Errors mean{};
  for (int mip = 1; mip <= kMips; ++mip) {
    const int size = 1 << mip;
    std::mt19937 generator(5);
    Errors squared{};
    double reference = 0;
    for (int block = 0; block < kBlocks; ++block) {
      const int x = static_cast<int>(generator() % static_cast<unsigned>(map.width / size)) * size;
      const int y = static_cast<int>(generator() % static_cast<unsigned>(map.height / size)) * size;
      const auto texels = texels_of(map, x, y, size, brdf::roughness_matrix(lobe));
      std::array<texture::LobeTexel, kMethods.size()> results;
      for (std::size_t m = 0; m < kMethods.size(); ++m) results[m] = filtered(texels, kMethods[m].options);
      for (const auto& [light, view] : kDirections) {
        double truth = 0;
        for (const texture::LobeTexel& texel : texels) truth += lobe_radiance(texel, light, view);
        truth /= static_cast<double>(texels.size());
        reference += truth * truth;
        for (std::size_t m = 0; m < kMethods.size(); ++m) {
          squared[m] += std::pow(lobe_radiance(results[m], light, view) - truth, 2);
        }
      }
    }
    for (std::size_t m = 0; m < kMethods.size(); ++m) mean[m] += std::sqrt(squared[m] / reference) / kMips;
  }
  return mean;
}

void print_row(const std::string& name, const Errors& errors) {
  fmt::print("{:32}", name);
  for (const double e : errors) fmt::print("{:16.3f}", e);
  fmt::print("\n");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    fmt::print("{:32}", "");
    for (const Method& method : kMethods) fmt::print("{:>16}", method.name);
    fmt::print("\n");
    std::array<Errors, kLobes.size()> by_lobe{};
    for (int i = 1; i < argc; ++i) {
      const std::filesystem::path path = argv[i];
      const Image map = io::read_data(path);
      Errors of_map{};
      for (std::size_t lobe = 0; lobe < kLobes.size(); ++lobe) {
        const Errors errors = measure(map, {kLobes[lobe][0], kLobes[lobe][1], 0.5});
        for (std::size_t m = 0; m < errors.size(); ++m) {
          by_lobe[lobe][m] += errors[m] / (argc - 1);
          if (lobe < 3) of_map[m] += errors[m] / 3;
        }
      }
      print_row((path.parent_path().filename() / path.filename()).string().substr(0, 31), of_map);
    }
    Errors all{};
    for (std::size_t m = 0; m < all.size(); ++m) all[m] = (by_lobe[0][m] + by_lobe[1][m] + by_lobe[2][m]) / 3;
    print_row("mean", all);
    for (std::size_t lobe = 0; lobe < kLobes.size(); ++lobe) {
      print_row(fmt::format("alphas {} and {}", kLobes[lobe][0], kLobes[lobe][1]), by_lobe[lobe]);
    }
  } catch (const sateen::Error& error) {
    fmt::print(stderr, "aniso_filter_error: {}\n", error.what());
    return 1;
  }
}
