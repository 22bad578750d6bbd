// SPDX-License-Identifier: MIT
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <half.h>

#include "sateen/io/exr_stream.h"
#include "sateen/io/image_error.h"
#include "sateen/io/picture_codecs.h"

namespace sateen::io {
namespace {

Imf::Header header_of(const PictureLayout& layout) {
  Imf::Header header(layout.width, layout.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  header.insert("software", Imf::StringAttribute("Sateen"));
  const Imf::PixelType type = layout.samples == RowSamples::f16 ? Imf::HALF : Imf::FLOAT;
  for (const std::string& name : layout.channels) header.channels().insert(name, Imf::Channel(type));
  return header;
}

class ExrSink final : public PictureSink {
 public:
  ExrSink(std::FILE* stream, const std::string& name, const PictureLayout& layout)
      : name_(name), layout_(layout), output_(name, stream) {
    use_exr_threads();
    guarded([&] { file_.emplace(output_, header_of(layout)); });
  }

  void write(int rows, const float* samples) override {
    if (layout_.samples == RowSamples::f16) {
      halves_.assign(samples, samples + layout_.row_samples() * static_cast<std::size_t>(rows));
      write_rows(rows, Imf::HALF, reinterpret_cast<const char*>(halves_.data()), sizeof(half));
    } else {
      write_rows(rows, Imf::FLOAT, reinterpret_cast<const char*>(samples), sizeof(float));
    }
  }

  void finish() override {
    guarded([&] { file_.reset(); });
    if (!output_.whole()) fail(name_, "cannot be written: " + output_.fault());
  }

 private:
  template <class Work>
  void guarded(const Work& work) {
    try {
      work();
    } catch (const Iex::BaseExc& error) {
      fail(name_, "cannot be written: " + image_reason(error.what()));
    }
  }

  void write_rows(int rows, Imf::PixelType type, const char* samples, std::size_t bytes) {
    const std::size_t pixel = layout_.channels.size() * bytes;
    const std::size_t row = pixel * static_cast<std::size_t>(layout_.width);
    guarded([&] {
      Imf::FrameBuffer frame;
      for (std::size_t c = 0; c < layout_.channels.size(); ++c) {
        // OpenEXR counts from row 0, and does not write where its slices point.
        char* origin =
            const_cast<char*>(samples) + c * bytes - std::ptrdiff_t{next_} * static_cast<std::ptrdiff_t>(row);
        frame.insert(layout_.channels[c], Imf::Slice(type, origin, pixel, row));
      }
      file_->setFrameBuffer(frame);
      file_->writePixels(rows);
    });
    next_ += rows;
  }

  std::string name_;
  PictureLayout layout_;
  ExrOutput output_;  // outlives `file_`, which writes to it
  std::optional<Imf::OutputFile> file_;
  std::vector<half> halves_;
  int next_ = 0;
};

}  // namespace

SinkPtr create_exr(std::FILE* stream, const std::string& name, const PictureLayout& layout) {
  return std::make_unique<ExrSink>(stream, name, layout);
}

}  // namespace sateen::io
