// SPDX-License-Identifier: MIT
#include "sateen/io/ktx2.h"

#include <gtest/gtest.h>
#include <zstd.h>

#include "ktx2_samples.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "support/files.h"

namespace sateen::io {
namespace {

using namespace test;

std::vector<std::uint32_t> written_descriptor(VkFormat format, int zstd_level) {
  const TemporaryFolder folder;
  write_ktx2(folder / "a.ktx2", noise_texture(format, 8, 4), zstd_level);
  const auto bytes = read_bytes(folder / "a.ktx2");
  const auto offset = number_at<std::uint32_t>(bytes, ktx2_offset::descriptor);
  const auto length = number_at<std::uint32_t>(bytes, ktx2_offset::descriptor + 4);
  std::vector<std::uint32_t> words;
  for (std::size_t i = 0; i < length; i += 4) words.push_back(number_at<std::uint32_t>(bytes, offset + i));
  return words;
}

void expect_round_trip(const Ktx2& texture, int zstd_level, const std::string& name = "a.ktx2") {
  const TemporaryFolder folder;
  write_ktx2(folder / name, texture, zstd_level);
  const Ktx2 back = read_ktx2(folder / name);
  EXPECT_EQ(back.format, texture.format);
  EXPECT_EQ(back.width, texture.width);
  EXPECT_EQ(back.height, texture.height);
  EXPECT_EQ(back.depth, texture.depth);
  EXPECT_EQ(back.layers, texture.layers);
  EXPECT_EQ(back.faces, texture.faces);
  EXPECT_EQ(back.levels, texture.levels);
  auto metadata = texture.metadata;
  metadata["KTXwriter"] = back.metadata.at("KTXwriter");
  EXPECT_EQ(back.metadata, metadata);
}

TEST(Ktx2, EveryFormatShapeAndCompressionComesBackBitExactly) {
  for (const VkFormat format : kAllFormats) {
    for (const int zstd_level : {0, 1, 19}) {
      SCOPED_TRACE(fmt::format("format {}, Zstandard {}", static_cast<unsigned>(format), zstd_level));
      expect_round_trip(noise_texture(format, 1, 1), zstd_level);
      expect_round_trip(noise_texture(format, 13, 7, 0, 4), zstd_level);
      expect_round_trip(noise_texture(format, 5, 6, 7, 3), zstd_level);
      expect_round_trip(noise_texture(format, 9, 9, 0, 2, 3), zstd_level);
      expect_round_trip(noise_texture(format, 6, 6, 0, 1, 0, 6), zstd_level);
      expect_round_trip(noise_texture(format, 4, 4, 0, 3, 2, 6), zstd_level);
    }
  }
}

TEST(Ktx2, MetadataAndNonAsciiNamesComeBack) {
  Ktx2 texture = noise_texture(VkFormat::rgba8_srgb, 3, 2);
  texture.metadata = {
      {"KTXorientation", "rd"}, {"sateen.symmetry", "2"}, {"empty", ""}, {"matière", "soie « crêpe » 絹"}};
  expect_round_trip(texture, 9, "étoffe 絹.ktx2");
}

TEST(Ktx2, BinaryValuesAreNoText) {
  const TemporaryFolder folder;
  Ktx2 texture = noise_texture(VkFormat::rgba8_srgb, 3, 2);
  texture.metadata = {{"sateen.raw", "a?b"}, {"sateen.text", "ab"}};
  write_ktx2(folder / "a.ktx2", texture, 0);
  auto bytes = read_bytes(folder / "a.ktx2");
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  bytes.at(text.find("a?b") + 1) = std::byte{0};
  write_bytes(folder / "a.ktx2", bytes);
  const auto metadata = read_ktx2(folder / "a.ktx2").metadata;
  EXPECT_FALSE(metadata.contains("sateen.raw"));
  EXPECT_EQ(metadata.at("sateen.text"), "ab");
}

TEST(Ktx2, LevelBytesCountWholeBlocks) {
  EXPECT_EQ(ktx2_level_bytes({VkFormat::rgba16_sfloat, 5, 3, 4, 0, 1, {}, {}}, 0), 5 * 3 * 4 * 8);
  EXPECT_EQ(ktx2_level_bytes({VkFormat::rgba16_sfloat, 5, 3, 4, 0, 1, {}, {}}, 1), 2 * 1 * 2 * 8);
  EXPECT_EQ(ktx2_level_bytes({VkFormat::bc1_rgb_unorm, 5, 9, 0, 2, 6, {}, {}}, 0), 2 * 3 * 2 * 6 * 8);
  EXPECT_EQ(ktx2_level_bytes({VkFormat::bc7_srgb, 5, 9, 3, 0, 1, {}, {}}, 3), 16);
  EXPECT_THROW(ktx2_level_bytes({VkFormat::r8_unorm, 1u << 20, 1u << 20, 0, 0, 1, {}, {}}, 0), Error);
}

// The words below are put together by hand from the Khronos Data Format Specification 1.3, sections 5.6
// and 5.7.
TEST(Ktx2, DescriptorOfSrgb8SaysSrgbAndALinearAlpha) {
  EXPECT_EQ(written_descriptor(VkFormat::rgba8_srgb, 0),
            (std::vector<std::uint32_t>{92,         0,          2 | 88 << 16,
                                        0x00020101, 0,          4,
                                        0,  //
                                        0x00070000, 0,          0,
                                        255,        0x01070008, 0,
                                        0,          255,        0x02070010,
                                        0,          0,          255,
                                        0x1f070018, 0,          0,
                                        255}));
}

TEST(Ktx2, DescriptorOfHalfFloatIsSignedFloatAndSizedWhenSupercompressed) {
  EXPECT_EQ(written_descriptor(VkFormat::rgba16_sfloat, 3),
            (std::vector<std::uint32_t>{
                92,         0, 2 | 88 << 16, 0x00010101, 0,          8, 0,  //
                0xc00f0000, 0, 0xbf800000,   0x3f800000, 0xc10f0010, 0, 0xbf800000, 0x3f800000,
                0xc20f0020, 0, 0xbf800000,   0x3f800000, 0xcf0f0030, 0, 0xbf800000, 0x3f800000}));
}

TEST(Ktx2, TheHeaderIsReadWithoutTheLevels) {
  const test::TemporaryFolder folder;
  Ktx2 texture{VkFormat::rgba8_unorm, 4, 4, 0, 0, 1, {std::vector<std::byte>(64, std::byte{7})},
               {{"sateen.kind", "x"}}};
  write_ktx2(folder / "a.ktx2", texture);
  std::vector<std::byte> bytes = read_bytes(folder / "a.ktx2");
  bytes.resize(bytes.size() - 10);  // into the level
  write_bytes(folder / "cut.ktx2", bytes);
  EXPECT_THROW(read_ktx2(folder / "cut.ktx2"), Error);
  const Ktx2 info = read_ktx2_info(folder / "cut.ktx2");
  EXPECT_EQ(info.width, 4u);
  EXPECT_TRUE(info.levels.empty());
  EXPECT_EQ(info.metadata.at("sateen.kind"), "x");
  bytes.resize(150);  // into the key/value data
  write_bytes(folder / "cut.ktx2", bytes);
  EXPECT_THROW(read_ktx2_info(folder / "cut.ktx2"), Error);
}

TEST(Ktx2, TexturesThatBelongTogetherAppearTogether) {
  const test::TemporaryFolder folder;
  const Ktx2 whole{VkFormat::rgba8_unorm, 1, 1, 0, 0, 1, {std::vector<std::byte>(4)}, {}};
  const std::vector<std::filesystem::path> paths{folder / "a.ktx2", folder / "b.ktx2"};
  write_ktx2(paths, std::vector<Ktx2>{whole, whole});
  EXPECT_EQ(read_ktx2(paths[0]).width, 1u);
  EXPECT_EQ(read_ktx2(paths[1]).width, 1u);
  std::filesystem::remove(paths[0]);
  std::filesystem::remove(paths[1]);
  std::filesystem::create_directory(paths[1]);  // no file can be put there
  EXPECT_THROW(write_ktx2(paths, std::vector<Ktx2>{whole, whole}), Error);
  EXPECT_FALSE(std::filesystem::exists(paths[0]));
}

TEST(Ktx2, AFlippedBitIsSeen) {
  const test::TemporaryFolder folder;
  const fs::path path = folder / "a.ktx2";
  Ktx2 texture = test::noise_texture(VkFormat::rgba8_srgb, 64, 64);
  texture.metadata["sateen.kind"] = "test";
  write_ktx2(path, texture);
  EXPECT_TRUE(ktx2_is_whole(path));
  const auto whole = read_bytes(path);
  for (const std::size_t at : {std::size_t{20}, std::size_t{150}, whole.size() / 2, whole.size() - 1}) {
    auto bytes = whole;
    bytes[at] ^= std::byte{4};
    write_bytes(path, bytes);
    EXPECT_FALSE(ktx2_is_whole(path)) << at;
  }
  auto bytes = whole;
  bytes[whole.size() - 10] ^= std::byte{1};  // in the compressed texels
  write_bytes(path, bytes);
  EXPECT_THROW(read_ktx2(path), Error);
  write_ktx2(path, Ktx2(texture));
  EXPECT_EQ(read_bytes(path), whole);
  texture.metadata.clear();
  write_ktx2(path, texture);
  EXPECT_FALSE(ktx2_is_whole(path));
}

TEST(Ktx2, DescriptorsOfBlockFormats) {
  using Words = std::vector<std::uint32_t>;
  const auto one_sample = [](std::uint32_t model, std::uint32_t bytes, std::uint32_t type,
                             std::uint32_t upper) {
    return Words{44, 0, 2 | 40 << 16, model, 0x0303, bytes, 0, type, 0, 0, upper};
  };
  EXPECT_EQ(written_descriptor(VkFormat::bc1_rgb_unorm, 0),
            one_sample(0x00010180, 8, 0x003f0000, 0xffffffff));
  EXPECT_EQ(written_descriptor(VkFormat::bc4_unorm, 0), one_sample(0x00010183, 8, 0x003f0000, 0xffffffff));
  EXPECT_EQ(written_descriptor(VkFormat::bc6h_ufloat, 0), one_sample(0x00010185, 16, 0x807f0000, 0x3f800000));
  EXPECT_EQ(written_descriptor(VkFormat::bc7_unorm, 0), one_sample(0x00010186, 16, 0x007f0000, 0xffffffff));
  EXPECT_EQ(written_descriptor(VkFormat::bc7_srgb, 0), one_sample(0x00020186, 16, 0x007f0000, 0xffffffff));
  EXPECT_EQ(written_descriptor(VkFormat::bc3_unorm, 0),
            (Words{60, 0, 2 | 56 << 16, 0x00010182, 0x0303, 16, 0, 0x0f3f0000, 0, 0, 0xffffffff, 0x003f0040,
                   0, 0, 0xffffffff}));
  EXPECT_EQ(written_descriptor(VkFormat::bc5_unorm, 0),
            (Words{60, 0, 2 | 56 << 16, 0x00010184, 0x0303, 16, 0, 0x003f0000, 0, 0, 0xffffffff, 0x013f0040,
                   0, 0, 0xffffffff}));
}

TEST(Ktx2, LevelsLieSmallestFirstAndAligned) {
  const TemporaryFolder folder;
  for (const VkFormat format : kAllFormats) {
    const Ktx2 texture = noise_texture(format, 13, 5, 0, 3);
    write_ktx2(folder / "a.ktx2", texture, 0);
    const auto bytes = read_bytes(folder / "a.ktx2");
    const Ktx2 texel{format, 1, 1, 0, 0, 1, {}, {}};
    const std::uint64_t alignment =
        std::max<std::uint64_t>(4, ktx2_level_bytes(texel, 0));  // 1, 2: lcm with 4 is 4
    std::uint64_t end = number_at<std::uint32_t>(bytes, ktx2_offset::metadata) +
                        number_at<std::uint32_t>(bytes, ktx2_offset::metadata + 4);
    for (std::size_t level = 3; level-- > 0;) {
      const std::size_t entry = ktx2_offset::level_index + 24 * level;
      const auto offset = number_at<std::uint64_t>(bytes, entry);
      EXPECT_EQ(offset % alignment, 0u);
      EXPECT_GE(offset, end);
      EXPECT_LT(offset, end + alignment);
      EXPECT_EQ(number_at<std::uint64_t>(bytes, entry + 8), texture.levels[level].size());
      end = offset + texture.levels[level].size();
    }
    EXPECT_EQ(end, bytes.size());
  }
}

TEST(Ktx2, MetadataAreSortedTerminatedAndPadded) {
  const TemporaryFolder folder;
  Ktx2 texture = noise_texture(VkFormat::r8_unorm, 1, 1);
  texture.metadata = {{"b", "12"}, {"KTXorientation", "rd"}, {"a", "1"}};
  write_ktx2(folder / "a.ktx2", texture, 0);
  const auto bytes = read_bytes(folder / "a.ktx2");
  std::size_t at = number_at<std::uint32_t>(bytes, ktx2_offset::metadata);
  const std::size_t end = at + number_at<std::uint32_t>(bytes, ktx2_offset::metadata + 4);
  std::vector<std::string> keys;
  while (at < end) {
    EXPECT_EQ(at % 4, 0u);
    const auto length = number_at<std::uint32_t>(bytes, at);
    const std::string entry(reinterpret_cast<const char*>(bytes.data()) + at + 4, length);
    EXPECT_EQ(entry.back(), '\0');
    keys.push_back(entry.c_str());
    at = (at + 4 + length + 3) / 4 * 4;
  }
  EXPECT_EQ(keys, (std::vector<std::string>{"KTXorientation", "KTXwriter", "a", "b"}));
}

TEST(Ktx2, SupercompressedLevelsArePlainZstandardFrames) {
  const TemporaryFolder folder;
  const Ktx2 texture = noise_texture(VkFormat::rgba8_srgb, 16, 16, 16);
  write_ktx2(folder / "a.ktx2", texture, 9);
  const auto bytes = read_bytes(folder / "a.ktx2");
  EXPECT_EQ(number_at<std::uint32_t>(bytes, ktx2_offset::supercompression), 2u);
  const auto offset = number_at<std::uint64_t>(bytes, ktx2_offset::level_index);
  const auto length = number_at<std::uint64_t>(bytes, ktx2_offset::level_index + 8);
  EXPECT_EQ(offset + length, bytes.size());
  EXPECT_LT(length, texture.levels[0].size() * 3 / 4);
  std::vector<std::byte> level(texture.levels[0].size());
  EXPECT_EQ(ZSTD_decompress(level.data(), level.size(), bytes.data() + offset, length), level.size());
  EXPECT_EQ(level, texture.levels[0]);
}

TEST(Ktx2, TheSameTextureGivesTheSameBytes) {
  const TemporaryFolder folder;
  const Ktx2 texture = noise_texture(VkFormat::rgba16_sfloat, 8, 8, 8);
  write_ktx2(folder / "a.ktx2", texture);
  write_ktx2(folder / "b.ktx2", texture);
  EXPECT_EQ(read_bytes(folder / "a.ktx2"), read_bytes(folder / "b.ktx2"));
}

}  // namespace
}  // namespace sateen::io
