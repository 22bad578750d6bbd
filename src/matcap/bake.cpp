// SPDX-License-Identifier: MIT
#include "sateen/matcap/bake.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/colour.h"
#include "sateen/core/direction.h"
#include "sateen/core/parallel.h"

namespace sateen::matcap {
namespace {

Vec3 to_linear(Vec3 v, AddUpSpace space) {
  if (space == AddUpSpace::display) {
    for (double& c : v) c = srgb_decode(static_cast<float>(c));
  }
  return v;
}

template <class Shade>
Image over_picture(const MatcapDecomposition& matcap, const Shade& shade) {
  Image image(matcap.width, matcap.height, 3);
  parallel_for(image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      Vec2 p = disc_point(matcap.disc, x + 0.5, y + 0.5);
      // The outermost pixel centres lie about half a pixel inside the rim; beyond, no pixel of the input was
      // seen.
      const double reach = 1 - 0.5 / matcap.disc.radius;
      if (p.squaredNorm() >= 1) p *= reach / p.norm();
      image.set_rgb(x, y, shade(normal_on_disc(p)).template cast<float>());
    }
  });
  return image;
}

}  // namespace

Image bake(const EditedMatcap& matcap) {
  Image image = over_picture(matcap.matcap, [&](const Vec3& n) { return evaluate(matcap, n); });
  if (matcap.light.isIdentity()) put_back(matcap.matcap.kept, image, matcap.matcap.disc);
  return image;
}

std::array<Image, 2> bake_layers(const EditedMatcap& matcap) {
  const AddUpSpace space = matcap.matcap.space;
  const auto low = [&](const Vec3& n) { return to_linear(evaluate_part(matcap, Part::low, n), space); };
  Image diffuse = over_picture(matcap.matcap, low);
  Image specular = bake(matcap);
  for (std::size_t i = 0; i < specular.data.size(); ++i) specular.data[i] -= diffuse.data[i];
  return {std::move(diffuse), std::move(specular)};
}

Vec3 direction_of_environment(int x, int y, int height) {
  const double longitude = 2 * kPi * ((x + 0.5) / (2 * height) - 0.5);
  const double latitude = kPi * (0.5 - (y + 0.5) / height);
  return {std::cos(latitude) * std::sin(longitude), std::sin(latitude),
          -std::cos(latitude) * std::cos(longitude)};
}

Image bake_environment(const EditedMatcap& matcap, Part part, int height) {
  Image image(2 * height, height, 3);
  const PartLook& look = matcap.look(part);
  parallel_for(height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      const Vec3 w = matcap.light.transpose() * direction_of_environment(x, y, height);
      const Vec3 color = look.intensity * look.base_color.cwiseProduct(sample(matcap.matcap[part].map, w, 0));
      image.set_rgb(x, y, to_linear(color, matcap.matcap.space).cast<float>());
    }
  });
  return image;
}

double psnr_on_disc(const Image& a, const Image& b, const Disc& disc) {
  double sum = 0;
  double count = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      if (!on_disc(disc, x, y)) continue;
      for (int c = 0; c < 3; ++c) {
        const double d = srgb_encode(a.rgb(x, y)[c]) - srgb_encode(b.rgb(x, y)[c]);
        sum += d * d;
        ++count;
      }
    }
  }
  return sum > 0 ? -10 * std::log10(sum / count) : 200;
}

}  // namespace sateen::matcap
