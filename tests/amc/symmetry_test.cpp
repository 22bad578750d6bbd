// SPDX-License-Identifier: MIT
#include "sateen/amc/symmetry.h"

#include <random>

#include <gtest/gtest.h>

#include "sateen/core/error.h"
#include "support/analytic_material.h"

namespace sateen::amc {
namespace {

using test::analytic_frames;

TEST(Symmetry, FindsTheLargestTurnThatLeavesTheMaterialAlike) {
  for (const int symmetry : {1, 2, 3, 4}) {
    for (const int count : {24, 30, 37}) {
      const SymmetryReport report = analyse_symmetry(analytic_frames(32, count, symmetry));
      EXPECT_EQ(report.symmetry, symmetry) << count << " frames";
      EXPECT_FALSE(report.isotropic);
    }
  }
}

TEST(Symmetry, RecognisesIsotropy) {
  std::vector<AmcFrame> frames;
  for (int i = 0; i < 16; ++i) frames.push_back({test::photograph(32, test::isotropic_colour), i / 16.0});
  const SymmetryReport report = analyse_symmetry(frames);
  EXPECT_TRUE(report.isotropic);
  EXPECT_EQ(report.symmetry, 4);
}

TEST(Symmetry, TwelveEqualTurnsAreStillNotIsotropic) {
  // Alike after every turn that is tried.
  const SymmetryReport report = analyse_symmetry(analytic_frames(16, 96, 12));
  EXPECT_EQ(report.symmetry, 4);
  EXPECT_FALSE(report.isotropic);
}

TEST(Symmetry, ThePeakIsThatOfTheBrightestChannel) {
  std::vector<AmcFrame> frames(2, {Image(8, 8, 3, 0.1f), 0});
  frames[1].angle = 0.5;
  for (AmcFrame& frame : frames) {
    for (int i = 0; i < 64; ++i) frame.image.at(i % 8, i / 8, 1) = 0.4f;
  }
  EXPECT_NEAR(analyse_symmetry(frames).peak, 0.4, 1e-6);
}

TEST(Symmetry, RmseOfAKnownDifferenceAndIndependenceOfExposure) {
  // Frames alternate between two greys a quarter turn apart: turned by 1/4, every pixel differs by 0.2 of a
  // peak of 0.8.
  std::vector<AmcFrame> frames;
  for (int i = 0; i < 4; ++i) frames.push_back({Image(16, 16, 3, i % 2 == 0 ? 0.8f : 0.6f), i / 4.0});
  SymmetryReport report = analyse_symmetry(frames);
  EXPECT_NEAR(report.similarities[3].rmse, 0.25, 1e-6);
  EXPECT_NEAR(report.similarities[3].psnr, 12.0412, 1e-4);  // a quarter of the amplitude
  EXPECT_NEAR(report.similarities[1].rmse, 0, 1e-6);
  EXPECT_NEAR(report.isotropy.rmse, 0.125, 1e-6);
  for (AmcFrame& frame : frames) {
    for (float& v : frame.image.data) v *= 0.01f;
  }
  EXPECT_NEAR(analyse_symmetry(frames).similarities[3].rmse, 0.25, 1e-6);
}

TEST(Symmetry, ReportsHowMuchNoiseAveragingRemoves) {
  // Averaging R frames of independent noise sigma changes each by sigma sqrt(1 - 1/R).
  auto frames = analytic_frames(32, 48, 2);
  std::mt19937 random(7);
  std::normal_distribution<float> noise(0, 0.01f);
  for (AmcFrame& frame : frames) {
    for (float& v : frame.image.data) v += noise(random);
  }
  const SymmetryReport report = analyse_symmetry(frames);
  EXPECT_EQ(report.symmetry, 2);
  EXPECT_NEAR(report.noise_removed * report.peak, 0.01 * std::sqrt(0.5), 0.0005);
}

TEST(Symmetry, BlackFramesAreAnError) {
  std::vector<AmcFrame> frames;
  for (int i = 0; i < 8; ++i) frames.push_back({Image(16, 16, 3), i / 8.0});
  EXPECT_THROW(analyse_symmetry(frames), Error);
}

}  // namespace
}  // namespace sateen::amc
