// SPDX-License-Identifier: MIT
#include "sateen/io/modules/film/film_source.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "sateen/io/file_error.h"

namespace sateen::io {
namespace {

/// Demuxers that read what films are, and no other file than the one they are given: no playlists, no lists
/// of pictures, no streams.
constexpr const char* kDemuxers = "mov,matroska,avi,mpegts,mpeg,mjpeg";

constexpr const char* kNoFilm =
    "cannot be decoded as a video: it is no MP4, MOV, Matroska, WebM, AVI or MPEG, or its index is missing, "
    "as after a recording that broke off";

/// Of a frame; beyond it memory would be asked for that no camera fills.
constexpr std::int64_t kMostPixels = std::int64_t{1} << 28;

/// Frames that codecs keep for later ones to be made from.
constexpr int kMostReordered = 16;

int refuse_to_open(AVFormatContext* /*demuxer*/, AVIOContext** /*bytes*/, const char* /*url*/, int /*flags*/,
                   AVDictionary** /*options*/) {
  return AVERROR(EPERM);
}

/// The display matrix a container has for a stream, or null.
const std::int32_t* display_matrix(const AVStream& stream) {
#if LIBAVFORMAT_VERSION_INT >= AV_VERSION_INT(60, 15, 100)
  const AVPacketSideData* data = av_packet_side_data_get(
      stream.codecpar->coded_side_data, stream.codecpar->nb_coded_side_data, AV_PKT_DATA_DISPLAYMATRIX);
  return data == nullptr ? nullptr : reinterpret_cast<const std::int32_t*>(data->data);
#else
  return reinterpret_cast<const std::int32_t*>(
      av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr));
#endif
}

/// The film itself rather than the picture of its cover.
AVStream* film_stream(AVFormatContext& demuxer) {
  const int best = av_find_best_stream(&demuxer, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  const auto is_film = [](const AVStream& stream) {
    return stream.codecpar->codec_type == AVMEDIA_TYPE_VIDEO &&
           (stream.disposition & AV_DISPOSITION_ATTACHED_PIC) == 0;
  };
  if (best >= 0 && is_film(*demuxer.streams[best])) return demuxer.streams[best];
  for (unsigned i = 0; i < demuxer.nb_streams; ++i) {
    if (is_film(*demuxer.streams[i])) return demuxer.streams[i];
  }
  return nullptr;
}

bool is_damaged(const AVFrame& frame) {
  return frame.decode_error_flags != 0 || (frame.flags & AV_FRAME_FLAG_CORRUPT) != 0;
}

}  // namespace

FilmSource::FilmSource(const std::string& path, int threads) : path_(path), converter_(path, threads) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) fail(path, "is a folder, a film is needed");
  if (!std::filesystem::is_regular_file(path, code))
    fail(path, "is a device or pipe; a film is read from a file");
  open(threads);
  if (!advance())
    fail(path,
         "holds no frame that can be decoded; its index may be damaged, as after a recording that broke off");
  if (!turn_of(display_matrix(*stream_))) {
    fail(path, "is to be shown at an angle that is no quarter turn; turn it upright with a video editor");
  }
  converter_.require_known_colours(*frame_);
  size_ = converter_.size(*frame_, pixel_aspect(), turn());
  first_waits_ = true;
}

void FilmSource::open(int threads) {
  AVIOContext* bytes = nullptr;
  AVDictionary* options = nullptr;
  av_dict_set(&options, "protocol_whitelist", "file", 0);
  int code = avio_open2(&bytes, libav_file(path_).c_str(), AVIO_FLAG_READ, nullptr, &options);
  av_dict_free(&options);
  if (code < 0) fail(path_, "cannot read: " + libav_reason(code));
  bytes_.reset(bytes);

  AVFormatContext* demuxer = allocated(avformat_alloc_context());
  demuxer->pb = bytes;
  demuxer->io_open = refuse_to_open;
  demuxer->format_whitelist = allocated(av_strdup(kDemuxers));
  code = avformat_open_input(&demuxer, nullptr, nullptr, nullptr);  // frees the demuxer when it fails
  if (code < 0) fail(path_, kNoFilm);
  demuxer_.reset(demuxer);
  avformat_find_stream_info(demuxer, nullptr);  // what it cannot find is asked for again below
  stream_ = film_stream(*demuxer);
  if (demuxer->nb_streams == 0) fail(path_, kNoFilm);
  if (stream_ == nullptr)
    fail(path_, "holds no film, or its index is damaged, as after a recording that broke off");
  for (unsigned i = 0; i < demuxer->nb_streams; ++i) {
    if (demuxer->streams[i] != stream_) demuxer->streams[i]->discard = AVDISCARD_ALL;
  }
  open_decoder(threads);
}

