// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sateen/core/image.h"

namespace sateen::io {

/// How the colour channels of a picture file are encoded.
enum class Encoding {
  automatic,  ///< integer samples (PNG, JPEG, TIFF) are sRGB, float samples (EXR, HDR, float TIFF) linear
  linear,
  srgb,
};

struct ReadImageOptions {
  Encoding encoding = Encoding::automatic;
  bool allow_non_finite = false;         ///< otherwise a NaN or infinity is an Error that names the pixel
  std::optional<PixelRect> region = {};  ///< read only these pixels; an Error if they leave the picture
  /// 0, or the most pixels along a side: a larger picture is averaged, in linear light, over squares of a
  /// whole number of pixels, those at the right and lower edge less. Plain files never take the memory of
  /// all.
  int most_across = 0;
};

/// What a file says of itself, without decoding its pixels; the size is the one read_image returns.
struct ImageInfo {
  int width = 0;
  int height = 0;
  int channels = 0;
  int bits = 8;           ///< per sample
  bool floating = false;  ///< float samples: linear unless told otherwise
};

/// Extensions of the picture files that can be read, lower case with the dot.
std::span<const std::string> image_extensions();

/// The most pixels of a picture that read_image and read_data keep in memory, for the whole process: larger
/// ones are an Error. 2^28 at first. Those that are read row by row (image_rows.h) have no limit.
void set_max_pixels(std::int64_t pixels);
std::int64_t max_pixels();

/// Throws Error when the file is missing or no picture.
ImageInfo read_image_info(const std::filesystem::path& path);

/// A picture as linear floats with 1 to 4 channels; colour is multiplied by alpha (associated) where there is
/// alpha. Of a file with named layers the first four channels are read. Rotated by EXIF orientation; an EXR
/// is as large as its display window. Colours that the file says are not Rec. 709 or not sRGB (an ICC
/// profile, chromaticities, gamma, the exposure of an HDR) are converted with Encoding::automatic; what
/// cannot be is a warning (warnings.h). Throws Error when the file is missing, truncated, corrupt (a JPEG
/// whose scan breaks off too), animated or CMYK, larger than its bytes can hold, or not finite.
Image read_image(const std::filesystem::path& path, const ReadImageOptions& options = {});

/// A picture that holds data (normals, directions, roughness): samples as stored, integers scaled to [0, 1],
/// no colour conversion and no multiplication by alpha. Throws as read_image.
Image read_data(const std::filesystem::path& path, bool allow_non_finite = false);

/// Writes by extension: .png (8 bit), .jpg, .tif, .webp (without loss) as sRGB, clamped to [0, 1], alpha
/// unassociated; .exr as half (finite values kept within +-65504) and .hdr linear. .jpg and .hdr have no
/// alpha. Atomic. Throws Error for another extension and when the file cannot be written.
void write_image(const std::filesystem::path& path, const Image& image);

/// Throws Error unless write_image could write there now (file.h). Ask before long work.
void check_image_writable(const std::filesystem::path& path);

/// Writes samples as they are: .exr as 32-bit float, .png as 16 bit clamped to [0, 1]. Atomic. Throws as
/// write_image.
void write_data(const std::filesystem::path& path, const Image& image);

/// The same for pictures that belong together: all files appear, or none. One path a picture.
void write_data(std::span<const std::filesystem::path> paths, std::span<const Image> images);

/// One EXR with the channels NAME.R, NAME.G, NAME.B (and .A) for each layer, half float, linear. Atomic.
/// Throws Error when the layers differ in size or the file cannot be written.
struct ImageLayer {
  std::string name;
  Image image;
};
void write_layers(const std::filesystem::path& path, std::span<const ImageLayer> layers);

}  // namespace sateen::io
