// SPDX-License-Identifier: MIT
// Films: the colours, the orientation and the times of what is read, and what is written.
#include "sateen/io/video.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/full_disk.h"
#include "sateen/core/colour.h"
#include "sateen/core/error.h"
#include "sateen/core/parallel.h"
#include "sateen/io/file.h"
#include "sateen/io/video_reader.h"
#include "support/files.h"

namespace sateen::io {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;

using Rgb = std::array<int, 3>;

/// Runs the program ffmpeg, which takes the file names from `arguments` as they are.
bool ffmpeg(const std::string& arguments) {
  return std::system(("ffmpeg -hide_banner -loglevel error -nostdin -y " + arguments).c_str()) == 0;
}

bool has_ffmpeg() {
  static const bool has = std::system("ffmpeg -version > /dev/null 2>&1") == 0;
  return has;
}

#define NEEDS_FFMPEG() \
  if (!has_ffmpeg()) GTEST_SKIP() << "the program ffmpeg is not installed"

std::vector<Picture8> frames_of(const fs::path& path) {
  VideoReader reader(path);
  std::vector<Picture8> frames;
  Picture8 frame;
  while (reader.next(frame)) frames.push_back(frame);
  return frames;
}

Rgb at(const Picture8& picture, int x, int y) {
  const auto i = static_cast<std::size_t>(y * picture.width + x) * 3;
  return {picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]};
}

int distance(const Rgb& a, const Rgb& b) {
  int largest = 0;
  for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a[c] - b[c]));
  return largest;
}

int distance(const Picture8& a, const Picture8& b) {
  if (a.rgb.size() != b.rgb.size() || a.width != b.width) return 256;
  int largest = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) largest = std::max(largest, std::abs(a.rgb[i] - b.rgb[i]));
  return largest;
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/// Linear light of a code of sRGB.
float light(int code) {
  return srgb_decode(static_cast<float>(code) / 255);
}

/// Fields of 16 x 16 pixels whose codes differ, so that nothing can be turned or mirrored unseen.
Rgb field(int x, int y) {
  return {40 + 30 * (x / 16), 40 + 50 * (y / 16), 128};
}

/// A film of `count` such pictures, 96 x 64.
void write_fields(const fs::path& path, int count = 3) {
  write_video(path, count, 10, [](int) {
    Image image(96, 64, 3);
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 96; ++x) {
        const Rgb code = field(x, y);
        image.set_rgb(x, y, {light(code[0]), light(code[1]), light(code[2])});
      }
    }
    return image;
  });
}

int grey_of(int frame) {
  return 30 + 5 * frame;
}

/// A film of plain grey pictures, each of its own grey.
void write_greys(const fs::path& path, int count = 40) {
  write_video(path, count, 20, [](int i) { return Image(64, 48, 3, light(grey_of(i))); });
}

/// Luma and chroma coefficients of ITU-R recommendations.
struct Matrix {
  double red;
  double blue;
};
constexpr Matrix kBt601{0.299, 0.114};
constexpr Matrix kBt709{0.2126, 0.0722};
constexpr Matrix kBt2020{0.2627, 0.0593};

constexpr std::array<Rgb, 8> kColours{{{0, 160, 0},
                                       {255, 0, 0},
                                       {0, 0, 255},
                                       {200, 120, 40},
                                       {128, 128, 128},
                                       {0, 0, 0},
                                       {255, 255, 255},
                                       {20, 60, 200}}};

/// One frame of 4:4:4 samples as bytes: the colours above as columns, by the formulas of the recommendations.
std::string yuv_frame(int width, int height, const Matrix& matrix, bool full, int bits) {
  const double scale = std::ldexp(1, bits - 8);
  const double most = std::ldexp(1, bits) - 1;
  std::string bytes;
  for (int plane = 0; plane < 3; ++plane) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const Rgb& code =
            kColours[static_cast<std::size_t>(x) * kColours.size() / static_cast<std::size_t>(width)];
        const double r = code[0] / 255.0;
        const double g = code[1] / 255.0;
        const double b = code[2] / 255.0;
        const double luma = matrix.red * r + (1 - matrix.red - matrix.blue) * g + matrix.blue * b;
        const double chroma =
            plane == 1 ? (b - luma) / (2 * (1 - matrix.blue)) : (r - luma) / (2 * (1 - matrix.red));
        double sample = 0;
        if (plane == 0) sample = full ? luma * most : (16 + 219 * luma) * scale;
        if (plane > 0) sample = full ? chroma * most + 128 * scale : (128 + 224 * chroma) * scale;
        const auto value = static_cast<int>(std::lround(std::clamp(sample, 0.0, most)));
        bytes += static_cast<char>(value & 255);
        if (bits > 8) bytes += static_cast<char>(value >> 8);
      }
    }
  }
  return bytes;
}

