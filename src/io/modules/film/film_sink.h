// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "sateen/io/modules/film/libav.h"
#include "sateen/io/video_module.h"

namespace sateen::io {

/// A film written to a file: H.264 where there is an encoder, else MPEG-4; BT.709 primaries and matrix,
/// limited range, 4:2:0, sRGB's transfer function. The index stands before the frames, where the container
/// can have it there.
class FilmSink final : public FrameSink {
 public:
  explicit FilmSink(const FilmSettings& settings);

  void write(const Picture8& frame) override;
  void finish() override;

 private:
  bool open_encoder(const AVCodec* codec);
  void start();
  void encode(const AVFrame* frame);  // null: there are no more
  /// Throws Error when `code` is one of an error.
  void check(int code) const;

  FilmSettings settings_;
  MuxerPtr muxer_;
  BytesPtr bytes_;
  CodecPtr encoder_;
  AVStream* stream_ = nullptr;
  SwsPtr scaler_;
  PacketPtr packet_{allocated(av_packet_alloc())};
  FramePtr rgb_{allocated(av_frame_alloc())};
  FramePtr yuv_{allocated(av_frame_alloc())};
  std::int64_t count_ = 0;
};

}  // namespace sateen::io
