// SPDX-License-Identifier: MIT
#include "sateen/io/modules/film/frame_converter.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <fmt/format.h>

#include "sateen/io/file_error.h"
#include "sateen/io/stored_colour.h"

namespace sateen::io {
namespace {

constexpr double kLargestAspect = 8;

std::string name_of(const char* name) {
  return name == nullptr ? "unknown" : name;
}

/// sRGB's transfer function is what Picture8 stands for; others that displays show alike need no conversion.
void require_display_transfer(AVColorTransferCharacteristic transfer, const std::string& film) {
  switch (transfer) {
    case AVCOL_TRC_RESERVED0:
    case AVCOL_TRC_RESERVED:
    case AVCOL_TRC_UNSPECIFIED:
    case AVCOL_TRC_BT709:
    case AVCOL_TRC_GAMMA22:
    case AVCOL_TRC_GAMMA28:
    case AVCOL_TRC_SMPTE170M:
    case AVCOL_TRC_SMPTE240M:
    case AVCOL_TRC_IEC61966_2_4:
    case AVCOL_TRC_BT1361_ECG:
    case AVCOL_TRC_IEC61966_2_1:
    case AVCOL_TRC_BT2020_10:
    case AVCOL_TRC_BT2020_12:
      return;
    case AVCOL_TRC_ARIB_STD_B67:
    case AVCOL_TRC_SMPTE2084:
      fail(film, fmt::format("is an HDR film ({}), whose light 8 bits cannot hold; switch HDR off for the "
                             "recording (iPhone: Settings > Camera > Record Video > HDR Video) or have a "
                             "video editor turn it into SDR (BT.709)",
                             transfer == AVCOL_TRC_SMPTE2084 ? "PQ" : "HLG"));
    default:
      fail(film, fmt::format("has the transfer function {}, which is not read; turn it into BT.709",
                             name_of(av_color_transfer_name(transfer))));
  }
}

/// The scaler's number of a matrix.
int matrix_of(const AVFrame& frame, const std::string& film) {
  switch (frame.colorspace) {
    case AVCOL_SPC_RGB:  // no matrix, so any will do
    case AVCOL_SPC_BT709:
      return SWS_CS_ITU709;
    case AVCOL_SPC_FCC:
      return SWS_CS_FCC;
    case AVCOL_SPC_BT470BG:
    case AVCOL_SPC_SMPTE170M:
      return SWS_CS_ITU601;
    case AVCOL_SPC_SMPTE240M:
      return SWS_CS_SMPTE240M;
    case AVCOL_SPC_BT2020_NCL:
      return SWS_CS_BT2020;
    case AVCOL_SPC_UNSPECIFIED:
    case AVCOL_SPC_RESERVED:
      return frame.height >= 720 ? SWS_CS_ITU709 : SWS_CS_ITU601;
    default:
      fail(film, fmt::format("has the colour matrix {}, which is not read; turn it into BT.709",
                             name_of(av_color_space_name(frame.colorspace))));
  }
}

/// The same samples under the name that leaves their range to be told beside it.
AVPixelFormat without_range(AVPixelFormat format) {
  switch (format) {
    case AV_PIX_FMT_YUVJ411P:
      return AV_PIX_FMT_YUV411P;
    case AV_PIX_FMT_YUVJ420P:
      return AV_PIX_FMT_YUV420P;
    case AV_PIX_FMT_YUVJ422P:
      return AV_PIX_FMT_YUV422P;
    case AV_PIX_FMT_YUVJ440P:
      return AV_PIX_FMT_YUV440P;
    case AV_PIX_FMT_YUVJ444P:
      return AV_PIX_FMT_YUV444P;
    default:
      return format;
  }
}

/// Where chroma samples lie; unsaid, H.264 and its like have them at the left edge of their pixels.
std::array<int, 2> chroma_position(AVChromaLocation location) {
  switch (location) {
    case AVCHROMA_LOC_CENTER:
      return {128, 128};
    case AVCHROMA_LOC_TOPLEFT:
      return {0, 0};
    case AVCHROMA_LOC_TOP:
      return {128, 0};
    case AVCHROMA_LOC_BOTTOMLEFT:
      return {0, 256};
    case AVCHROMA_LOC_BOTTOM:
      return {128, 256};
    default:
      return {0, 128};
  }
}

Eigen::Vector3d xyz(double x, double y) {
  return {x / y, 1, (1 - x - y) / y};
}

/// Linear R, G, B to CIE XYZ with the white at Y = 1.
Eigen::Matrix3d to_xyz(const Chromaticities& c) {
  Eigen::Matrix3d primaries;
  primaries << xyz(c.xy[0], c.xy[1]), xyz(c.xy[2], c.xy[3]), xyz(c.xy[4], c.xy[5]);
  const Eigen::Vector3d scale = primaries.inverse() * xyz(c.xy[6], c.xy[7]);
  return primaries * scale.asDiagonal();
}

double srgb_to_linear(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}
double linear_to_srgb(double v) {
  return v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

/// From wider primaries with a D65 white to Rec. 709's, in linear light; what lies outside is clipped.
class PrimariesConversion {
 public:
  explicit PrimariesConversion(const Chromaticities& from)
      : matrix_((to_xyz(kRec709).inverse() * to_xyz(from)).cast<float>()), encoded_(kSteps + 1) {
    for (std::size_t i = 0; i < linear_.size(); ++i)
      linear_[i] = static_cast<float>(srgb_to_linear(static_cast<double>(i) / 255));
    for (std::size_t i = 0; i < encoded_.size(); ++i) {
      encoded_[i] = static_cast<std::uint8_t>(
          std::lround(255 * linear_to_srgb(static_cast<double>(i) / static_cast<double>(kSteps))));
    }
  }

  void apply(std::vector<std::uint8_t>& rgb) const {
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
      const Eigen::Vector3f light =
          matrix_ * Eigen::Vector3f(linear_[rgb[i]], linear_[rgb[i + 1]], linear_[rgb[i + 2]]);
      for (std::size_t c = 0; c < 3; ++c) {
        const float v = std::clamp(light[static_cast<Eigen::Index>(c)], 0.0F, 1.0F);
        rgb[i + c] = encoded_[static_cast<std::size_t>(std::lround(v * static_cast<float>(kSteps)))];
      }
    }
  }

 private:
  static constexpr std::size_t kSteps = 1 << 14;  // a quarter of a code at the steepest, near black

  Eigen::Matrix3f matrix_;
  std::array<float, 256> linear_{};
  std::vector<std::uint8_t> encoded_;  // by linear light
};

/// Null where a film's primaries are near enough to Rec. 709's to be shown as they are.
const PrimariesConversion* conversion_from(AVColorPrimaries primaries) {
  static const PrimariesConversion bt2020(
      Chromaticities{{0.708, 0.292, 0.170, 0.797, 0.131, 0.046, 0.3127, 0.3290}});
  static const PrimariesConversion display_p3(
      Chromaticities{{0.680, 0.320, 0.265, 0.690, 0.150, 0.060, 0.3127, 0.3290}});
  if (primaries == AVCOL_PRI_BT2020) return &bt2020;
  if (primaries == AVCOL_PRI_SMPTE432) return &display_p3;
  return nullptr;
}

/// Puts the green, blue and red plane together, turned. In tiles: across, neighbours lie a row apart.
void assemble(const AVFrame& planes, const Turn& turn, Picture8& picture) {
  const std::ptrdiff_t row = planes.linesize[0];  // of all three
  const std::ptrdiff_t right = turn.xx + turn.yx * row;
  const std::ptrdiff_t down = turn.xy + turn.yy * row;
  const std::ptrdiff_t origin = (turn.xx + turn.xy < 0 ? planes.width - 1 : 0) +
                                (turn.yx + turn.yy < 0 ? (planes.height - 1) * row : 0);
  const std::uint8_t* const green = planes.data[0] + origin;
  const std::uint8_t* const blue = planes.data[1] + origin;
  const std::uint8_t* const red = planes.data[2] + origin;
  constexpr int kTile = 64;
  for (int top = 0; top < picture.height; top += kTile) {
    for (int left = 0; left < picture.width; left += kTile) {
      const int end_y = std::min(top + kTile, picture.height);
      const int end_x = std::min(left + kTile, picture.width);
      for (int y = top; y < end_y; ++y) {
        std::uint8_t* out = picture.rgb.data() + (static_cast<std::ptrdiff_t>(y) * picture.width + left) * 3;
        std::ptrdiff_t at = y * down + left * right;
        for (int x = left; x < end_x; ++x, at += right, out += 3) {
          out[0] = red[at];
          out[1] = green[at];
          out[2] = blue[at];
        }
      }
    }
  }
}

}  // namespace

std::optional<Turn> turn_of(const std::int32_t* matrix) {
  if (matrix == nullptr) return Turn{};
  // A stored (p, q) is shown at (a p + c q, b p + d q); Turn is the way back, the transpose.
  const double a = matrix[0];
  const double b = matrix[1];
  const double c = matrix[3];
  const double d = matrix[4];
  const double upright = std::min(std::abs(a), std::abs(d));
  const double across = std::min(std::abs(b), std::abs(c));
  const double off_upright = std::max(std::abs(b), std::abs(c));
  const double off_across = std::max(std::abs(a), std::abs(d));
  constexpr double kSlight = 0.01;
  const auto sign = [](double v) { return v < 0 ? -1 : 1; };
  if (off_upright == 0 && off_across == 0) return Turn{};  // some recorders leave the matrix empty
  if (off_upright <= kSlight * upright) return Turn{sign(a), 0, 0, sign(d)};
  if (off_across <= kSlight * across) return Turn{0, sign(b), sign(c), 0};
  return std::nullopt;
}

bool FrameConverter::Layout::operator==(const Layout& other) const {
  const auto same = [](FrameSize a, FrameSize b) { return a.width == b.width && a.height == b.height; };
  return same(stored, other.stored) && same(square, other.square) && format == other.format &&
         full_range == other.full_range && matrix == other.matrix && chroma == other.chroma;
}

void FrameConverter::require_known_colours(const AVFrame& frame) const {
  require_display_transfer(frame.color_trc, name_);
  matrix_of(frame, name_);
}

FrameSize FrameConverter::size(const AVFrame& frame, AVRational pixel_aspect, const Turn& turn) const {
  FrameSize square{frame.width, frame.height};
  if (pixel_aspect.num > 0 && pixel_aspect.den > 0) {
    const double aspect = av_q2d(pixel_aspect);
    if (aspect > kLargestAspect || aspect < 1 / kLargestAspect) {
      fail(name_,
           fmt::format("has the pixel aspect {}:{}, which no camera has; set the right one with ffmpeg "
                       "-aspect",
                       pixel_aspect.num, pixel_aspect.den));
    }
    // The longer side grows, so that nothing is lost.
    if (aspect > 1) square.width = static_cast<int>(std::lround(frame.width * aspect));
    if (aspect < 1) square.height = static_cast<int>(std::lround(frame.height / aspect));
  }
  if (turn.across()) std::swap(square.width, square.height);
  return square;
}

FrameConverter::Layout FrameConverter::layout_of(const AVFrame& frame, AVRational pixel_aspect) const {
  require_known_colours(frame);
  Layout layout;
  layout.stored = {frame.width, frame.height};
  layout.square = size(frame, pixel_aspect, Turn{});
  const auto format = static_cast<AVPixelFormat>(frame.format);
  layout.format = without_range(format);
  layout.full_range = layout.format != format || frame.color_range == AVCOL_RANGE_JPEG;
  layout.matrix = matrix_of(frame, name_);
  layout.chroma = chroma_position(frame.chroma_location);
  return layout;
}

void FrameConverter::prepare(const Layout& layout) {
  const auto refuse = [&] {
    fail(name_, fmt::format("its frames cannot be converted to RGB: {} x {}, {}", layout.stored.width,
                            layout.stored.height, name_of(av_get_pix_fmt_name(layout.format))));
  };
  if (sws_isSupportedInput(layout.format) == 0) refuse();
  scaler_.reset(allocated(sws_alloc_context()));
  SwsContext* scaler = scaler_.get();
  const auto set = [&](const char* option, std::int64_t value) {
    if (av_opt_set_int(scaler, option, value, 0) < 0) refuse();
  };
  set("srcw", layout.stored.width);
  set("srch", layout.stored.height);
  set("src_format", layout.format);
  set("dstw", layout.square.width);
  set("dsth", layout.square.height);
  set("dst_format", AV_PIX_FMT_GBRP);
  set("src_range", layout.full_range ? 1 : 0);
  set("dst_range", 1);
  // Without these the scaler takes short cuts that are off by several codes, and by other ones on every
  // processor.
  set("sws_flags", SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT | SWS_FULL_CHR_H_INP | SWS_BITEXACT);
  set("threads", threads_);
  const AVPixFmtDescriptor* described = av_pix_fmt_desc_get(layout.format);
  if (described->log2_chroma_w > 0) set("src_h_chr_pos", layout.chroma[0]);
  if (described->log2_chroma_h > 0) set("src_v_chr_pos", layout.chroma[1]);
  if (sws_init_context(scaler, nullptr, nullptr) < 0) refuse();
  const int* matrix = sws_getCoefficients(layout.matrix);
  constexpr int kOne = 1 << 16;
  // Refused for RGB, which needs none of it.
  sws_setColorspaceDetails(scaler, matrix, layout.full_range ? 1 : 0, matrix, 1, 0, kOne, kOne);

  planes_.reset(allocated(av_frame_alloc()));
  planes_->width = layout.square.width;
  planes_->height = layout.square.height;
  planes_->format = AV_PIX_FMT_GBRP;
  if (av_frame_get_buffer(planes_.get(), 0) < 0) throw std::bad_alloc();
  layout_ = layout;
}

void FrameConverter::convert(const AVFrame& frame, AVRational pixel_aspect, const Turn& turn,
                             Picture8& picture) {
  const Layout layout = layout_of(frame, pixel_aspect);
  if (!scaler_ || !(layout == layout_)) prepare(layout);
  av_frame_unref(stored_.get());
  if (av_frame_ref(stored_.get(), &frame) < 0) throw std::bad_alloc();
  stored_->format = layout.format;
  const int code = sws_scale_frame(scaler_.get(), planes_.get(), stored_.get());
  if (code < 0) fail(name_, "a frame cannot be converted to RGB: " + libav_reason(code));

  const FrameSize upright = size(frame, pixel_aspect, turn);
  picture.width = upright.width;
  picture.height = upright.height;
  picture.rgb.resize(static_cast<std::size_t>(upright.width) * static_cast<std::size_t>(upright.height) * 3);
  assemble(*planes_, turn, picture);
  if (const PrimariesConversion* conversion = conversion_from(frame.color_primaries))
    conversion->apply(picture.rgb);
}

}  // namespace sateen::io