/// The largest difference of a film's first frame from the colours it was made of.
int colour_error(const fs::path& film) {
  const Picture8 frame = frames_of(film).at(0);
  int largest = 0;
  for (std::size_t i = 0; i < kColours.size(); ++i) {
    const int x =
        static_cast<int>((2 * i + 1) * static_cast<std::size_t>(frame.width) / (2 * kColours.size()));
    largest = std::max(largest, distance(at(frame, x, frame.height / 2), kColours[i]));
  }
  return largest;
}

struct ColourCase {
  const char* name;
  Matrix matrix;
  bool full = false;
  int bits = 8;
  std::string format = "yuv444p";  ///< stored as; samples go in as 4:4:4
  std::string tags;
  int width = 128;
  int height = 64;
};

void PrintTo(const ColourCase& c, std::ostream* out) {
  *out << c.name;
}

class FilmColours : public testing::TestWithParam<ColourCase> {};

TEST_P(FilmColours, AreThoseItWasMadeOf) {
  NEEDS_FFMPEG();
  const ColourCase& c = GetParam();
  const TemporaryFolder folder;
  write_text(folder / "frame.yuv", yuv_frame(c.width, c.height, c.matrix, c.full, c.bits));
  const std::string raw = c.bits == 10 ? "yuv444p10le" : "yuv444p";
  // The range is told on both sides so that ffmpeg does not convert it.
  const std::string range = c.full ? " -color_range pc " : " -color_range tv ";
  ASSERT_TRUE(ffmpeg("-f rawvideo -pix_fmt " + raw + " -s " + std::to_string(c.width) + "x" +
                     std::to_string(c.height) + range + " -i " + (folder / "frame.yuv").string() +
                     " -pix_fmt " + c.format + range + c.tags + " " + (folder / "film.mkv").string()));
  EXPECT_LE(colour_error(folder / "film.mkv"), 2);
}

INSTANTIATE_TEST_SUITE_P(
    Video, FilmColours,
    testing::Values(
        ColourCase{.name = "bt709", .matrix = kBt709, .tags = "-c:v ffv1 -colorspace bt709"},
        ColourCase{.name = "bt601", .matrix = kBt601, .tags = "-c:v ffv1 -colorspace smpte170m"},
        ColourCase{.name = "pal", .matrix = kBt601, .tags = "-c:v ffv1 -colorspace bt470bg"},
        ColourCase{.name = "bt2020_matrix", .matrix = kBt2020, .tags = "-c:v ffv1 -colorspace bt2020nc"},
        ColourCase{.name = "untagged_small", .matrix = kBt601, .tags = "-c:v ffv1"},
        ColourCase{.name = "untagged_large", .matrix = kBt709, .tags = "-c:v ffv1", .height = 720},
        ColourCase{
            .name = "full_range", .matrix = kBt709, .full = true, .tags = "-c:v ffv1 -colorspace bt709"},
        ColourCase{.name = "h264_full_range",
                   .matrix = kBt601,
                   .full = true,
                   .tags = "-c:v libx264 -qp 0 -colorspace smpte170m"},
        ColourCase{.name = "ten_bits",
                   .matrix = kBt709,
                   .bits = 10,
                   .format = "yuv444p10le",
                   .tags = "-c:v ffv1 -colorspace bt709"},
        ColourCase{.name = "ten_bits_full_range",
                   .matrix = kBt709,
                   .full = true,
                   .bits = 10,
                   .format = "yuv444p10le",
                   .tags = "-c:v ffv1 -colorspace bt709"},
        ColourCase{.name = "ten_bits_420",
                   .matrix = kBt709,
                   .bits = 10,
                   .format = "yuv420p10le",
                   .tags = "-c:v libx264 -qp 0 -colorspace bt709"},
        ColourCase{.name = "half_chroma",
                   .matrix = kBt709,
                   .format = "yuv420p",
                   .tags = "-c:v ffv1 -colorspace bt709"},
        ColourCase{.name = "chroma_422",
                   .matrix = kBt709,
                   .format = "yuv422p",
                   .tags = "-c:v ffv1 -colorspace bt709"},
        ColourCase{.name = "motion_jpeg",
                   .matrix = kBt601,
                   .full = true,
                   .format = "yuvj444p",
                   .tags = "-c:v mjpeg -q:v 1 -qmin 1"},
        ColourCase{.name = "odd_height",
                   .matrix = kBt709,
                   .format = "yuv420p",
                   .tags = "-c:v ffv1 -colorspace bt709",
                   .height = 45}),
    [](const auto& tested) { return tested.param.name; });

