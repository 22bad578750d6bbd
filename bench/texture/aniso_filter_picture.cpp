// SPDX-License-Identifier: MIT
// A sphere far away under two lamps, tiled with a normal map so that a pixel covers 16 x 16 texels, shaded
// with mip 4:
//   aniso_filter_picture NORMALMAP OUT.png
// Top row: the mean of all texels' own lobes (the truth), naive, LEAN. Bottom row: sggx, sggx-variance,
// isotropic.
#include <array>
#include <filesystem>
#include <vector>

#include <fmt/format.h>

#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/core/parallel.h"
#include "sateen/io/image.h"
#include "sateen/texture/lobe_files.h"
#include "texture/lobe_radiance.h"

namespace {

using namespace sateen;

constexpr int kPanel = 220;
constexpr int kBlock = 16;

/// Lights and view in the frame of the sphere's point, tangents around the vertical axis.
struct Point {
  Mat3 to_local;
};

double shade(const texture::LobeTexel& texel, const Point& point) {
  static const std::array<Vec3, 2> kLamps{Vec3(-0.5, 0.6, 0.8).normalized(),
                                          Vec3(0.8, -0.1, 0.5).normalized()};
  double sum = 0;
  for (const Vec3& lamp : kLamps)
    sum += lobe_radiance(texel, point.to_local * lamp, point.to_local * Vec3::UnitZ());
  return sum;
}

void draw(const Image& map, const std::filesystem::path& output) {
  const Mat2 s = brdf::roughness_matrix({0.35, 0.12, 0});
  const int blocks_u = map.width / kBlock;
  const int blocks_v = map.height / kBlock;
  if (blocks_u < 1 || blocks_v < 1) throw Error("the normal map is smaller than 16 x 16");
  const std::array<texture::FilterOptions, 5> methods{
      {{texture::FilterMethod::naive, texture::NormalSolver::eigen, texture::AnisotropyEncoding::root, false},
       {texture::FilterMethod::lean, texture::NormalSolver::eigen, texture::AnisotropyEncoding::root, false},
       {texture::FilterMethod::sggx, texture::NormalSolver::eigen, texture::AnisotropyEncoding::root, false},
       {texture::FilterMethod::sggx_variance, texture::NormalSolver::eigen, texture::AnisotropyEncoding::root,
        false},
       {texture::FilterMethod::sggx_variance, texture::NormalSolver::eigen, texture::AnisotropyEncoding::root,
        true}}};
  Image picture(kPanel * 3, kPanel * 2, 1);
  parallel_for(kPanel, [&](int y) {
    for (int x = 0; x < kPanel; ++x) {
      const Vec2 disc = disc_of_pixel(x, y, kPanel);
      if (disc.norm() >= 1) continue;
      const Vec3 n = normal_on_disc(disc);
      const Vec3 t = Vec3::UnitY().cross(n).normalized();
      Point point;
      point.to_local << t.transpose(), n.cross(t).transpose(), n.transpose();
      std::vector<texture::LobeTexel> texels;
      for (int i = 0; i < kBlock * kBlock; ++i) {
        bool repaired = false;
        texels.push_back({texture::decode_normal(map.pixel(x % blocks_u * kBlock + i % kBlock,
                                                           y % blocks_v * kBlock + i / kBlock),
                                                 {}, repaired),
                          s});
      }
      double truth = 0;
      for (const texture::LobeTexel& texel : texels)
        truth += shade(texel, point) / static_cast<double>(texels.size());
      picture.at(x, y, 0) = static_cast<float>(truth);
      for (std::size_t m = 0; m < methods.size(); ++m) {
        std::array<float, texture::kMoments> mean{};
        for (const texture::LobeTexel& texel : texels) {
          std::array<float, texture::kMoments> moments{};
          texture::pack_moments(texel, methods[m], moments);
          for (std::size_t k = 0; k < texture::kMoments; ++k)
            mean[k] += moments[k] / static_cast<float>(texels.size());
        }
        const int panel = static_cast<int>(m) + 1;
        picture.at(panel % 3 * kPanel + x, panel / 3 * kPanel + y, 0) =
            static_cast<float>(shade(texture::unpack_moments(mean, methods[m]), point));
      }
    }
  });
  for (float& v : picture.data) v *= 0.35f;
  io::write_image(output, picture);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: aniso_filter_picture NORMALMAP OUT.png\n");
    return 2;
  }
  try {
    draw(io::read_data(argv[1]), argv[2]);
  } catch (const Error& error) {
    fmt::print(stderr, "aniso_filter_picture: {}\n", error.what());
    return 1;
  }
}
