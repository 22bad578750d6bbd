// SPDX-License-Identifier: MIT
// What texture interpolation and 8 bits or BC7 do to the encodings of anisotropy maps. Four neighbouring
// lobes, encoded, are interpolated at a random place between them; the decoded lobe's radiance is compared
// with the weighted mean of the four lobes' (as in aniso_filter_error). Compared are the encodings of the
// library, and for reference the matrix itself, its fourth root and its Cholesky factor, which fit the same
// three channels. Then the alphas that come back from 8 bits, and from BC7 blocks of a map with turning
// directions.
#include <array>
#include <functional>
#include <random>
#include <vector>

#include <fmt/format.h>

#include "sateen/texture/block_compression.h"
#include "texture/dds.h"
#include "texture/lobe_radiance.h"

namespace {

using namespace sateen;

struct Encoding {
  const char* name;
  std::function<Vec3(const Mat2&)> encode;
  std::function<Mat2(const Vec3&)> decode;
};

Mat2 root_of(const Mat2& s) {
  const double root_det = std::sqrt(std::max(s.determinant(), 0.0));
  return (s + root_det * Mat2::Identity()) / std::sqrt(s.trace() + 2 * root_det);
}

Vec3 channels_of(const Mat2& m) {
  return {m(0, 0), m(0, 1) + 0.5, m(1, 1)};
}

Mat2 matrix_of(const Vec3& c) {
  Mat2 m;
  m << c[0], c[1] - 0.5, c[1] - 0.5, c[2];
  return m;
}

std::vector<Encoding> encodings() {
  const auto library = [](texture::AnisotropyEncoding e) {
    return Encoding{e == texture::AnisotropyEncoding::root ? "root" : "correlation",
                    [e](const Mat2& s) { return texture::encode_anisotropy(s, e); },
                    [e](const Vec3& c) { return texture::decode_anisotropy(c, e); }};
  };
  return {library(texture::AnisotropyEncoding::correlation),
          library(texture::AnisotropyEncoding::root),
          {"matrix", channels_of, matrix_of},
          {"fourth root", [](const Mat2& s) { return channels_of(root_of(root_of(s))); },
           [](const Vec3& c) {
             const Mat2 q = matrix_of(c) * matrix_of(c);
             return Mat2(q * q);
           }},
          {"cholesky",
           [](const Mat2& s) {
             const double a = std::sqrt(s(0, 0));
             const double b = s(0, 1) / a;
             return Vec3(a, b / 2 + 0.5, std::sqrt(std::max(s(1, 1) - b * b, 0.0)));
           },
           [](const Vec3& c) {
             const double b = 2 * c[1] - 1;
             Mat2 s;
             s << c[0] * c[0], c[0] * b, c[0] * b, b * b + c[2] * c[2];
             return s;
           }}};
}

Vec3 quantised(const Vec3& c) {
  return (c.cwiseMax(0.0).cwiseMin(1.0) * 255 + Vec3::Constant(0.5)).array().floor().matrix() / 255;
}

enum class Scene { smooth, warp_and_weft, random };

/// Relative radiance error of each encoding, and last of interpolating the matrix without quantisation.
std::vector<double> interpolation_errors(const std::vector<Encoding>& all,
                                         const brdf::AnisotropicRoughness& lobe, Scene scene) {
  std::mt19937 generator(1);
  const auto uniform = [&] { return std::uniform_real_distribution<double>(0, 1)(generator); };
  std::vector<double> squared(all.size() + 1);
  double reference = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double base = uniform() * kPi;
    std::array<texture::LobeTexel, 4> corner;
    for (int j = 0; j < 4; ++j) {
      brdf::AnisotropicRoughness a = lobe;
      a.azimuth = scene == Scene::smooth   ? base + (uniform() - 0.5) * 0.5
                  : scene == Scene::random ? uniform() * kPi
                                           : base + (j % 2) * kPi / 2;
      corner[static_cast<std::size_t>(j)].s = brdf::roughness_matrix(a);
    }
    const double u = uniform();
    const double v = uniform();
    const std::array<double, 4> weight{(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
    std::vector<texture::LobeTexel> results(all.size() + 1);
    Mat2 linear = Mat2::Zero();
    for (std::size_t j = 0; j < 4; ++j) linear += weight[j] * corner[j].s;
    results.back().s = texture::guarded(linear);
    for (std::size_t e = 0; e < all.size(); ++e) {
      Vec3 c = Vec3::Zero();
      for (std::size_t j = 0; j < 4; ++j) c += weight[j] * quantised(all[e].encode(corner[j].s));
      results[e].s = texture::guarded(all[e].decode(c));
    }
    for (int i = 0; i < 48; ++i) {
      const double sine = std::sqrt(0.98 * (i + 0.5) / 48);
      const Vec3 light(sine * std::cos(2.399963 * i), sine * std::sin(2.399963 * i),
                       std::sqrt(1 - sine * sine));
      for (const double tilt : {0.0, 0.5, 1.0}) {
        const Vec3 view(std::sin(tilt) * std::cos(i), std::sin(tilt) * std::sin(i), std::cos(tilt));
        double truth = 0;
        for (std::size_t j = 0; j < 4; ++j) truth += weight[j] * lobe_radiance(corner[j], light, view);
        reference += truth * truth;
        for (std::size_t e = 0; e < results.size(); ++e) {
          squared[e] += std::pow(lobe_radiance(results[e], light, view) - truth, 2);
        }
      }
    }
  }
  for (double& s : squared) s = std::sqrt(s / reference);
  return squared;
}

/// Mean relative error of both alphas of a map whose direction turns, after 8 bits, or after BC7.
double alpha_error(const Encoding& encoding, const brdf::AnisotropicRoughness& lobe, bool blocks) {
  constexpr int kSize = 128;
  std::vector<std::uint8_t> rgba;
  std::vector<brdf::AnisotropicRoughness> truth;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      truth.push_back({lobe.alpha_t, lobe.alpha_b, 0.03 * x + 0.5 * std::sin(0.05 * y)});
      const Vec3 c = quantised(encoding.encode(brdf::roughness_matrix(truth.back())));
      for (int k = 0; k < 3; ++k) rgba.push_back(static_cast<std::uint8_t>(std::lround(c[k] * 255)));
      rgba.push_back(255);
    }
  }
  if (blocks) {
    const auto dds = std::filesystem::temp_directory_path() / "sateen_aniso_encoding_error.dds";
    rgba = test::decode_blocks(texture::BlockFormat::bc7,
                               texture::compress_blocks(texture::BlockFormat::bc7, rgba, kSize, kSize), kSize,
                               kSize, dds);
    std::filesystem::remove(dds);
  }
  double error = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const brdf::AnisotropicRoughness back = brdf::roughness_from_matrix(
        encoding.decode(Vec3(rgba[i * 4], rgba[i * 4 + 1], rgba[i * 4 + 2]) / 255));
    error += (std::abs(back.alpha_t / lobe.alpha_t - 1) + std::abs(back.alpha_b / lobe.alpha_b - 1)) / 2;
  }
  return error / static_cast<double>(truth.size());
}

}  // namespace

