// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <string>

#include "sateen/io/modules/film/frame_converter.h"
#include "sateen/io/modules/film/libav.h"
#include "sateen/io/video_module.h"

namespace sateen::io {

/// A film read from a file. Neither the file's name nor what stands in it makes it open another file.
class FilmSource final : public FrameSource {
 public:
  FilmSource(const std::string& path, int threads);

  int width() const override { return size_.width; }
  int height() const override { return size_.height; }
  double promised_frames() const override;
  double frames_per_second() const override;
  bool next(Picture8& frame) override;
  bool skip() override;
  double seconds() const override { return seconds_; }

 private:
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

  void open(int threads);
  void open_decoder(int threads);
  Turn turn() const;
  AVRational pixel_aspect() const;
  /// The next frame that is shown into frame_; false when there is none.
  bool advance();
  /// Has a frame decoded, which joins the waiting ones.
  void receive();
  /// Gives the decoder its next packet, or tells it that there are no more.
  void feed();
  void drain();
  /// Ends the film before the packet sent last.
  void meet_damage();
  /// A film that was cut out of another begins with frames that lack what they are made from: no damage.
  bool begun() const { return shown_ > 0 || !waiting_.empty(); }

  struct Waiting {
    FramePtr frame;
    int order = 0;  ///< of its packet, from 1; 0: unknown
  };
  /// Whether it may be made from a frame that is not there yet: only then is known whether that one is
  /// damaged.
  bool may_be_spoilt(const Waiting& frame) const;

  std::string path_;
  BytesPtr bytes_;
  DemuxerPtr demuxer_;
  CodecPtr decoder_;
  AVStream* stream_ = nullptr;
  PacketPtr packet_{allocated(av_packet_alloc())};
  FramePtr frame_{allocated(av_frame_alloc())};
  FrameConverter converter_;

  FrameSize size_;
  bool first_waits_ = false;  ///< in frame_, decoded to see what it is
  std::deque<Waiting> waiting_;
  std::map<std::int64_t, int> order_;        ///< of packets that are no frames yet, by their time
  int sent_ = 0;                             ///< packets so far
  int shown_ = 0;                            ///< frames so far
  bool draining_ = false;                    ///< the decoder knows that there are no more packets
  bool finished_ = false;                    ///< no frame will join the waiting ones
  std::int64_t last_sent_ = AV_NOPTS_VALUE;  ///< time of the packet sent last
  std::int64_t damaged_from_ = kNever;       ///< time of the first damaged frame
  double origin_ = 0;                        ///< of the time stamps, seconds
  double seconds_ = 0;
};

}  // namespace sateen::io
