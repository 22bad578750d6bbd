// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <exception>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVersion.h>
#include <OpenEXR/ImfXdr.h>

#include "sateen/io/exr_channels.h"
#include "sateen/io/exr_stream.h"
#include "sateen/io/image_error.h"
#include "sateen/io/picture_codecs.h"

namespace sateen::io {
namespace {

/// What OpenEXR says without the file's name, which stands before it already.
std::string reason(const std::exception& error, const std::string& name) {
  std::string message = error.what();
  const std::string quoted = "\"" + name + "\"";
  if (const std::size_t at = message.find(quoted); at != std::string::npos)
    message.replace(at, quoted.size(), "it");
  return image_reason(message);
}

int extent(int first, int last) {
  return static_cast<int>(std::clamp<std::int64_t>(std::int64_t{last} - first + 1, 0, INT32_MAX));
}

class ExrSource final : public PictureSource {
 public:
  explicit ExrSource(PictureBytes bytes)
      : bytes_(std::move(bytes)), input_(bytes_.name, bytes_.stream.get()) {
    use_exr_threads();
    try {
      // The header alone first: opening a file asks for memory by the numbers in it.
      read_header(first_header());
      check_size(bytes_.name, header_, bytes_.count);
      input_.seekg(0);
      file_.emplace(input_);
      part_.emplace(*file_, 0);
    } catch (const Iex::BaseExc& error) {
      fail(bytes_.name, "cannot be read as a picture: " + reason(error, bytes_.name));
    }
  }

  void read(int rows, void* out) override {
    const std::size_t pixel = names_.size() * sizeof(float);
    const std::size_t row = pixel * static_cast<std::size_t>(header_.width);
    try {
      const int first = top_ + next_;
      Imf::FrameBuffer frame;
      for (std::size_t c = 0; c < names_.size(); ++c) {
        // OpenEXR counts from the pixel at (0, 0), which the rows asked for need not hold.
        char* origin = static_cast<char*>(out) + c * sizeof(float) -
                       std::ptrdiff_t{left_} * static_cast<std::ptrdiff_t>(pixel) -
                       std::ptrdiff_t{first} * static_cast<std::ptrdiff_t>(row);
        frame.insert(names_[c], Imf::Slice(Imf::FLOAT, origin, pixel, row));
      }
      part_->setFrameBuffer(frame);
      part_->readPixels(first, first + rows - 1);
    } catch (const Iex::BaseExc& error) {
      fail(bytes_.name, "is truncated or corrupt: " + reason(error, bytes_.name));
    }
    next_ += rows;
    scale_whole_numbers(static_cast<float*>(out),
                        static_cast<std::size_t>(rows) * static_cast<std::size_t>(header_.width));
  }

 private:
  Imf::Header first_header() {
    check_attributes();
    std::rewind(bytes_.stream.get());
    int magic = 0;
    int version = 0;
    Imf::Xdr::read<Imf::StreamIO>(input_, magic);
    Imf::Xdr::read<Imf::StreamIO>(input_, version);
    if (magic != Imf::MAGIC || Imf::getVersion(version) != Imf::EXR_VERSION)
      throw Iex::InputExc("it is no OpenEXR file of version 2");
    Imf::Header header;
    header.readFrom(input_, version);
    return header;
  }

  /// OpenEXR takes memory for an attribute by the size the file claims.
  void check_attributes() {
    std::FILE* stream = bytes_.stream.get();
    const auto text = [&] {
      std::string result;
      for (int c = std::fgetc(stream); c > 0; c = std::fgetc(stream)) result += static_cast<char>(c);
      return result;
    };
    std::array<unsigned char, 8> start{};
    if (std::fread(start.data(), 1, start.size(), stream) != start.size()) return;
    const bool parts = (start[5] & 0x10) != 0;  // a header for each, and an empty one
    for (bool header = true; header; header = parts) {
      bool empty = true;
      while (!text().empty()) {
        empty = false;
        text();  // its type
        std::array<unsigned char, 4> size{};
        if (std::fread(size.data(), 1, size.size(), stream) != size.size()) return;
        const std::uint64_t claimed = std::uint64_t{size[3]} << 24 |
                                      static_cast<std::uint64_t>(size[2]) << 16 |
                                      static_cast<std::uint64_t>(size[1]) << 8 | size[0];
        const auto at = static_cast<std::uint64_t>(std::ftell(stream));
        if (at + claimed > bytes_.count)
          fail(bytes_.name, "is truncated or corrupt: an attribute reaches past its end");
        std::fseek(stream, static_cast<long>(at + claimed), SEEK_SET);
      }
      if (empty) return;
    }
  }