TEST(Video, ReadsAGreenOfBt709ToTwoCodes) {
  const std::vector<Picture8> frames = frames_of(test::source_dir() / "tests/data/green709.mp4");
  ASSERT_EQ(frames.size(), 10u);
  for (const Picture8& frame : frames) {
    ASSERT_EQ(frame.width, 320);
    ASSERT_EQ(frame.height, 240);
    for (int y = 0; y < frame.height; ++y) {
      for (int x = 0; x < frame.width; ++x)
        ASSERT_LE(distance(at(frame, x, y), {0, 160, 0}), 2) << x << ' ' << y;
    }
  }
}

TEST(Video, ReadingAFilmLoadsNoOpenCvForVideo) {
  frames_of(test::source_dir() / "tests/data/green709.mp4");
  std::ifstream maps("/proc/self/maps");
  const std::string loaded(std::istreambuf_iterator<char>(maps), {});
  EXPECT_THAT(loaded, HasSubstr("sateen-video.so"));
  EXPECT_THAT(loaded, testing::Not(HasSubstr("opencv_videoio")));
}

TEST(Video, BringsWidePrimariesToRec709) {
  NEEDS_FFMPEG();
  const TemporaryFolder folder;
  // (200, 100, 100) of Display P3 in Rec. 709, by the matrix P3-D65 -> XYZ -> Rec. 709: a stronger red.
  ASSERT_TRUE(ffmpeg(
      "-f lavfi -i color=c=0xc86464:s=64x64:d=0.2:r=10,format=gbrp -c:v ffv1 -color_primaries smpte432 " +
      (folder / "p3.mkv").string()));
  const Rgb wide = at(frames_of(folder / "p3.mkv").at(0), 32, 32);
  EXPECT_LE(distance(wide, {215, 95, 97}), 2) << wide[0] << ' ' << wide[1] << ' ' << wide[2];
  ASSERT_TRUE(ffmpeg(
      "-f lavfi -i color=c=0x808080:s=64x64:d=0.2:r=10,format=gbrp -c:v ffv1 -color_primaries bt2020 " +
      (folder / "grey.mkv").string()));
  EXPECT_LE(distance(at(frames_of(folder / "grey.mkv").at(0), 32, 32), {128, 128, 128}), 1)
      << "white stays white";
}

TEST(Video, RefusesHdrAndSaysHowToSwitchItOff) {
  NEEDS_FFMPEG();
  const TemporaryFolder folder;
  for (const char* transfer : {"arib-std-b67", "smpte2084"}) {
    ASSERT_TRUE(
        ffmpeg("-f lavfi -i color=c=gray:s=64x64:d=0.2:r=10 -pix_fmt yuv420p10le -c:v ffv1 "
               "-color_primaries bt2020 -colorspace bt2020nc -color_trc " +
               std::string(transfer) + " " + (folder / "hdr.mkv").string()));
    EXPECT_THAT(message_of([&] { VideoReader reader(folder / "hdr.mkv"); }),
                AllOf(HasSubstr("hdr.mkv"), HasSubstr("HDR"), HasSubstr("iPhone")));
  }
}

/// Writes the display matrix of an MP4's only track: a stored (x, y) is shown at (a x + c y, b x + d y).
void set_display_matrix(const fs::path& mp4, int a, int b, int c, int d) {
  std::string bytes = read_text(mp4);
  const std::size_t header = bytes.find("tkhd");
  ASSERT_NE(header, std::string::npos);
  const std::size_t matrix = header + 4 + 40;  // of version 0
  const std::array<int, 4> values{a, b, c, d};
  const std::array<std::size_t, 4> places{0, 1, 3, 4};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto fixed = static_cast<std::uint32_t>(values[i] * 65536);
    for (std::size_t k = 0; k < 4; ++k)
      bytes[matrix + places[i] * 4 + k] = static_cast<char>(fixed >> (24 - 8 * k) & 255);
  }
  write_text(mp4, bytes);
}