void FilmSource::open_decoder(int threads) {
  const AVCodecID id = stream_->codecpar->codec_id;
  const AVCodec* codec = avcodec_find_decoder(id);
  if (codec == nullptr) {
    fail(path_,
         fmt::format("cannot be decoded as a video: this computer's FFmpeg has no decoder for its codec "
                     "({}). Extract its frames as pictures, or copy it through ffmpeg where there is one",
                     avcodec_get_name(id)));
  }
  decoder_.reset(allocated(avcodec_alloc_context3(codec)));
  int code = avcodec_parameters_to_context(decoder_.get(), stream_->codecpar);
  decoder_->pkt_timebase = stream_->time_base;
  decoder_->max_pixels = kMostPixels;
  // Not several frames at once: damage is then told too late, some of it after the frame was given out. With
  // several slices at once the decoder of H.264 tells of none.
  decoder_->thread_type = FF_THREAD_SLICE;
  decoder_->thread_count = id == AV_CODEC_ID_H264 ? 1 : threads;
  if (code >= 0) code = avcodec_open2(decoder_.get(), codec, nullptr);
  if (code < 0) {
    fail(path_,
         fmt::format("cannot be decoded as a video: {} ({})", libav_reason(code), avcodec_get_name(id)));
  }
}

Turn FilmSource::turn() const {
  const std::int32_t* matrix = display_matrix(*stream_);
  if (matrix == nullptr) {
    const AVFrameSideData* data = av_frame_get_side_data(frame_.get(), AV_FRAME_DATA_DISPLAYMATRIX);
    if (data != nullptr) matrix = reinterpret_cast<const std::int32_t*>(data->data);
  }
  return turn_of(matrix).value_or(Turn{});
}

AVRational FilmSource::pixel_aspect() const {
  return av_guess_sample_aspect_ratio(demuxer_.get(), stream_, frame_.get());
}

double FilmSource::promised_frames() const {
  if (stream_->nb_frames <= 0) {
    const double duration = stream_->duration > 0
                                ? static_cast<double>(stream_->duration) * av_q2d(stream_->time_base)
                                : static_cast<double>(demuxer_->duration) / AV_TIME_BASE;
    return std::max(0.0, std::round(duration * frames_per_second()));
  }
  // Of an MP4 the list of all frames is known, less those its edits leave out; some others only precede the
  // first one shown, for the decoder.
  const bool mp4 = std::strncmp(demuxer_->iformat->name, "mov", 3) == 0;
  const int listed = mp4 ? avformat_index_get_entries_count(stream_) : 0;
  if (listed <= 0 || listed > stream_->nb_frames) return static_cast<double>(stream_->nb_frames);
  int shown = 0;
  for (int i = 0; i < listed; ++i) {
    if ((avformat_index_get_entry(stream_, i)->flags & AVINDEX_DISCARD_FRAME) == 0) ++shown;
  }
  return shown;
}

double FilmSource::frames_per_second() const {
  const auto rate = [](AVRational r) { return r.num > 0 && r.den > 0 ? av_q2d(r) : 0.0; };
  const double average = rate(stream_->avg_frame_rate);
  return average > 0 ? average : rate(stream_->r_frame_rate);
}

bool FilmSource::next(Picture8& frame) {
  if (!advance()) return false;
  converter_.convert(*frame_, pixel_aspect(), turn(), frame);
  return true;
}

bool FilmSource::skip() {
  return advance();
}

