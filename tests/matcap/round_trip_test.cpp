// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "sateen/core/colour.h"
#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/light/environment.h"
#include "sateen/matcap/bake.h"
#include "sateen/matcap/decomposition_file.h"
#include "sateen/matcap/edits.h"
#include "sateen/matcap/kept_pixels.h"
#include "sateen/matcap/rim.h"
#include "sateen/matcap/warp.h"
#include "support/matcaps.h"

namespace sateen::matcap {
namespace {

/// decompose, write, read, bake: the largest difference over the sphere, in 1/255 of display values.
double round_trip_error(const Image& picture, const Disc& disc, const DecomposeOptions& options) {
  const test::TemporaryFolder folder;
  write_matcap(folder / "matcap.ktx2", decompose(picture, disc, options, "picture"));
  const Image baked = bake(unedited(read_matcap(folder / "matcap.ktx2")));
  float largest = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (!on_disc(disc, x, y)) continue;
      for (int c = 0; c < 3; ++c) {
        const float difference = srgb_encode(picture.at(x, y, c)) - srgb_encode(baked.at(x, y, c));
        largest = std::max(largest, std::abs(difference));
      }
    }
  }
  return 255.0 * largest;
}

/// The same: PSNR.
double round_trip(const Image& picture, const Disc& disc, const DecomposeOptions& options) {
  const test::TemporaryFolder folder;
  write_matcap(folder / "matcap.ktx2", decompose(picture, disc, options, "picture"));
  const Image baked = bake(unedited(read_matcap(folder / "matcap.ktx2")));
  EXPECT_EQ(baked.width, picture.width);
  EXPECT_EQ(baked.height, picture.height);
  return psnr_on_disc(baked, picture, disc);
}

TEST(RoundTrip, BakingTheUneditedMatCapGivesTheInputBack) {
  for (const char* name : test::kMatcaps) {
    EXPECT_GT(round_trip(test::example_matcap(name, 256), inscribed_disc(256, 256), {}), 50) << name;
  }
  DecomposeOptions linear;
  linear.space = AddUpSpace::linear;
  EXPECT_GT(round_trip(test::example_matcap("jade", 128), inscribed_disc(128, 128), linear), 50);
}

TEST(RoundTrip, IsWithinOneStepOf8BitsInEveryPixel) {
  for (const char* name : test::kMatcaps) {
    EXPECT_LT(round_trip_error(test::example_matcap(name, 256), inscribed_disc(256, 256), {}), 1) << name;
  }
  // Fine rings around the rim of a mirror: they fall on few texels around the view axis' far end.
  const Image rings = test::sphere_picture(192, [](const Vec3& n) -> Vec3 {
    const double azimuth = std::atan2(n.y(), n.x());
    return Vec3::Constant(0.4 + 0.3 * std::sin(60 * azimuth) * std::max(0.0, 0.5 - n.z()));
  });
  EXPECT_LT(round_trip_error(rings, inscribed_disc(192, 192), {}), 1);
}

TEST(KeptPixels, AreReadBackAndNonsenseIsRefused) {
  const std::vector<KeptPixel> pixels{{3, {0.25F, 0.5F, 1e6F}}, {11, {0, 1, 2}}};
  const std::string text = text_of_pixels(pixels);
  const std::vector<KeptPixel> read = pixels_of_text(text, 12);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].index, 3U);
  EXPECT_EQ(read[0].colour, Vec3f(0.25F, 0.5F, 65504));
  EXPECT_EQ(read[1].colour, pixels[1].colour);
  EXPECT_THROW(pixels_of_text(text, 11), Error);
  EXPECT_THROW(pixels_of_text(text.substr(1), 12), Error);
  EXPECT_THROW(pixels_of_text("0000000x000000000000", 12), Error);
  EXPECT_THROW(pixels_of_text("000000007c0000000000", 12), Error);  // infinite
}