TEST(Video, StandsUprightAsTheDisplayMatrixSays) {
  const TemporaryFolder folder;
  write_fields(folder / "film.mp4");
  const Picture8 stored = frames_of(folder / "film.mp4").at(0);
  for (const auto& [a, b, c, d] : std::vector<std::array<int, 4>>{{1, 0, 0, 1},
                                                                  {-1, 0, 0, 1},
                                                                  {1, 0, 0, -1},
                                                                  {-1, 0, 0, -1},
                                                                  {0, 1, -1, 0},
                                                                  {0, -1, 1, 0},
                                                                  {0, 1, 1, 0},
                                                                  {0, -1, -1, 0}}) {
    set_display_matrix(folder / "film.mp4", a, b, c, d);
    VideoReader reader(folder / "film.mp4");
    Picture8 shown;
    ASSERT_TRUE(reader.next(shown));
    ASSERT_EQ(reader.width(), a == 0 ? 64 : 96);
    ASSERT_EQ(reader.height(), a == 0 ? 96 : 64);
    ASSERT_EQ(shown.width, reader.width());
    ASSERT_EQ(shown.height, reader.height());
    for (int y = 0; y < stored.height; ++y) {
      for (int x = 0; x < stored.width; ++x) {
        const int across = a * x + c * y;
        const int down = b * x + d * y;
        const Rgb there = at(shown, a + c < 0 ? shown.width - 1 + across : across,
                             b + d < 0 ? shown.height - 1 + down : down);
        ASSERT_EQ(there, at(stored, x, y)) << a << b << c << d << ": " << x << ' ' << y;
      }
    }
  }
}

TEST(Video, RefusesAnAngleThatIsNoQuarterTurn) {
  const TemporaryFolder folder;
  write_fields(folder / "film.mp4");
  set_display_matrix(folder / "film.mp4", 1, 1, -1, 1);
  EXPECT_THAT(message_of([&] { VideoReader reader(folder / "film.mp4"); }),
              AllOf(HasSubstr("film.mp4"), HasSubstr("quarter turn")));
}

TEST(Video, MakesPixelsSquare) {
  NEEDS_FFMPEG();
  const TemporaryFolder folder;
  write_fields(folder / "film.mp4");
  const auto reshaped = [&](const char* aspect) {
    const fs::path path = folder / "reshaped.mp4";
    EXPECT_TRUE(
        ffmpeg("-i " + (folder / "film.mp4").string() + " -c copy -aspect " + aspect + " " + path.string()));
    return frames_of(path).at(0);
  };
  const Picture8 wide = reshaped("2:1");  // 96 x 64 shown twice as wide as high
  EXPECT_EQ(wide.width, 128);
  EXPECT_EQ(wide.height, 64);
  const Picture8 high = reshaped("1:1");
  EXPECT_EQ(high.width, 96);
  EXPECT_EQ(high.height, 96);
  for (int y = 8; y < 64; y += 16) {
    for (int x = 8; x < 96; x += 16) {
      EXPECT_LE(distance(at(wide, x * 128 / 96, y), field(x, y)), 4) << x << ' ' << y;
      EXPECT_LE(distance(at(high, x, y * 96 / 64), field(x, y)), 4) << x << ' ' << y;
    }
  }
  ASSERT_TRUE(ffmpeg("-i " + (folder / "film.mp4").string() + " -c copy -aspect 100:1 " +
                     (folder / "line.mp4").string()));
  EXPECT_THAT(message_of([&] { VideoReader reader(folder / "line.mp4"); }),
              AllOf(HasSubstr("line.mp4"), HasSubstr("pixel aspect")));
}

