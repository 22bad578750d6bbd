// SPDX-License-Identifier: MIT
// FFmpeg's libraries (5.1 or later) with owners for what they hand out.
#pragma once

#include <array>
#include <memory>
#include <new>
#include <string>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

namespace sateen::io {

/// Deletes by a function that takes the pointer's address.
template <auto free_by_address>
struct LibavDelete {
  template <class T>
  void operator()(T* pointer) const {
    free_by_address(&pointer);
  }
};

struct SwsDelete {
  void operator()(SwsContext* context) const { sws_freeContext(context); }
};
struct MuxerDelete {
  void operator()(AVFormatContext* muxer) const { avformat_free_context(muxer); }
};

using BytesPtr = std::unique_ptr<AVIOContext, LibavDelete<avio_closep>>;
using DemuxerPtr = std::unique_ptr<AVFormatContext, LibavDelete<avformat_close_input>>;
using MuxerPtr = std::unique_ptr<AVFormatContext, MuxerDelete>;
using CodecPtr = std::unique_ptr<AVCodecContext, LibavDelete<avcodec_free_context>>;
using FramePtr = std::unique_ptr<AVFrame, LibavDelete<av_frame_free>>;
using PacketPtr = std::unique_ptr<AVPacket, LibavDelete<av_packet_free>>;
using SwsPtr = std::unique_ptr<SwsContext, SwsDelete>;

/// What an allocating function returned; throws std::bad_alloc for null.
template <class T>
T* allocated(T* pointer) {
  if (pointer == nullptr) throw std::bad_alloc();
  return pointer;
}

/// What an error code of the libraries means, as in "No space left on device".
inline std::string libav_reason(int code) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(code, text.data(), text.size());
  return text.data();
}

/// The name of `path` for the libraries: a file whatever it looks like, where "http:x.mp4" alone would be an
/// address.
inline std::string libav_file(const std::string& path) {
  return "file:" + path;
}

}  // namespace sateen::io
