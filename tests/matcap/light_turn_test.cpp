// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "sateen/matcap/bake.h"
#include "sateen/matcap/warp.h"
#include "support/matcaps.h"

// Figure 12: a sphere under an environment that is known, before and after the light turns, against the two
// things one would try without a decomposition.
namespace sateen::matcap {
namespace {

constexpr int kSize = 128;
constexpr double kFilter = 0.012;  // variance of the glossy material's filter

struct Lobe {
  Vec3 direction;
  double variance;
  double glossy;  ///< radiance
  double matte;   ///< irradiance over pi
};

const std::vector<Lobe>& environment() {
  static const std::vector<Lobe> lobes{{test::direction_at(0.9, 0.8), 0.004, 3, 0.35},
                                       {test::direction_at(1.7, 3.4), 0.02, 1.5, 0.15},
                                       {test::direction_at(2.3, 5.2), 0.05, 1, 0.1}};
  return lobes;
}

/// The glossy part: Gaussians blurred by the filter are wider and lower Gaussians. The matte part: cosine
/// lobes.
Image rendered(const Mat3& turn) {
  return test::sphere_picture(kSize, [&](const Vec3& n) -> Vec3 {
    const Vec3 mirror = 2 * n.z() * n - Vec3::UnitZ();
    double sum = 0.05;
    for (const Lobe& l : environment()) {
      const Vec3 direction = turn * l.direction;
      const double angle = test::angle_between(mirror, direction);
      const double wide = l.variance + kFilter;
      sum += l.glossy * l.variance / wide * std::exp(-angle * angle / (2 * wide)) +
             l.matte * std::max(0.0, n.dot(direction));
    }
    return Vec3::Constant(sum);
  });
}

template <class Shade>
double error_of(const Image& truth, const Shade& shade) {
  double sum = 0;
  double count = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const Vec2 p = disc_of_pixel(x, y, kSize);
      if (p.norm() > 0.98) continue;
      const double d = shade(p) - truth.at(x, y, 0);
      sum += d * d;
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

double lookup(const Image& image, const Vec2& p) {
  const Vec2 pixel = pixel_of_disc(p, kSize);
  Vec3 color;
  sample_bilinear(image, pixel.x(), pixel.y(), {color.data(), 3});
  return color.x();
}

TEST(TurnedLight, IsMuchCloserToTheTruthThanATurnedPictureOrAMirroredSphere) {
  const Image before = rendered(Mat3::Identity());
  DecomposeOptions options;
  options.space = AddUpSpace::linear;
  EditedMatcap matcap = unedited(decompose(before, inscribed_disc(kSize, kSize), options, "sphere"));
  for (const Vec3& axis : {Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0.5, -0.7, 0.5)}) {
    for (const double angle : {15.0, 30.0, 45.0, 60.0}) {
      const Mat3 turn = Eigen::AngleAxisd(radians(angle), axis.normalized()).toRotationMatrix();
      const Image truth = rendered(turn);
      matcap.light = turn;
      const double ours =
          error_of(truth, [&](const Vec2& p) { return evaluate(matcap, normal_on_disc(p)).x(); });
      const Eigen::Rotation2Dd flat(radians(angle));
      const double picture =
          error_of(truth, [&](const Vec2& p) { return lookup(before, flat.inverse() * p); });
      const double mirrored = error_of(truth, [&](const Vec2& p) {
        const Vec3 n = turn.transpose() * normal_on_disc(p);
        return lookup(before, n.head<2>());
      });
      RecordProperty(
          fmt::format("axis_{:.0f}_{:.0f}_{:.0f}_angle_{:.0f}", axis.x(), axis.y(), axis.z(), angle),
          fmt::format("{:.4f} against {:.4f} and {:.4f}", ours, picture, mirrored));
      EXPECT_LT(ours, 0.33 * picture) << axis.transpose() << ", " << angle;
      EXPECT_LT(ours, 0.33 * mirrored) << axis.transpose() << ", " << angle;
    }
  }
}

}  // namespace
}  // namespace sateen::matcap