TEST(Video, TellsWhenEachFrameIsShown) {
  NEEDS_FFMPEG();
  const TemporaryFolder folder;
  write_greys(folder / "film.mp4", 12);
  // Frame i at 10 + i^2 / 100 seconds.
  for (const char* name : {"uneven.mkv", "uneven.mp4"}) {
    ASSERT_TRUE(ffmpeg("-i " + (folder / "film.mp4").string() +
                       " -vf \"settb=1/1000,setpts='(10+N*N*0.01)/TB'\" -vsync vfr -enc_time_base 1:1000 "
                       "-c:v mpeg4 -q:v 2 -copyts " +
                       (folder / name).string()));
    VideoReader reader(folder / name);
    Picture8 frame;
    for (int i = 0; i < 12; ++i) {
      ASSERT_TRUE(i % 3 == 1 ? reader.skip() : reader.next(frame)) << name << ' ' << i;
      EXPECT_NEAR(reader.seconds(), i * i * 0.01, 0.0011) << name << ' ' << i;
    }
    EXPECT_FALSE(reader.skip());
  }
}

TEST(Video, AnEvenFilmTellsItsRateAndLength) {
  const TemporaryFolder folder;
  for (const char* name : {"film.mp4", "film.mov", "film.avi"}) {
    write_greys(folder / name);
    VideoReader reader(folder / name);
    EXPECT_NEAR(reader.frames_per_second(), 20, 1e-6) << name;
    EXPECT_EQ(reader.promised_frames(), 40) << name;
    Picture8 frame;
    for (int i = 0; i < 40; ++i) {
      ASSERT_TRUE(reader.next(frame)) << name << ' ' << i;
      EXPECT_NEAR(reader.seconds(), i / 20.0, 1e-3) << name << ' ' << i;
      EXPECT_LE(distance(at(frame, 32, 24), {grey_of(i), grey_of(i), grey_of(i)}), 2) << name << ' ' << i;
    }
    EXPECT_FALSE(reader.next(frame)) << name;
    EXPECT_FALSE(reader.next(frame)) << name;
  }
}

TEST(Video, ShowsNothingThatAnEditCutAway) {
  NEEDS_FFMPEG();
  const TemporaryFolder folder;
  write_greys(folder / "film.mp4");
  // Copied, not encoded anew: the frames before the cut stay in the file, for those after it are made from
  // them.
  ASSERT_TRUE(
      ffmpeg("-ss 0.5 -i " + (folder / "film.mp4").string() + " -c copy " + (folder / "cut.mp4").string()));
  VideoReader reader(folder / "cut.mp4");
  EXPECT_EQ(reader.promised_frames(), 30);
  const std::vector<Picture8> frames = frames_of(folder / "cut.mp4");
  ASSERT_EQ(frames.size(), 30u);
  for (int i = 0; i < 30; ++i) {
    const int grey = grey_of(i + 10);
    EXPECT_LE(distance(at(frames[static_cast<std::size_t>(i)], 32, 24), {grey, grey, grey}), 2) << i;
  }
}

/// A film of 30 pictures of noise, each of which takes many bytes.
void write_noise(const fs::path& path) {
  write_video(path, 30, 10, [](int i) {
    Image image(96, 64, 3);
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 96; ++x) {
        const std::uint32_t hash =
            static_cast<std::uint32_t>(x * 7919 + y * 104729 + i * 1299709) * 2654435761U;
        image.set_rgb(x, y, Vec3f::Constant(static_cast<float>(hash >> 24) / 255));
      }
    }
    return image;
  });
}

/// The frames of a damaged film are the first of the whole one, and so with any number of threads.
void expect_beginning(const fs::path& damaged, const std::vector<Picture8>& whole) {
  const std::vector<Picture8> some = frames_of(damaged);
  EXPECT_GT(some.size(), whole.size() / 5) << damaged;
  EXPECT_LT(some.size(), whole.size()) << damaged;
  for (std::size_t i = 0; i < some.size(); ++i)
    EXPECT_EQ(distance(some[i], whole[i]), 0) << damaged << ' ' << i;
  for (const int threads : {1, 4}) {
    limit_threads(threads);
    EXPECT_EQ(frames_of(damaged).size(), some.size()) << damaged << ' ' << threads;
  }
  limit_threads(0);
}

TEST(Video, GivesEveryFrameUpToTheEndOfATruncatedFilm) {
  const TemporaryFolder folder;
  for (const char* name : {"film.mp4", "film.avi"}) {
    write_noise(folder / name);
    const std::vector<Picture8> whole = frames_of(folder / name);
    auto bytes = read_bytes(folder / name);
    const std::string text = read_text(folder / name);
    const std::size_t data = name == std::string("film.mp4") ? text.find("mdat") : text.find("movi");
    bytes.resize(data + (bytes.size() - data) * 6 / 10);
    write_bytes(folder / name, bytes);
    expect_beginning(folder / name, whole);
  }
}