bool FilmSource::advance() {
  if (std::exchange(first_waits_, false)) return true;
  while (!finished_ && (waiting_.empty() || may_be_spoilt(waiting_.front()))) receive();
  if (waiting_.empty()) return false;
  frame_ = std::move(waiting_.front().frame);
  waiting_.pop_front();
  ++shown_;
  const std::int64_t time = frame_->best_effort_timestamp;
  if (time != AV_NOPTS_VALUE) {
    const double now = static_cast<double>(time) * av_q2d(stream_->time_base);
    if (shown_ == 1) origin_ = now;
    seconds_ = now - origin_;
  } else if (shown_ > 1 && frames_per_second() > 0) {
    seconds_ += 1 / frames_per_second();
  }
  return true;
}

bool FilmSource::may_be_spoilt(const Waiting& frame) const {
  return std::ranges::any_of(order_, [&](const auto& packet) {
    return packet.second < frame.order && packet.second + kMostReordered > frame.order;
  });
}

void FilmSource::receive() {
  FramePtr frame(allocated(av_frame_alloc()));
  const int code = avcodec_receive_frame(decoder_.get(), frame.get());
  if (code == AVERROR(EAGAIN)) return feed();
  if (code == AVERROR_EOF || (code < 0 && draining_)) {
    finished_ = true;
    return;
  }
  if (code < 0) return meet_damage();
  const auto sent = order_.find(frame->pts);
  const int order = sent == order_.end() ? 0 : sent->second;
  if (sent != order_.end()) order_.erase(sent);
  if (is_damaged(*frame)) {
    if (!begun()) return;
    const auto spoilt = std::ranges::find_if(
        waiting_, [&](const Waiting& other) { return order == 0 || other.order > order; });
    waiting_.erase(spoilt, waiting_.end());
    finished_ = true;
    return;
  }
  const std::int64_t time = frame->best_effort_timestamp;
  if (time == AV_NOPTS_VALUE ? damaged_from_ != kNever : time >= damaged_from_) {
    finished_ = true;
    return;
  }
  // Colours the stream itself is silent about may be told by the container.
  const AVCodecParameters& told = *stream_->codecpar;
  if (frame->color_trc == AVCOL_TRC_UNSPECIFIED) frame->color_trc = told.color_trc;
  if (frame->colorspace == AVCOL_SPC_UNSPECIFIED) frame->colorspace = told.color_space;
  if (frame->color_primaries == AVCOL_PRI_UNSPECIFIED) frame->color_primaries = told.color_primaries;
  if (frame->color_range == AVCOL_RANGE_UNSPECIFIED) frame->color_range = told.color_range;
  waiting_.push_back({std::move(frame), order});
}

void FilmSource::feed() {
  while (true) {
    const int read = av_read_frame(demuxer_.get(), packet_.get());
    if (read == AVERROR(EAGAIN)) continue;
    if (read < 0) return drain();
    const bool ours = packet_->stream_index == stream_->index;
    const bool broken = (packet_->flags & AV_PKT_FLAG_CORRUPT) != 0;
    if (!ours || (broken && sent_ == 0)) {
      av_packet_unref(packet_.get());
      continue;
    }
    last_sent_ = packet_->pts;
    ++sent_;
    std::erase_if(order_, [&](const auto& packet) { return packet.second + 2 * kMostReordered < sent_; });
    if (last_sent_ != AV_NOPTS_VALUE && (packet_->flags & AV_PKT_FLAG_DISCARD) == 0)
      order_[last_sent_] = sent_;
    const int code = broken ? AVERROR_INVALIDDATA : avcodec_send_packet(decoder_.get(), packet_.get());
    av_packet_unref(packet_.get());
    if (code < 0) meet_damage();
    return;
  }
}

void FilmSource::drain() {
  draining_ = true;
  avcodec_send_packet(decoder_.get(), nullptr);
}

void FilmSource::meet_damage() {
  if (!begun()) return;
  // Frames that wait for their turn are whole, but beyond the damaged one they would leave a gap. Without a
  // time no one can tell which those are.
  damaged_from_ = last_sent_ == AV_NOPTS_VALUE ? std::numeric_limits<std::int64_t>::min() : last_sent_;
  drain();
}

}  // namespace sateen::io
