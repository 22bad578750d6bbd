// SPDX-License-Identifier: MIT
#include "sateen/io/modules/film/film_sink.h"

#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "sateen/io/file_error.h"

namespace sateen::io {
namespace {

// What H.264 encoders write depends on how many threads share the work, so that is no matter of the computer.
constexpr int kThreads = 4;
// Rate factor and quantiser of the two encoders at which a turning model shows no blocks.
constexpr const char* kRateFactor = "17";
constexpr int kQuantiser = 2;

}  // namespace

FilmSink::FilmSink(const FilmSettings& settings) : settings_(settings) {
  if (!(settings.frames_per_second > 0) || !std::isfinite(settings.frames_per_second)) {
    fail(settings.name, fmt::format("a film needs a positive number of frames a second, not {}",
                                    settings.frames_per_second));
  }
  const std::string file = libav_file(settings.path);
  AVFormatContext* muxer = nullptr;
  check(avformat_alloc_output_context2(&muxer, nullptr, settings.container.c_str(), file.c_str()));
  muxer_.reset(muxer);
  muxer->flags |= AVFMT_FLAG_BITEXACT;  // no version, no time of writing
  muxer->protocol_whitelist = allocated(av_strdup("file"));
  const AVCodec* h264 = avcodec_find_encoder_by_name("libx264");
  const AVCodec* mpeg4 = avcodec_find_encoder(AV_CODEC_ID_MPEG4);
  if (!(h264 != nullptr && open_encoder(h264)) && !(mpeg4 != nullptr && open_encoder(mpeg4)))
    fail(settings.name, "cannot be written: this computer's FFmpeg has no encoder for H.264 or MPEG-4");
  start();
}

bool FilmSink::open_encoder(const AVCodec* codec) {
  const bool h264 = codec->id == AV_CODEC_ID_H264;
  const bool avi = settings_.container == "avi";
  encoder_.reset(allocated(avcodec_alloc_context3(codec)));
  AVCodecContext& encoder = *encoder_;
  encoder.width = settings_.width;
  encoder.height = settings_.height;
  encoder.pix_fmt = AV_PIX_FMT_YUV420P;
  encoder.sample_aspect_ratio = {1, 1};
  encoder.framerate = av_d2q(settings_.frames_per_second, 65535);  // the most MPEG-4 can tell
  encoder.time_base = av_inv_q(encoder.framerate);
  encoder.color_range = AVCOL_RANGE_MPEG;
  encoder.color_primaries = AVCOL_PRI_BT709;
  encoder.color_trc = AVCOL_TRC_IEC61966_2_1;
  // MPEG-4 in an AVI has no place to say so: what players take it for.
  const bool silent = avi && !h264;
  encoder.colorspace = silent && settings_.height < 720 ? AVCOL_SPC_SMPTE170M : AVCOL_SPC_BT709;
  encoder.chroma_sample_location = AVCHROMA_LOC_LEFT;
  encoder.flags |= AV_CODEC_FLAG_BITEXACT;
  if ((muxer_->oformat->flags & AVFMT_GLOBALHEADER) != 0) encoder.flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  if (avi) encoder.max_b_frames = 0;  // it cannot tell the order they are shown in
  AVDictionary* options = nullptr;
  if (h264) {
    encoder.thread_count = kThreads;
    av_dict_set(&options, "preset", "medium", 0);
    av_dict_set(&options, "crf", kRateFactor, 0);
  } else {
    encoder.thread_count = 1;
    encoder.flags |= AV_CODEC_FLAG_QSCALE;
    encoder.global_quality = FF_QP2LAMBDA * kQuantiser;
  }
  const int code = avcodec_open2(&encoder, codec, &options);
  av_dict_free(&options);
  return code >= 0;
}

void FilmSink::start() {
  stream_ = allocated(avformat_new_stream(muxer_.get(), nullptr));
  check(avcodec_parameters_from_context(stream_->codecpar, encoder_.get()));
  stream_->time_base = encoder_->time_base;
  stream_->avg_frame_rate = encoder_->framerate;
  stream_->sample_aspect_ratio = encoder_->sample_aspect_ratio;

  AVIOContext* bytes = nullptr;
  check(avio_open2(&bytes, libav_file(settings_.path).c_str(), AVIO_FLAG_WRITE, nullptr, nullptr));
  bytes_.reset(bytes);
  muxer_->pb = bytes;
  AVDictionary* options = nullptr;
  // A player on the web can start before it has the whole.
  if (settings_.container != "avi") av_dict_set(&options, "movflags", "+faststart", 0);
  const int code = avformat_write_header(muxer_.get(), &options);
  av_dict_free(&options);
  check(code);

  for (const auto& [frame, format] :
       {std::pair{rgb_.get(), AV_PIX_FMT_RGB24}, std::pair{yuv_.get(), AV_PIX_FMT_YUV420P}}) {
    frame->width = settings_.width;
    frame->height = settings_.height;
    frame->format = format;
    if (av_frame_get_buffer(frame, 0) < 0) throw std::bad_alloc();
  }
  yuv_->color_range = encoder_->color_range;
  yuv_->color_primaries = encoder_->color_primaries;
  yuv_->color_trc = encoder_->color_trc;
  yuv_->colorspace = encoder_->colorspace;
  yuv_->chroma_location = encoder_->chroma_sample_location;

  scaler_.reset(allocated(sws_alloc_context()));
  const auto set = [&](const char* option, std::int64_t value) {
    check(av_opt_set_int(scaler_.get(), option, value, 0));
  };
  set("srcw", settings_.width);
  set("srch", settings_.height);
  set("src_format", AV_PIX_FMT_RGB24);
  set("dstw", settings_.width);
  set("dsth", settings_.height);
  set("dst_format", AV_PIX_FMT_YUV420P);
  set("dst_h_chr_pos", 0);  // AVCHROMA_LOC_LEFT
  set("dst_v_chr_pos", 128);
  set("sws_flags", SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT | SWS_FULL_CHR_H_INP | SWS_BITEXACT);
  check(sws_init_context(scaler_.get(), nullptr, nullptr));
  const int* matrix = sws_getCoefficients(encoder_->colorspace);
  constexpr int kOne = 1 << 16;
  check(sws_setColorspaceDetails(scaler_.get(), matrix, 1, matrix, 0, 0, kOne, kOne));
}

void FilmSink::write(const Picture8& frame) {
  // The scaler reads beyond the end of rows, where a Picture8 may end; and the encoder may hold on to its
  // frame.
  check(av_frame_make_writable(yuv_.get()));
  const auto row = static_cast<std::size_t>(settings_.width) * 3;
  for (int y = 0; y < settings_.height; ++y) {
    std::memcpy(rgb_->data[0] + static_cast<std::ptrdiff_t>(y) * rgb_->linesize[0],
                frame.rgb.data() + static_cast<std::size_t>(y) * row, row);
  }
  check(sws_scale_frame(scaler_.get(), yuv_.get(), rgb_.get()));
  yuv_->pts = count_++;
  encode(yuv_.get());
}

void FilmSink::finish() {
  encode(nullptr);
  check(av_write_trailer(muxer_.get()));
  avio_flush(bytes_.get());
  check(bytes_->error);
  AVIOContext* bytes = bytes_.release();
  muxer_->pb = nullptr;
  check(avio_closep(&bytes));
}

void FilmSink::encode(const AVFrame* frame) {
  check(avcodec_send_frame(encoder_.get(), frame));
  while (true) {
    const int code = avcodec_receive_packet(encoder_.get(), packet_.get());
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
    check(code);
    packet_->stream_index = stream_->index;
    packet_->duration = 1;
    av_packet_rescale_ts(packet_.get(), encoder_->time_base, stream_->time_base);
    check(av_write_frame(muxer_.get(), packet_.get()));
    av_packet_unref(packet_.get());
  }
}

void FilmSink::check(int code) const {
  if (code < 0) fail(settings_.name, "cannot be written: " + libav_reason(code));
}

}  // namespace sateen::io