TEST(Video, GivesEveryFrameUpToTheDamage) {
  const TemporaryFolder folder;
  write_noise(folder / "film.mp4");
  const std::vector<Picture8> whole = frames_of(folder / "film.mp4");
  ASSERT_EQ(whole.size(), 30u);
  std::string bytes = read_text(folder / "film.mp4");
  const std::size_t data = bytes.find("mdat");
  const std::size_t middle = data + (bytes.size() - data) / 2;
  for (std::size_t i = 0; i < 6000; ++i) bytes[middle + i] = static_cast<char>(i * 37);
  write_text(folder / "film.mp4", bytes);
  expect_beginning(folder / "film.mp4", whole);
}

TEST(Video, RefusesWhatIsNoFilm) {
  const TemporaryFolder folder;
  write_text(folder / "text.mp4", "no video at all");
  write_text(folder / "empty.mp4", "");
  fs::create_directory(folder / "folder.mp4");
  for (const char* name : {"text.mp4", "empty.mp4"}) {
    EXPECT_THAT(message_of([&] { VideoReader reader(folder / name); }),
                AllOf(HasSubstr(name), HasSubstr("cannot be decoded"), HasSubstr("index")));
  }
  EXPECT_THAT(message_of([&] { VideoReader reader(folder / "folder.mp4"); }), HasSubstr("is a folder"));
  EXPECT_THAT(message_of([&] { VideoReader reader(folder / "none.mp4"); }), HasSubstr("no such file"));
  EXPECT_THAT(message_of([] { VideoReader reader("/dev/null"); }), HasSubstr("device"));
}

TEST(Video, FollowsNoList) {
  const TemporaryFolder folder;
  write_greys(folder / "film.mp4", 4);
  const std::string film = (folder / "film.mp4").string();
  write_text(folder / "list.mp4", "ffconcat version 1.0\nfile 'film.mp4'\n");
  write_text(folder / "stream.mp4", "#EXTM3U\n#EXT-X-VERSION:3\n#EXT-X-TARGETDURATION:10\n#EXTINF:1,\n" +
                                        film + "\n#EXT-X-ENDLIST\n");
  write_text(folder / "session.mp4",
             "v=0\no=- 0 0 IN IP4 127.0.0.1\ns=x\nc=IN IP4 127.0.0.1\nt=0 0\n"
             "m=video 5000 RTP/AVP 96\na=rtpmap:96 H264/90000\n");
  for (const char* name : {"list.mp4", "stream.mp4", "session.mp4"}) {
    EXPECT_THAT(message_of([&] { VideoReader reader(folder / name); }),
                AllOf(HasSubstr(name), HasSubstr("cannot be decoded")));
  }
}

/// Makes a folder the one that names are relative to.
class Inside {
 public:
  explicit Inside(const fs::path& folder) : before_(fs::current_path()) { fs::current_path(folder); }
  ~Inside() { fs::current_path(before_); }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;

 private:
  fs::path before_;
};

TEST(Video, AFileIsAFileWhateverItIsCalled) {
  const TemporaryFolder folder;
  const Inside inside(folder.path());
  for (const char* name :
       {"10:22:33.mp4", "http:x.mp4", "-x.mp4", "concat:a.mp4", "file:x.mp4", "data:,x.mp4", "%03d.mp4",
        "pipe:0.mp4", "a b?c=d#e.mp4", "[x]*.mp4", "crypto:x.mp4", "Grün.MP4"}) {
    write_greys(name, 4);
    EXPECT_TRUE(fs::is_regular_file(name)) << name;
    EXPECT_EQ(frames_of(name).size(), 4u) << name;
  }
}

