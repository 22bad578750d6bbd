// SPDX-License-Identifier: MIT
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zstd.h>

#include "ktx2_samples.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/ktx2.h"
#include "support/files.h"

namespace sateen::io {
namespace {

using namespace test;
using ::testing::HasSubstr;
using Bytes = std::vector<std::byte>;

class Ktx2BadInput : public ::testing::Test {
 protected:
  Bytes sample(const Ktx2& texture, int zstd_level) {
    write_ktx2(path_, texture, zstd_level);
    return read_bytes(path_);
  }

  /// The message read_ktx2 refuses `bytes` with; empty when it reads them.
  std::string refusal(const Bytes& bytes) {
    put_bytes(path_, bytes);
    try {
      read_ktx2(path_);
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(path_.string()));
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "texture.ktx2";
};

TEST_F(Ktx2BadInput, TruncationAtEveryByteIsRefused) {
  for (const int zstd_level : {0, 9}) {
    Ktx2 texture = noise_texture(VkFormat::rgba8_srgb, 3, 2, 2, 2);
    texture.metadata["key"] = "value";
    const Bytes whole = sample(texture, zstd_level);
    EXPECT_EQ(refusal(whole), "");
    for (std::size_t length = 0; length < whole.size(); ++length) {
      EXPECT_NE(refusal(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length))), "")
          << length;
    }
  }
}

TEST_F(Ktx2BadInput, FlippedBytesAreReadOrRefusedButNeverCrash) {
  std::mt19937 random(7);
  for (const int zstd_level : {0, 9}) {
    const Bytes whole = sample(noise_texture(VkFormat::bc7_srgb, 9, 9, 0, 3, 2, 6), zstd_level);
    for (int i = 0; i < 3000; ++i) {
      Bytes broken = whole;
      // Most of the fields that matter lie in front.
      const std::size_t range = i % 2 == 0 ? broken.size() : std::min<std::size_t>(broken.size(), 260);
      broken[random() % range] ^= static_cast<std::byte>(1 + random() % 255);
      refusal(broken);
    }
  }
}

TEST_F(Ktx2BadInput, AHeaderThatClaimsTooMuchIsRefusedBeforeMemoryIsAskedFor) {
  const Bytes whole = sample(noise_texture(VkFormat::rgba8_srgb, 4, 4), 0);
  const auto with = [&](const std::function<void(Bytes&)>& change) {
    Bytes bytes = whole;
    change(bytes);
    return refusal(bytes);
  };
  EXPECT_THAT(with([](Bytes& b) {
                put_number(b, ktx2_offset::width, 1u << 20);
                put_number(b, ktx2_offset::height, 1u << 20);
              }),
              HasSubstr("1048576 x 1048576"));
  EXPECT_THAT(with([](Bytes& b) {
                put_number(b, ktx2_offset::width, 1u << 14);
                put_number(b, ktx2_offset::height, 1u << 14);
                put_number(b, ktx2_offset::level_index + 8, std::uint64_t{4} << 28);
                put_number(b, ktx2_offset::level_index + 16, std::uint64_t{4} << 28);
              }),
              HasSubstr("beyond"));
  EXPECT_THAT(with([](Bytes& b) { put_number(b, ktx2_offset::layers, 0xffffffffu); }), HasSubstr("GB"));
  EXPECT_THAT(with([](Bytes& b) { put_number(b, ktx2_offset::level_index, ~std::uint64_t{0} - 8); }),
              HasSubstr("beyond"));
}

TEST_F(Ktx2BadInput, EachWrongFieldIsNamed) {
  const Bytes whole = sample(noise_texture(VkFormat::rgba8_srgb, 4, 2), 0);
  const auto with = [&](std::size_t offset, std::uint32_t value) {
    Bytes bytes = whole;
    put_number(bytes, offset, value);
    return refusal(bytes);
  };
  EXPECT_THAT(with(0, 0), HasSubstr("no KTX2"));
  EXPECT_THAT(with(ktx2_offset::format, 0), HasSubstr("format 0"));
  EXPECT_THAT(with(ktx2_offset::type_size, 2), HasSubstr("does not have 2 bytes"));
  EXPECT_THAT(with(ktx2_offset::width, 0), HasSubstr("width is 0"));
  EXPECT_THAT(with(ktx2_offset::width, 5), HasSubstr("where its size and format need"));
  EXPECT_THAT(with(ktx2_offset::height, 0), HasSubstr("one-dimensional"));
  EXPECT_THAT(with(ktx2_offset::faces, 0), HasSubstr("faces"));
  EXPECT_THAT(with(ktx2_offset::faces, 6), HasSubstr("cube"));
  EXPECT_THAT(with(ktx2_offset::levels, 4), HasSubstr("4 mip levels"));
  EXPECT_THAT(with(ktx2_offset::levels, 0xffffffff), HasSubstr("mip levels"));
  EXPECT_THAT(with(ktx2_offset::supercompression, 1), HasSubstr("scheme 1"));
  EXPECT_THAT(with(ktx2_offset::supercompression, 2), HasSubstr("corrupt"));
  EXPECT_THAT(with(ktx2_offset::descriptor + 4, 4), HasSubstr("descriptor"));
  EXPECT_THAT(with(ktx2_offset::metadata + 4, 3), HasSubstr("key/value"));
  EXPECT_THAT(with(number_at<std::uint32_t>(whole, ktx2_offset::metadata), 0xfffffff0),
              HasSubstr("key/value"));
}

TEST_F(Ktx2BadInput, ALevelCountOfZeroMeansOne) {
  Bytes bytes = sample(noise_texture(VkFormat::rgba8_srgb, 4, 4), 0);
  put_number(bytes, ktx2_offset::levels, 0u);
  EXPECT_EQ(refusal(bytes), "");
  EXPECT_EQ(read_ktx2(path_).levels.size(), 1u);
}

/// A supercompressed 64 x 64 texture whose only level is replaced by `level`.
Bytes with_level(Bytes whole, const Bytes& level) {
  whole.resize(number_at<std::uint64_t>(whole, ktx2_offset::level_index));
  whole.insert(whole.end(), level.begin(), level.end());
  put_number(whole, ktx2_offset::level_index + 8, static_cast<std::uint64_t>(level.size()));
  return whole;
}

Bytes zstd(const Bytes& data, bool say_size = true) {
  ZSTD_CCtx* context = ZSTD_createCCtx();
  ZSTD_CCtx_setParameter(context, ZSTD_c_contentSizeFlag, say_size ? 1 : 0);
  Bytes packed(ZSTD_compressBound(data.size()));
  packed.resize(ZSTD_compress2(context, packed.data(), packed.size(), data.data(), data.size()));
  ZSTD_freeCCtx(context);
  return packed;
}

TEST_F(Ktx2BadInput, ZstandardFramesOfTheWrongSizeAreRefused) {
  const Ktx2 texture = noise_texture(VkFormat::rgba8_srgb, 64, 64);
  const Bytes whole = sample(texture, 9);
  const Bytes& data = texture.levels[0];
  for (const bool say_size : {true, false}) {
    EXPECT_EQ(refusal(with_level(whole, zstd(data, say_size))), "");
    for (const std::size_t size : {std::size_t{0}, data.size() - 1, data.size() + 1, data.size() * 1000}) {
      Bytes wrong = data;
      wrong.resize(size);
      EXPECT_THAT(refusal(with_level(whole, zstd(wrong, say_size))), HasSubstr("corrupt")) << size;
    }
  }
  EXPECT_THAT(refusal(with_level(whole, {})), HasSubstr("corrupt"));
  // Several frames make one level too.
  Bytes two = zstd(Bytes(data.begin(), data.begin() + 1000));
  const Bytes second = zstd(Bytes(data.begin() + 1000, data.end()));
  two.insert(two.end(), second.begin(), second.end());
  EXPECT_EQ(refusal(with_level(whole, two)), "");
  EXPECT_EQ(read_ktx2(path_).levels[0], data);
}

TEST_F(Ktx2BadInput, ASupercompressedClaimIsMeasuredAgainstTheFile) {
  Bytes bytes = sample(noise_texture(VkFormat::rgba8_srgb, 4, 4), 9);
  put_number(bytes, ktx2_offset::width, 1u << 14);
  put_number(bytes, ktx2_offset::height, 1u << 14);
  put_number(bytes, ktx2_offset::level_index + 16, std::uint64_t{1} << 30);
  EXPECT_THAT(refusal(bytes), HasSubstr("more than its"));
  put_number(bytes, ktx2_offset::width, 1u << 15);
  EXPECT_THAT(refusal(bytes), HasSubstr("--max-pixels"));
  // Whoever wants another kind of texture says so first.
  const auto other_kind = [](const Ktx2& texture) {
    EXPECT_TRUE(texture.levels.empty());
    throw Error("another kind");
  };
  write_bytes(path_, bytes);
  EXPECT_EQ(failure_of("", [&] { read_ktx2(path_, other_kind); }), "another kind");
}

TEST_F(Ktx2BadInput, TexturesThatContradictThemselvesAreNotWritten) {
  const auto refused = [&](const std::function<void(Ktx2&)>& change) {
    Ktx2 texture = noise_texture(VkFormat::rgba8_srgb, 4, 4);
    change(texture);
    EXPECT_THROW(write_ktx2(path_, texture), Error);
    EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
  };
  refused([](Ktx2& t) { t.levels[0].pop_back(); });
  refused([](Ktx2& t) { t.levels.clear(); });
  refused([](Ktx2& t) { t.levels.resize(4); });
  refused([](Ktx2& t) { t.width = 0; });
  refused([](Ktx2& t) { t.height = 0; });
  refused([](Ktx2& t) { t.faces = 2; });
  refused([](Ktx2& t) { t.format = VkFormat{1000}; });
  refused([](Ktx2& t) { t.metadata[""] = "no key"; });
  refused([](Ktx2& t) { t.metadata[std::string("a\0b", 3)] = "x"; });
}

TEST_F(Ktx2BadInput, MissingFilesAndFoldersAreNamed) {
  EXPECT_THROW(read_ktx2(folder_ / "nothing.ktx2"), Error);
  EXPECT_THROW(read_ktx2(folder_.path()), Error);
  EXPECT_THROW(write_ktx2(folder_ / "no" / "a.ktx2", noise_texture(VkFormat::r8_unorm, 1, 1)), Error);
}

}  // namespace
}  // namespace sateen::io
