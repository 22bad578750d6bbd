// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "sateen/io/picture_sink.h"
#include "sateen/io/picture_source.h"

// One pair a format, each in a file of its own. Opening takes the bytes over and throws Error for a file that
// is none of the kind; creating writes to a stream that outlives the sink, and throws Error for what the
// format cannot hold.
namespace sateen::io {

using SourcePtr = std::unique_ptr<PictureSource>;
using SinkPtr = std::unique_ptr<PictureSink>;

SourcePtr open_png(PictureBytes bytes);
SinkPtr create_png(std::FILE* stream, const std::string& name, const PictureLayout& layout);

SourcePtr open_jpeg(PictureBytes bytes);
SinkPtr create_jpeg(std::FILE* stream, const std::string& name, const PictureLayout& layout);

SourcePtr open_exr(PictureBytes bytes);
SinkPtr create_exr(std::FILE* stream, const std::string& name, const PictureLayout& layout);

/// Radiance RGBE.
SourcePtr open_hdr(PictureBytes bytes);
SinkPtr create_hdr(std::FILE* stream, const std::string& name, const PictureLayout& layout);

/// Null for what few TIFFs are and OpenImageIO knows: odd bit depths, CIE L*a*b* and the like.
SourcePtr open_tiff(PictureBytes bytes);
SinkPtr create_tiff(std::FILE* stream, const std::string& name, const PictureLayout& layout);

SourcePtr open_webp(PictureBytes bytes);
SinkPtr create_webp(std::FILE* stream, const std::string& name, const PictureLayout& layout);

}  // namespace sateen::io
