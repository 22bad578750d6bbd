// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "sateen/io/image_error.h"
#include "sateen/io/picture_source.h"

namespace sateen::io {

/// A picture that OpenImageIO has opened.
class OiioSource final : public PictureSource {
 public:
  /// `kept` are the bytes that `input` reads, where it reads no file.
  OiioSource(const std::string& name, std::unique_ptr<OIIO::ImageInput> input,
             std::vector<std::byte> kept = {},
             std::unique_ptr<OIIO::Filesystem::IOMemReader> memory = nullptr)
      : name_(name), kept_(std::move(kept)), memory_(std::move(memory)), input_(std::move(input)) {
    const OIIO::ImageSpec& spec = input_->spec();
    if (spec.depth > 1) fail(name, "is a volume, a flat picture is needed");
    if (spec.deep) fail(name, "is a deep picture, a flat one is needed");
    if (spec.get_int_attribute("oiio:Movie") != 0 && input_->seek_subimage(1, 0))
      fail(name, "is animated; a still picture is needed");
    input_->seek_subimage(0, 0);
    const std::string space(
        spec.get_string_attribute("jpeg:ColorSpace", spec.get_string_attribute("tiff:ColorSpace")));
    if (space == "CMYK" || space == "YCbCrK") fail(name, "is CMYK; convert it to RGB first");
    if (spec.format.is_signed() && !spec.format.is_floating_point())
      fail(name, "has signed samples; save it with unsigned or float samples");
    read_header(spec);
  }

  /// The whole is decoded by the first read: OpenImageIO 2.4 loses rows of some TIFFs when asked for a few.
  void read(int rows, void* out) override {
    if (whole_.empty()) {
      whole_.resize(header_.row_bytes() * static_cast<std::size_t>(header_.height));
      if (!input_->read_image(0, 0, 0, header_.delivered(), type_, whole_.data()))
        fail(name_, "is truncated or corrupt: " + image_reason(input_->geterror()));
    }
    const std::size_t count = header_.row_bytes() * static_cast<std::size_t>(rows);
    std::copy_n(whole_.data() + done_, count, static_cast<std::byte*>(out));
    done_ += count;
  }

 private:
  void read_header(const OIIO::ImageSpec& spec) {
    header_.width = spec.width;
    header_.height = spec.height;
    header_.channels = spec.nchannels;
    header_.bits = spec.get_int_attribute("oiio:BitsPerSample", static_cast<int>(spec.format.size()) * 8);
    header_.floating = spec.format.is_floating_point();
    const bool wide = header_.floating || spec.format.size() > 2;
    header_.samples = wide ? SampleType::f32 : spec.format.size() == 1 ? SampleType::u8 : SampleType::u16;
    type_ = wide                      ? OIIO::TypeDesc::FLOAT
            : spec.format.size() == 1 ? OIIO::TypeDesc::UINT8
                                      : OIIO::TypeDesc::UINT16;
    header_.alpha = spec.alpha_channel;
    header_.associated = spec.get_int_attribute("oiio:UnassociatedAlpha") == 0;
    header_.orientation = spec.get_int_attribute("Orientation", 1);
    header_.window = {spec.full_x - spec.x, spec.full_y - spec.y, spec.full_width, spec.full_height};
    if (const OIIO::ParamValue* icc = spec.find_attribute("ICCProfile"); icc != nullptr) {
      const auto* bytes = static_cast<const std::byte*>(icc->data());
      header_.colour.icc.assign(bytes, bytes + icc->datasize());
    }
  }

  std::string name_;
  std::vector<std::byte> kept_;
  std::unique_ptr<OIIO::Filesystem::IOMemReader> memory_;
  std::unique_ptr<OIIO::ImageInput> input_;
  OIIO::TypeDesc type_;
  std::vector<std::byte> whole_;
  std::size_t done_ = 0;
};

}  // namespace sateen::io