// Kept pixels are of the input's size; baking at another wrote outside the picture or drew ghosts.
TEST(RoundTrip, AnotherSizeIsThePictureAtThatSize) {
  const Image picture = test::example_matcap("lead", 96);
  MatcapDecomposition matcap = decompose(picture, inscribed_disc(96, 96), {}, "lead");
  ASSERT_FALSE(matcap.kept.pixels.empty());
  for (const int size : {32, 95, 97, 192}) {
    matcap.width = matcap.height = size;
    matcap.disc = inscribed_disc(size, size);
    const Image baked = bake(unedited(matcap));
    MatcapDecomposition bare = matcap;
    bare.kept = {};
    EXPECT_EQ(baked.data, bake(unedited(bare)).data) << size;
  }
  matcap.width = matcap.height = 96;
  matcap.disc = inscribed_disc(96, 96);
  EXPECT_GT(psnr_on_disc(bake(unedited(matcap)), picture, matcap.disc), 60);
}

TEST(RoundTrip, HoldsForASphereSomewhereInAPictureAndForGrain) {
  const Disc disc{61.5, 40, 33.25};
  Image picture(120, 90, 3);
  unsigned state = 9;
  for (float& v : picture.data) {
    state = state * 1664525U + 1013904223U;
    v = 0.3F + 0.3F * static_cast<float>(state >> 8) / 16777216.0F;
  }
  DecomposeOptions options;
  options.map_size = 128;
  EXPECT_GT(round_trip(picture, disc, options), 45);
}

/// The part of a pixel that the disc covers.
double coverage(const Disc& disc, int x, int y) {
  int inside = 0;
  for (int j = 0; j < 8; ++j) {
    for (int i = 0; i < 8; ++i)
      inside += disc_point(disc, x + (i + 0.5) / 8, y + (j + 0.5) / 8).squaredNorm() < 1 ? 1 : 0;
  }
  return inside / 64.0;
}

// A sphere drawn on black: the steps of its edge must not turn with the light.
TEST(RoundTrip, TheEdgeOfADrawnSphereComesBackButDoesNotTurn) {
  constexpr int kWidth = 192;
  const Disc disc = inscribed_disc(kWidth, kWidth);
  const Image clean = test::sphere_picture(kWidth, [](const Vec3& n) -> Vec3 {
    return {0.5 + 0.2 * n.x(), 0.5 - 0.2 * n.y(), 0.4 + 0.2 * n.x() * n.y()};
  });
  Image drawn = clean;
  for (int y = 0; y < kWidth; ++y) {
    for (int x = 0; x < kWidth; ++x)
      drawn.set_rgb(x, y, clean.rgb(x, y) * static_cast<float>(coverage(disc, x, y)));
  }
  EXPECT_GT(round_trip(drawn, disc, {}), 50);
  const MatcapDecomposition without = decompose(clean, disc, {}, "clean");
  const MatcapDecomposition with = decompose(drawn, disc, {}, "drawn");
  // The edge's pixels and no others are kept.
  EXPECT_TRUE(without.kept.pixels.empty());
  ASSERT_FALSE(with.kept.pixels.empty());
  for (const KeptPixel& pixel : with.kept.pixels) {
    EXPECT_TRUE(
        on_rim(disc, 2, static_cast<int>(pixel.index) % kWidth, static_cast<int>(pixel.index) / kWidth));
  }
  for (const Vec3& angles : {Vec3(kPi / 4, 0, 0), Vec3(0, kPi / 2, 0)}) {
    const std::vector<Edit> turn{Turn{angles}};
    const Image expected = bake(apply_edits(without, turn));
    const Image turned = bake(apply_edits(with, turn));
    float worst = 0;
    for (int y = 0; y < kWidth; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        if (on_disc(disc, x, y))
          worst = std::max(worst, (turned.rgb(x, y) - expected.rgb(x, y)).cwiseAbs().maxCoeff());
      }
    }
    EXPECT_LT(worst, 0.06F) << angles;  // the edge is darker by up to 0.7
    // Nor do they stay where they were under light that is turned without an edit.
    EditedMatcap live = unedited(with);
    live.light = rotation_xyz(angles);
    EXPECT_EQ(bake(live).data, turned.data);
  }
}

