// SPDX-License-Identifier: MIT
// What files say of their colours. The light wanted is (0.6, 0.1, 0.05) in linear Rec. 709.
#include <array>
#include <cmath>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lcms2.h>
#include <png.h>

#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "sateen/io/warnings.h"
#include "support/files.h"

namespace sateen::io {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;
using ::testing::HasSubstr;

void expect_light(const fs::path& path, const std::array<float, 3>& light, float tolerance) {
  const Image image = read_image(path);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(image.at(0, 0, c), light[static_cast<std::size_t>(c)], tolerance) << path << c;
}

std::vector<unsigned char> saved(cmsHPROFILE profile) {
  cmsUInt32Number size = 0;
  cmsSaveProfileToMem(profile, nullptr, &size);
  std::vector<unsigned char> bytes(size);
  cmsSaveProfileToMem(profile, bytes.data(), &size);
  cmsCloseProfile(profile);
  return bytes;
}

/// Grey that is the square root of light.
std::vector<unsigned char> grey_profile() {
  cmsToneCurve* square = cmsBuildGamma(nullptr, 2);
  std::vector<unsigned char> bytes = saved(cmsCreateGrayProfile(cmsD50_xyY(), square));
  cmsFreeToneCurve(square);
  return bytes;
}

/// A profile of Display P3's primaries with sRGB's curve.
std::vector<unsigned char> p3_profile() {
  cmsCIExyY white{0.3127, 0.3290, 1};
  cmsCIExyYTRIPLE primaries{{0.680, 0.320, 1}, {0.265, 0.690, 1}, {0.150, 0.060, 1}};
  cmsFloat64Number curve[] = {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045};
  cmsToneCurve* srgb = cmsBuildParametricToneCurve(nullptr, 4, curve);
  cmsToneCurve* curves[] = {srgb, srgb, srgb};
  std::vector<unsigned char> bytes = saved(cmsCreateRGBProfile(&white, &primaries, curves));
  cmsFreeToneCurve(srgb);
  return bytes;
}

/// What a PNG says of its colours.
struct Says {
  std::vector<unsigned char> icc = {};
  double gamma = 0;
  bool p3_chromaticities = false;
  std::vector<unsigned char> cicp = {};
  bool srgb = false;
};

/// One pixel of 16 bits, of one to four channels.
void write_png(const fs::path& path, const std::vector<double>& samples, const Says& says) {
  constexpr std::array kinds{PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                             PNG_COLOR_TYPE_RGB_ALPHA};
  std::FILE* file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, 1, 1, 16, kinds[samples.size() - 1], PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (says.gamma > 0) png_set_gAMA(png, info, says.gamma);
  if (says.p3_chromaticities)
    png_set_cHRM(png, info, 0.3127, 0.3290, 0.680, 0.320, 0.265, 0.690, 0.150, 0.060);
  if (!says.icc.empty()) {
    png_set_iCCP(png, info, "P3", PNG_COMPRESSION_TYPE_BASE, says.icc.data(),
                 static_cast<png_uint_32>(says.icc.size()));
  }
  if (says.srgb) png_set_sRGB(png, info, PNG_sRGB_INTENT_RELATIVE);
  png_write_info(png, info);
  png_byte name[] = "cICP";
  if (!says.cicp.empty()) png_write_chunk(png, name, says.cicp.data(), says.cicp.size());
  png_byte row[8];
  for (std::size_t c = 0; c < samples.size(); ++c) {
    const auto value = static_cast<unsigned>(std::lround(samples[c] * 65535));
    row[2 * c] = static_cast<png_byte>(value >> 8);
    row[2 * c + 1] = static_cast<png_byte>(value & 0xff);
  }
  png_write_row(png, row);
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
}

/// Linear Rec. 709 to linear Display P3, as colour handbooks print it.
std::vector<double> in_p3(const std::vector<double>& v) {
  return {0.822462 * v[0] + 0.177538 * v[1], 0.033194 * v[0] + 0.966806 * v[1],
          0.017083 * v[0] + 0.072397 * v[1] + 0.910520 * v[2]};
}

double srgb(double v) {
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

const std::vector<double> kLight{0.6, 0.1, 0.05};
constexpr std::array<float, 3> kWanted{0.6f, 0.1f, 0.05f};

TEST(StoredColour, ProfilesGammasAndPrimariesOfPngsAreUsed) {
  const TemporaryFolder folder;
  const std::vector<double> p3 = in_p3(kLight);
  const std::vector<double> encoded{srgb(p3[0]), srgb(p3[1]), srgb(p3[2])};
  write_png(folder / "icc.png", encoded, {.icc = p3_profile()});
  write_png(folder / "cicp.png", encoded, {.cicp = {12, 13, 0, 1}});
  write_png(folder / "chrm.png", encoded, {.p3_chromaticities = true});
  write_png(folder / "linear.png", kLight, {.gamma = 1});
  write_png(folder / "power.png", {std::pow(0.6, 1 / 1.8), std::pow(0.1, 1 / 1.8), std::pow(0.05, 1 / 1.8)},
            {.gamma = 1 / 1.8});
  write_png(folder / "srgb.png", {srgb(0.6), srgb(0.1), srgb(0.05)}, {.gamma = 0.45455, .srgb = true});
  write_png(folder / "code.png", kLight, {.cicp = {1, 8, 0, 1}});
  for (const char* name :
       {"icc.png", "cicp.png", "chrm.png", "linear.png", "power.png", "srgb.png", "code.png"})
    expect_light(folder / name, kWanted, 0.001f);
  EXPECT_NEAR(read_data(folder / "icc.png").at(0, 0, 0), encoded[0], 1e-4);  // data stay
  EXPECT_NEAR(read_image(folder / "icc.png", {Encoding::linear}).at(0, 0, 0), encoded[0], 1e-4);
}

TEST(StoredColour, AlphaIsNoColourAndGreyHasProfilesOfItsOwn) {
  const TemporaryFolder folder;
  write_png(folder / "alpha.png", {0.5, 0.5, 0.5, 0.25}, {.gamma = 0.5});
  const Image half = read_image(folder / "alpha.png");
  EXPECT_NEAR(half.at(0, 0, 0), 0.25 * 0.25, 1e-4);  // the light of a quarter, on a quarter of the pixel
  EXPECT_NEAR(half.at(0, 0, 3), 0.25, 1e-4);
  write_png(folder / "grey.png", {0.5}, {.icc = grey_profile()});
  EXPECT_NEAR(read_image(folder / "grey.png").at(0, 0, 0), 0.25, 1e-3);
}

TEST(StoredColour, WhatCannotBeUsedIsAWarning) {
  const TemporaryFolder folder;
  std::vector<std::string> warnings;
  const WarningHandler before =
      set_warning_handler([&](const std::string& text) { warnings.push_back(text); });
  write_png(folder / "pq.png", kLight, {.cicp = {9, 16, 0, 1}});
  read_image(folder / "pq.png");
  read_image(folder / "pq.png");
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("pq.png: its transfer function (code point 16)"));
  read_data(folder / "pq.png");
  EXPECT_EQ(warnings.size(), 1u);
  set_warning_handler(before);
}

TEST(StoredColour, ChromaticitiesOfAnExrAreConverted) {
  const TemporaryFolder folder;
  // ACES AP0, whose white is not D65; the values are (0.6, 0.1, 0.05) by the matrix of the ACES documents.
  std::array<float, 3> values{0.439633f * 0.6f + 0.382989f * 0.1f + 0.177378f * 0.05f,
                              0.089776f * 0.6f + 0.813439f * 0.1f + 0.096784f * 0.05f,
                              0.017541f * 0.6f + 0.111547f * 0.1f + 0.870912f * 0.05f};
  Imf::Header header(1, 1);
  Imf::addChromaticities(
      header, Imf::Chromaticities({0.7347f, 0.2653f}, {0, 1}, {0.0001f, -0.077f}, {0.32168f, 0.33767f}));
  for (const char* c : {"R", "G", "B"}) header.channels().insert(c, Imf::Channel(Imf::FLOAT));
  {
    Imf::OutputFile file((folder / "ap0.exr").c_str(), header);
    Imf::FrameBuffer frame;
    const char* names[] = {"R", "G", "B"};
    for (std::size_t c = 0; c < 3; ++c)
      frame.insert(names[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(&values[c]), 4, 4));
    file.setFrameBuffer(frame);
    file.writePixels(1);
  }
  expect_light(folder / "ap0.exr", kWanted, 0.002f);
  EXPECT_EQ(read_data(folder / "ap0.exr").at(0, 0, 0), values[0]);
}

TEST(StoredColour, ExposureOfAnHdrIsTakenOutAgain) {
  const TemporaryFolder folder;
  const std::string header =
      "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\nEXPOSURE= 2.0\nCOLORCORR=1 2 0.5\n\n-Y 1 +X 1\n";
  std::string bytes = header + std::string("\x80\x80\x80\x81", 4);
  write_text(folder / "a.hdr", bytes);
  expect_light(folder / "a.hdr", {0.25f, 0.125f, 0.5f}, 1e-6f);
  EXPECT_EQ(read_data(folder / "a.hdr").at(0, 0, 0), 1);
}

}  // namespace
}  // namespace sateen::io