int main() {
  const std::vector<Encoding> all = encodings();
  const std::array<brdf::AnisotropicRoughness, 4> lobes{
      {{0.3, 0.1, 0}, {0.29, 0.04, 0}, {0.87, 0.1, 0}, {0.87, 0.04, 0}}};
  fmt::print("{:44}", "");
  for (const Encoding& e : all) fmt::print("{:>13}", e.name);
  fmt::print("{:>13}\n", "exact matrix");
  const auto row = [](const std::string& name, const std::vector<double>& values) {
    fmt::print("{:44}", name);
    for (const double v : values) fmt::print("{:13.3f}", v);
    fmt::print("\n");
  };
  for (const auto& [scene, name] :
       {std::pair{Scene::smooth, "angles within 14 degrees"},
        std::pair{Scene::warp_and_weft, "warp beside weft"}, std::pair{Scene::random, "random angles"}}) {
    for (const brdf::AnisotropicRoughness& lobe : lobes) {
      row(fmt::format("{}, {} and {}", name, lobe.alpha_t, lobe.alpha_b),
          interpolation_errors(all, lobe, scene));
    }
  }
  for (const bool blocks : {false, true}) {
    for (const brdf::AnisotropicRoughness& lobe : lobes) {
      std::vector<double> errors;
      for (const Encoding& e : all) errors.push_back(alpha_error(e, lobe, blocks));
      row(fmt::format("alphas {} and {} after {}", lobe.alpha_t, lobe.alpha_b, blocks ? "BC7" : "8 bits"),
          errors);
    }
  }
}