TEST(RoundTrip, BeyondTheRimIsWhatWasSeenWithinIt) {
  const EditedMatcap matcap =
      unedited(decompose(test::example_matcap("jade", 64), inscribed_disc(64, 64), {}, "jade"));
  const double rim = (1 - 0.5 / 32) * std::sqrt(0.5);
  const Vec3f expected = evaluate(matcap, normal_on_disc({rim, rim})).cast<float>();
  EXPECT_LT((bake(matcap).rgb(63, 0) - expected).norm(), 1e-6F);
}

TEST(RoundTrip, BlackPicturesStayBlack) {
  const Image black(64, 64, 3);
  const Disc disc = inscribed_disc(64, 64);
  const MatcapDecomposition matcap = decompose(black, disc, {}, "black");
  EXPECT_EQ(matcap[Part::low].base_color, Vec3(1, 1, 1));
  for (const float v : bake(unedited(matcap)).data) EXPECT_EQ(v, 0);
}

TEST(RoundTrip, SpheresTooLargeForMapsAreShrunkFirst) {
  const Image large = test::example_matcap("lead", 128);
  DecomposeOptions options;
  options.largest_radius = 40;
  options.regions[1] = {{84, 30, 4, 4}};
  const MatcapDecomposition matcap = decompose(large, inscribed_disc(128, 128), options, "large");
  EXPECT_EQ(matcap.width, 128);
  EXPECT_EQ(matcap.disc.radius, 64);
  EXPECT_EQ(matcap[Part::low].map.levels.front().size(), 80);
  EXPECT_NEAR(matcap[Part::high].regions[0].x, 84, 2);
  EXPECT_GT(psnr_on_disc(bake(unedited(matcap)), large, matcap.disc), 35);
}

TEST(Layers, AddUpToThePictureInLinearLight) {
  const Image picture = test::example_matcap("carpaint", 96);
  const EditedMatcap matcap = unedited(decompose(picture, inscribed_disc(96, 96), {}, "carpaint"));
  const Image whole = bake(matcap);
  const auto layers = bake_layers(matcap);
  for (std::size_t i = 0; i < whole.data.size(); ++i) {
    EXPECT_NEAR(layers[0].data[i] + layers[1].data[i], whole.data[i], 1e-5F * (1 + whole.data[i]));
  }
}

TEST(Environment, ShowsTheLightAMirrorWouldSee) {
  const Vec3 lamp = test::direction_at(0.4, 1.2);  // the normal that shows it
  const Image picture = test::sphere_picture(128, [&](const Vec3& n) -> Vec3 {
    const double angle = test::angle_between(n, lamp);
    return Vec3::Constant(std::exp(-angle * angle / 0.004));
  });
  DecomposeOptions options;
  options.space = AddUpSpace::linear;
  EditedMatcap matcap = unedited(decompose(picture, inscribed_disc(128, 128), options, "lamp"));
  float most = -1;
  const auto brightest = [&] {
    const Image environment = bake_environment(matcap, Part::high, 128);
    Vec3 direction = Vec3::Zero();
    most = -1;
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 256; ++x) {
        if (environment.at(x, y, 0) <= most) continue;
        most = environment.at(x, y, 0);
        direction = direction_of_environment(x, y, 128);
      }
    }
    return direction;
  };
  const Vec3 shown = warp(lamp, matcap.matcap[Part::high].slope());
  EXPECT_LT(test::angle_between(brightest(), shown), 0.05);
  const float before = most;
  matcap.light = rotation_xyz({0.3, 0.6, 0});
  matcap.look(Part::high).intensity = 2;
  EXPECT_LT(test::angle_between(brightest(), matcap.light * shown), 0.05);
  EXPECT_NEAR(most / before, 2, 0.1);
  // As environment maps of lit scenes are looked up.
  for (const int x : {0, 100, 128, 200}) {
    for (const int y : {3, 64}) {
      EXPECT_LT((direction_of_environment(x, y, 128) -
                 light::environment_direction({(x + 0.5) / 256, (y + 0.5) / 128}))
                    .norm(),
                1e-12);
    }
  }
}

}  // namespace
}  // namespace sateen::matcap
