// SPDX-License-Identifier: MIT
// Videos whose containers lie, or are broken.
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/videoio.hpp>

#include "capture/judge.h"
#include "capture/simulator.h"
#include "sateen/capture/capture.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "support/files.h"

namespace sateen::capture {
namespace {

using test::Simulation;
using test::TemporaryFolder;

/// Overwrites four bytes of the AVI's stream header, `offset` behind its start.
void patch_stream_header(const std::filesystem::path& avi, std::size_t offset, std::uint32_t value) {
  std::string bytes = io::read_text(avi);
  const std::size_t at = bytes.find("strh");
  ASSERT_NE(at, std::string::npos);
  for (std::size_t i = 0; i < 4; ++i) bytes[at + 8 + offset + i] = static_cast<char>(value >> (8 * i) & 255);
  io::write_text(avi, bytes);
}

constexpr std::size_t kScale = 20;
constexpr std::size_t kRate = 24;
constexpr std::size_t kLength = 32;

TEST(CaptureVideo, UsesWhatThereIsOfAPromiseTooLarge) {
  const Simulation s = test::small_simulation(40);
  const TemporaryFolder folder;
  test::write_video(s, folder / "turn.avi");
  patch_stream_header(folder / "turn.avi", kLength, 48);
  const CaptureResult result = build_capture({folder / "turn.avi"}, test::small_options(s));
  EXPECT_EQ(result.frames.size(), 40);
  EXPECT_TRUE(result.turn.equal_steps);
  EXPECT_THAT(result.warnings, testing::Contains(testing::HasSubstr("promises 48 frames, but only 40")));
}

TEST(CaptureVideo, NeedsNoFrameRate) {
  const Simulation s = test::small_simulation(40);
  const TemporaryFolder folder;
  test::write_video(s, folder / "turn.avi");
  patch_stream_header(folder / "turn.avi", kScale, 0);
  patch_stream_header(folder / "turn.avi", kRate, 0);
  EXPECT_EQ(build_capture({folder / "turn.avi"}, test::small_options(s)).frames.size(), 40);
}

TEST(CaptureVideo, UsesEveryNthFrameOfALongOne) {
  Simulation s = test::small_simulation(40);
  s.frames = 60;
  const TemporaryFolder folder;
  test::write_video(s, folder / "turn.avi");
  CaptureOptions options = test::small_options(s);
  options.source.max_frames = 25;
  options.turn.source = AngleSource::given;
  for (int i = 0; i < s.frames; ++i) options.turn.angles.push_back(s.angle(i));
  const CaptureResult result = build_capture({folder / "turn.avi"}, options);
  ASSERT_EQ(result.frames.size(), 20);
  EXPECT_EQ(result.frames[7].file, "turn.avi#21");
  EXPECT_NEAR(result.frames[7].turned, s.angle(21), 1e-9);
}

TEST(CaptureVideo, TellsOfAMissingIndex) {
  const Simulation s = test::small_simulation(40);
  const TemporaryFolder folder;
  const auto path = folder / "turn.mp4";
  {
    cv::VideoWriter writer(path.string(), cv::VideoWriter::fourcc('m', 'p', '4', 'v'), 24, {64, 48});
    const cv::Mat grey(48, 64, CV_8UC3, cv::Scalar::all(90));
    for (int i = 0; i < 40; ++i) writer.write(grey);
  }
  // An MP4 keeps its index at the end: a recording that broke off has none.
  auto bytes = io::read_bytes(path);
  bytes.resize(bytes.size() / 2);
  io::write_bytes(path, bytes);
  try {
    build_capture({path}, test::small_options(s));
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("turn.mp4"), testing::HasSubstr("index")));
  }
}

}  // namespace
}  // namespace sateen::capture