TEST(Video, AWrittenFilmHasItsColours) {
  const TemporaryFolder folder;
  constexpr int kWidth = 256;
  const std::array<Rgb, 4> bands{{{220, 20, 20}, {20, 20, 220}, {20, 180, 20}, {200, 180, 30}}};
  for (const char* name : {"film.mp4", "film.mov", "film.avi"}) {
    write_video(folder / name, 3, 24, [&](int) {
      Image image(kWidth, 96, 3);
      for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          // A ramp of greys above bands of colour.
          const Rgb code = y < 32 ? Rgb{x, x, x} : bands[static_cast<std::size_t>(x / (kWidth / 4))];
          image.set_rgb(x, y, {light(code[0]), light(code[1]), light(code[2])});
        }
      }
      return image;
    });
    const std::vector<Picture8> frames = frames_of(folder / name);
    ASSERT_EQ(frames.size(), 3u);
    for (const Picture8& frame : frames) {
      for (int x = 1; x < kWidth - 1; ++x)
        EXPECT_LE(distance(at(frame, x, 12), {x, x, x}), 4) << name << ' ' << x;
      for (int band = 0; band < 4; ++band)
        EXPECT_LE(distance(at(frame, 32 + 64 * band, 70), bands[static_cast<std::size_t>(band)]), 4)
            << name << band;
    }
  }
}

TEST(Video, AWrittenFilmSaysWhatItsColoursAre) {
  const TemporaryFolder folder;
  write_greys(folder / "film.mp4", 3);
  const std::string bytes = read_text(folder / "film.mp4");
  // Primaries 1 (BT.709), transfer function 13 (sRGB), matrix 1 (BT.709), limited range; ISO/IEC 14496-12.
  const std::size_t tag = bytes.find("colrnclx");
  ASSERT_NE(tag, std::string::npos);
  EXPECT_EQ(bytes.substr(tag + 8, 7), std::string("\0\1\0\15\0\1\0", 7));
  EXPECT_LT(bytes.find("moov"), bytes.find("mdat")) << "a player can start before it has the whole";
}

TEST(Video, EqualPicturesGiveEqualBytes) {
  const TemporaryFolder folder;
  for (const std::string extension : {".mp4", ".mov", ".avi"}) {
    write_fields(folder / ("one" + extension), 20);
    limit_threads(1);
    write_fields(folder / ("two" + extension), 20);
    limit_threads(0);
    EXPECT_EQ(read_text(folder / ("one" + extension)), read_text(folder / ("two" + extension))) << extension;
  }
}

TEST(Video, AFullDiskLeavesTheOlderFilm) {
  const TemporaryFolder folder;
  for (const std::string name : {"film.mp4", "film.avi"}) {
    write_greys(folder / name, 4);
    const std::string older = read_text(folder / name);
    const std::size_t size = [&] {
      write_fields(folder / ("size-" + name), 40);
      return static_cast<std::size_t>(fs::file_size(folder / ("size-" + name)));
    }();
    // At the header, amid the frames, and in the last bytes, which only the index needs.
    for (const std::size_t room : {std::size_t{16}, size / 2, size - 1}) {
      const test::FullDisk full(room);
      EXPECT_THAT(message_of([&] { write_fields(folder / name, 40); }),
                  AllOf(HasSubstr(name + ": cannot be written"), HasSubstr("too large")))
          << room << " of " << size;
    }
    EXPECT_EQ(read_text(folder / name), older);
    fs::remove(folder / ("size-" + name));
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2) << "nothing half-written is left";
}

TEST(Video, RefusesPicturesThatMakeNoFilm) {
  const TemporaryFolder folder;
  const auto written = [&](const std::string& name, int count, double rate,
                           const std::function<Image(int)>& picture) {
    return message_of([&] { write_video(folder / name, count, rate, picture); });
  };
  EXPECT_THAT(written("odd.mp4", 1, 10, [](int) { return Image(15, 16, 3); }),
              AllOf(HasSubstr("odd.mp4"), HasSubstr("an even width and height, not 15 x 16")));
  EXPECT_THAT(written("two.mp4", 2, 10, [](int i) { return Image(16, 16 + 2 * i, 3); }),
              AllOf(HasSubstr("two.mp4"), HasSubstr("must be alike")));
  EXPECT_THAT(written("none.mp4", 0, 10, [](int) { return Image(16, 16, 3); }), HasSubstr("none.mp4"));
  EXPECT_THAT(written("still.mp4", 1, 0, [](int) { return Image(16, 16, 3); }),
              AllOf(HasSubstr("still.mp4"), HasSubstr("frames a second")));
  EXPECT_THAT(written("film.mkv", 1, 10, [](int) { return Image(16, 16, 3); }), HasSubstr("film.mkv"));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace sateen::io