  void read_header(const Imf::Header& exr) {
    if (exr.hasType() && Imf::isDeepData(exr.type()))
      fail(bytes_.name, "is a deep picture, a flat one is needed");
    const auto& stored = exr.dataWindow();
    const auto& shown = exr.displayWindow();
    left_ = stored.min.x;
    top_ = stored.min.y;
    header_.width = extent(stored.min.x, stored.max.x);
    header_.height = extent(stored.min.y, stored.max.y);
    header_.window = {shown.min.x - stored.min.x, shown.min.y - stored.min.y,
                      extent(shown.min.x, shown.max.x), extent(shown.min.y, shown.max.y)};
    header_.samples = SampleType::f32;
    header_.associated = true;
    read_channels(exr.channels());
    if (Imf::hasChromaticities(exr)) {
      const Imf::Chromaticities& c = Imf::chromaticities(exr);
      header_.colour.chromaticities =
          Chromaticities{{c.red.x, c.red.y, c.green.x, c.green.y, c.blue.x, c.blue.y, c.white.x, c.white.y}};
    }
    if (const auto* turned = exr.findTypedAttribute<Imf::IntAttribute>("Orientation");
        turned != nullptr && turned->value() >= 1 && turned->value() <= 8) {
      header_.orientation = turned->value();
    }
  }

  void read_channels(const Imf::ChannelList& channels) {
    std::vector<std::string> names;
    int bits = 0;
    for (auto c = channels.begin(); c != channels.end(); ++c) {
      if (c.channel().xSampling != 1 || c.channel().ySampling != 1) {
        fail(bytes_.name, fmt::format("its channel {} is subsampled; save it as RGB", c.name()));
      }
      names.emplace_back(c.name());
      bits = std::max(bits, c.channel().type == Imf::HALF ? 16 : 32);
      header_.floating = header_.floating || c.channel().type != Imf::UINT;
    }
    header_.channels = static_cast<int>(names.size());
    header_.bits = bits;
    names = in_picture_order(std::move(names));
    const auto alpha = std::ranges::find_if(names, is_alpha_channel);
    if (alpha != names.end()) header_.alpha = static_cast<int>(alpha - names.begin());
    names.resize(std::min<std::size_t>(names.size(), 4));
    for (const std::string& name : names) whole_.push_back(channels[name].type == Imf::UINT);
    names_ = std::move(names);
  }

  /// Whole numbers stand for 0 to 1, as those of every format.
  void scale_whole_numbers(float* out, std::size_t pixels) const {
    if (std::ranges::find(whole_, true) == whole_.end()) return;
    for (std::size_t i = 0; i < pixels * whole_.size(); ++i) {
      if (whole_[i % whole_.size()]) out[i] *= 1 / 4294967295.0f;
    }
  }

  PictureBytes bytes_;
  ExrInput input_;
  std::optional<Imf::MultiPartInputFile> file_;
  std::optional<Imf::InputPart> part_;
  std::vector<std::string> names_;  ///< of the channels delivered
  std::vector<bool> whole_;         ///< which of them hold whole numbers
  int left_ = 0;                    ///< of the stored pixels
  int top_ = 0;
  int next_ = 0;
};

}  // namespace

SourcePtr open_exr(PictureBytes bytes) {
  return std::make_unique<ExrSource>(std::move(bytes));
}

}  // namespace sateen::io
