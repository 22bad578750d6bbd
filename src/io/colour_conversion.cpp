// SPDX-License-Identifier: MIT
#include "sateen/io/colour_conversion.h"

#include <Eigen/LU>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <lcms2.h>

#include "sateen/core/colour.h"
#include "sateen/core/parallel.h"
#include "sateen/io/warnings.h"

namespace sateen::io {
namespace {

using Matrix3 = Eigen::Matrix3d;

/// CIE XYZ of a chromaticity at Y = 1; of one with y = 0, up to a factor.
Eigen::Vector3d xyz(double x, double y) {
  return y == 0 ? Eigen::Vector3d(x, 0, 1 - x) : Eigen::Vector3d(x / y, 1, (1 - x - y) / y);
}

/// From red, green and blue of these primaries to XYZ, white being (1, 1, 1).
Matrix3 to_xyz(const Chromaticities& c) {
  Matrix3 primaries;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(2 * i);
    primaries.col(i) = xyz(c.xy[at], c.xy[at + 1]);
  }
  const Eigen::Vector3d amounts = primaries.inverse() * xyz(c.xy[6], c.xy[7]);
  return primaries * amounts.asDiagonal();
}

/// White stays white: Bradford's adaptation, as ICC does it.
Matrix3 to_rec709(const Chromaticities& from) {
  Matrix3 bradford;
  bradford << 0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296;
  const Eigen::Vector3d here = bradford * xyz(from.xy[6], from.xy[7]);
  const Eigen::Vector3d there = bradford * xyz(kRec709.xy[6], kRec709.xy[7]);
  const Matrix3 adapted = bradford.inverse() * there.cwiseQuotient(here).asDiagonal() * bradford;
  return to_xyz(kRec709).inverse() * adapted * to_xyz(from);
}

bool nearly_rec709(const Chromaticities& c) {
  for (std::size_t i = 0; i < c.xy.size(); ++i) {
    if (std::abs(c.xy[i] - kRec709.xy[i]) > 0.001) return false;
  }
  return true;
}

bool usable(const Chromaticities& c) {
  const double determinant = to_xyz(c).determinant();
  return std::isfinite(determinant) && std::abs(determinant) > 1e-9;
}

/// Encoded PNGs: a gamma of 1 / 0.45455 is how programs say sRGB where they have but one number.
bool nearly_srgb(double gamma) {
  return std::abs(gamma - 2.2) < 0.01;
}

void apply(const Matrix3& matrix, Image& image) {
  if (image.channels < 3) return;
  parallel_for(image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      const Vec3 rgb = image.rgb(x, y).cast<double>();
      image.set_rgb(x, y, (matrix * rgb).cast<float>());
    }
  });
}

struct Close {
  void operator()(void* profile) const { cmsCloseProfile(profile); }
};
using Profile = std::unique_ptr<void, Close>;

/// sRGB's primaries without its curve: grey or RGB floats, unbounded.
Profile linear_rec709() {
  cmsCIExyY white{0.3127, 0.3290, 1};
  cmsCIExyYTRIPLE primaries{{0.64, 0.33, 1}, {0.30, 0.60, 1}, {0.15, 0.06, 1}};
  const std::unique_ptr<cmsToneCurve, decltype(&cmsFreeToneCurve)> line(cmsBuildGamma(nullptr, 1),
                                                                        cmsFreeToneCurve);
  cmsToneCurve* curves[] = {line.get(), line.get(), line.get()};
  return Profile(cmsCreateRGBProfile(&white, &primaries, curves));
}

/// By Little CMS, relative colorimetric; false when the profile is broken or for another kind of picture.
bool apply_profile(const std::vector<std::byte>& icc, Image& image) {
  const Profile from(cmsOpenProfileFromMem(icc.data(), static_cast<cmsUInt32Number>(icc.size())));
  if (!from) return false;
  const bool grey = image.channels < 3;
  if (cmsGetColorSpace(from.get()) != (grey ? cmsSigGrayData : cmsSigRgbData)) return false;
  const Profile to = linear_rec709();
  const std::unique_ptr<void, decltype(&cmsDeleteTransform)> transform(
      cmsCreateTransform(from.get(), grey ? TYPE_GRAY_FLT : TYPE_RGB_FLT, to.get(), TYPE_RGB_FLT,
                         INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_NOCACHE | cmsFLAGS_NOOPTIMIZE),
      cmsDeleteTransform);
  if (!transform) return false;
  const auto width = static_cast<std::size_t>(image.width);
  const auto channels = static_cast<std::size_t>(image.channels);
  const std::size_t colours = grey ? 1 : 3;
  parallel_for(image.height, [&](int y) {
    std::vector<float> in(width * colours);
    std::vector<float> out(width * 3);
    float* row = image.pixel(0, y).data();
    for (std::size_t x = 0; x < width; ++x) {
      for (std::size_t c = 0; c < colours; ++c) in[x * colours + c] = row[x * channels + c];
    }
    cmsDoTransform(transform.get(), in.data(), out.data(), static_cast<cmsUInt32Number>(width));
    for (std::size_t x = 0; x < width; ++x) {
      for (std::size_t c = 0; c < colours; ++c) row[x * channels + c] = out[x * 3 + c];
    }
  });
  return true;
}

void decode(Image& image, double gamma) {
  const auto channels = static_cast<std::size_t>(image.channels);
  const std::size_t colours = channels - (channels % 2 == 0 ? 1 : 0);
  parallel_for(image.height, [&](int y) {
    float* row = image.pixel(0, y).data();
    for (std::size_t i = 0; i < static_cast<std::size_t>(image.width) * channels; ++i) {
      if (i % channels < colours) row[i] = std::pow(std::max(row[i], 0.0f), static_cast<float>(gamma));
    }
  });
}

void multiply(Image& image, const std::array<double, 3>& scale) {
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.data.size(); ++i) {
    const std::size_t c = i % channels;
    if (c < 3) image.data[i] *= static_cast<float>(scale[c]);
  }
}

}  // namespace

bool says_other_colours(const PictureHeader& header) {
  const StoredColour& colour = header.colour;
  if (!colour.ignored.empty() || colour.scale) return true;
  if (colour.srgb) return false;
  return !colour.icc.empty() || (colour.gamma && !nearly_srgb(*colour.gamma)) ||
         (colour.chromaticities && !nearly_rec709(*colour.chromaticities));
}

Image to_linear_rec709(Image stored, const PictureHeader& header, const std::string& name) {
  const StoredColour& colour = header.colour;
  for (const std::string& what : colour.ignored) warn(fmt::format("{}: its {} is not used", name, what));
  Image image = std::move(stored);
  const bool integer = !header.floating;
  if (!colour.icc.empty() && !colour.srgb) {
    if (apply_profile(colour.icc, image)) return image;
    warn(fmt::format("{}: its ICC profile cannot be used; its colours are taken for {}", name,
                     integer ? "sRGB" : "linear Rec. 709"));
  }
  if (integer && colour.gamma && !colour.srgb && !nearly_srgb(*colour.gamma)) {
    decode(image, *colour.gamma);
  } else if (integer) {
    image = srgb_decoded(std::move(image));
  }
  if (colour.chromaticities && !colour.srgb && !nearly_rec709(*colour.chromaticities)) {
    if (usable(*colour.chromaticities)) {
      apply(to_rec709(*colour.chromaticities), image);
    } else {
      warn(fmt::format("{}: its chromaticities span no colours; they are taken for Rec. 709", name));
    }
  }
  if (colour.scale) multiply(image, *colour.scale);
  return image;
}

}  // namespace sateen::io
