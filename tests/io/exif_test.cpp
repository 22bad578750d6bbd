// SPDX-License-Identifier: MIT
#include "sateen/io/exif.h"

#include <algorithm>
#include <cstring>
#include <span>

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "sateen/io/image_rows.h"
#include "sateen/io/picture8.h"
#include "support/files.h"

namespace sateen::io {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

/// An EXIF block with one directory of the camera inside another, in either byte order.
class Block {
 public:
  explicit Block(bool big_endian) : big_endian_(big_endian) {
    text(big_endian ? "MM" : "II");
    number(42, 2);
    number(8, 4);
    number(2, 2);  // entries: orientation, where the inner directory lies
    entry(0x0112, 3, 6);
    entry(0x8769, 4, 38);
    number(0, 4);
    number(3, 2);  // at 38: exposure time, focal length, the same for 35 mm
    entry(0x829a, 5, 80);
    entry(0x920a, 5, 88);
    entry(0xa405, 3, 52);
    number(0, 4);
    for (const unsigned v : {1u, 250u, 350u, 10u}) number(v, 4);  // at 80: 1/250 s, 35 mm
  }
  std::vector<std::byte> bytes;

 private:
  void text(const char* characters) {
    for (; *characters != '\0'; ++characters) bytes.push_back(static_cast<std::byte>(*characters));
  }
  void number(unsigned value, int count) {
    for (int i = 0; i < count; ++i)
      bytes.push_back(static_cast<std::byte>(value >> 8 * (big_endian_ ? count - 1 - i : i) & 0xff));
  }
  void entry(unsigned tag, unsigned type, unsigned value) {
    number(tag, 2);
    number(type, 2);
    number(1, 4);
    number(value, type == 3 ? 2 : 4);
    if (type == 3) number(0, 2);
  }
  bool big_endian_;
};

void expect_notes(const ExifNotes& notes) {
  EXPECT_EQ(notes.orientation, 6);
  EXPECT_DOUBLE_EQ(notes.exposure_time, 1.0 / 250);
  EXPECT_DOUBLE_EQ(notes.focal_mm, 35);
  EXPECT_DOUBLE_EQ(notes.focal_35mm, 52);
}

TEST(Exif, BothByteOrdersAreRead) {
  for (const bool big_endian : {false, true}) {
    SCOPED_TRACE(big_endian);
    const Block block(big_endian);
    ASSERT_EQ(block.bytes.size(), 96u);
    expect_notes(read_exif(block.bytes));
  }
}

TEST(Exif, BrokenBlocksSayWhatTheyCan) {
  const Block block(true);
  for (std::size_t length = 0; length < block.bytes.size(); ++length) {
    const ExifNotes notes = read_exif(std::span(block.bytes).first(length));
    EXPECT_TRUE(notes.orientation == 1 || notes.orientation == 6) << length;
    EXPECT_TRUE(notes.focal_mm == 0 || notes.focal_mm == 35) << length;
  }
  std::vector<std::byte> loop = block.bytes;
  loop[24 + 8 + 3 - 2] = std::byte{0};
  read_exif(loop);
}

TEST(Exif, NumbersThatCannotBeAreNotTaken) {
  std::vector<std::byte> block = Block(true).bytes;
  block[19] = std::byte{9};   // an orientation
  block[81] = std::byte{40};  // 1/250 becomes 2,621,441
  block[86] = std::byte{0};
  block[87] = std::byte{1};
  const ExifNotes notes = read_exif(block);
  EXPECT_EQ(notes.orientation, 1);
  EXPECT_EQ(notes.exposure_time, 0);
  EXPECT_EQ(notes.focal_mm, 35);
}

/// A WebP with the block in its last chunk, behind one of odd length.
void write_webp_with(const fs::path& path, const std::vector<std::byte>& block) {
  write_image(path, Image(37, 23, 3, 0.5f));
  const std::string plain = read_text(path);
  std::string chunks;
  const auto chunk = [&](const std::string& name, const std::string& data) {
    chunks += name;
    for (int i = 0; i < 4; ++i) chunks += static_cast<char>(data.size() >> 8 * i & 0xff);
    chunks += data + (data.size() % 2 == 1 ? std::string(1, '\0') : "");
  };
  chunk("VP8X", {0x0c, 0, 0, 0, 36, 0, 0, 22, 0, 0});  // EXIF and XMP, 37 x 23
  chunks += plain.substr(12);
  chunk("XMP ", "odd");
  chunk("EXIF",
        std::string("Exif\0\0", 6) + std::string(reinterpret_cast<const char*>(block.data()), block.size()));
  std::string file = "RIFF";
  for (int i = 0; i < 4; ++i) file += static_cast<char>((chunks.size() + 4) >> 8 * i & 0xff);
  write_text(path, file + "WEBP" + chunks);
}

/// A PNG with the block in front of its pixels.
void write_png_with(const fs::path& path, const std::vector<std::byte>& block) {
  write_image(path, Image(37, 23, 3, 0.5f));
  std::vector<std::byte> bytes = read_bytes(path);
  std::vector<std::byte> chunk;
  const auto number = [&](std::size_t v) {
    for (int shift : {24, 16, 8, 0}) chunk.push_back(static_cast<std::byte>(v >> shift & 0xff));
  };
  number(block.size());
  for (const char c : {'e', 'X', 'I', 'f'}) chunk.push_back(static_cast<std::byte>(c));
  chunk.insert(chunk.end(), block.begin(), block.end());
  std::uint32_t crc = 0xffffffff;
  for (std::size_t i = 4; i < chunk.size(); ++i) {
    crc ^= std::to_integer<std::uint32_t>(chunk[i]);
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? 0xedb88320 ^ crc >> 1 : crc >> 1;
  }
  number(~crc);
  bytes.insert(bytes.begin() + 33, chunk.begin(), chunk.end());  // behind the header
  write_bytes(path, bytes);
}

TEST(Exif, IsFoundInPngAndWebp) {
  const TemporaryFolder folder;
  for (const bool big_endian : {false, true}) {
    write_png_with(folder / "a.png", Block(big_endian).bytes);
    write_webp_with(folder / "a.webp", Block(big_endian).bytes);
    for (const char* name : {"a.png", "a.webp"}) {
      SCOPED_TRACE(name);
      expect_notes(read_exif_of_file(folder / name));
      EXPECT_EQ(read_image_info(folder / name).width, 23);
      EXPECT_EQ(read_image(folder / name).height, 37);
    }
  }
}

/// A JPEG with the block in its second segment.
std::vector<std::byte> jpeg_with(const fs::path& path, const std::vector<std::byte>& block) {
  Image picture(37, 23, 3);
  for (std::size_t i = 0; i < picture.data.size(); ++i) picture.data[i] = static_cast<float>(i % 111) / 110;
  write_image(path, picture);
  std::vector<std::byte> bytes = read_bytes(path);
  std::vector<std::byte> segment{std::byte{0xff}, std::byte{0xe1}, std::byte{0},
                                 static_cast<std::byte>(block.size() + 8)};
  for (const char c : {'E', 'x', 'i', 'f', '\0', '\0'}) segment.push_back(static_cast<std::byte>(c));
  segment.insert(segment.end(), block.begin(), block.end());
  const auto first = 4 + (static_cast<std::ptrdiff_t>(bytes[4]) << 8 | static_cast<std::ptrdiff_t>(bytes[5]));
  bytes.insert(bytes.begin() + first, segment.begin(), segment.end());
  write_bytes(path, bytes);
  return bytes;
}

TEST(Exif, IsFoundInAJpegAsOpenImageIoFindsIt) {
  const TemporaryFolder folder;
  for (const bool big_endian : {false, true}) {
    const fs::path path = folder / "a.jpg";
    jpeg_with(path, Block(big_endian).bytes);
    expect_notes(read_exif_of_file(path));
    EXPECT_EQ(read_image_info(path).width, 23);
    EXPECT_EQ(read_image(path).height, 37);
    EXPECT_EQ(read_picture8(path).height, 37);
    // Row by row, in two pieces.
    const Image whole = read_data(path);
    ImageRowReader rows(path);
    std::vector<float> streamed(whole.data.size());
    const std::size_t first = static_cast<std::size_t>(rows.width()) * 3 * 20;
    rows.read(std::span(streamed).first(first));
    rows.read(std::span(streamed).subspan(first));
    EXPECT_EQ(streamed, whole.data);
    const auto input = OIIO::ImageInput::open(path.string());
    ASSERT_TRUE(input);
    EXPECT_EQ(input->spec().get_int_attribute("Orientation"), 6);
    EXPECT_FLOAT_EQ(input->spec().get_float_attribute("Exif:FocalLength"), 35);
    EXPECT_FLOAT_EQ(input->spec().get_float_attribute("ExposureTime"), 1.0f / 250);
  }
}

TEST(Exif, IsFoundInJpegAndTiffWrittenByOpenImageIo) {
  const TemporaryFolder folder;
  for (const char* name : {"a.jpg", "a.tif"}) {
    OIIO::ImageSpec spec(4, 3, 3, OIIO::TypeDesc::UINT8);
    spec["Exif:FocalLength"] = 35.0f;
    spec["Exif:FocalLengthIn35mmFilm"] = 52;
    spec["ExposureTime"] = 1.0f / 250;
    spec["Orientation"] = 6;
    const fs::path path = folder / name;
    const auto output = OIIO::ImageOutput::create(path.string());
    ASSERT_TRUE(output->open(path.string(), spec));
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT8, std::vector<std::uint8_t>(36).data()) &&
                output->close());
    const ExifNotes notes = read_exif_of_file(path);
    EXPECT_EQ(notes.orientation, 6) << name;
    EXPECT_NEAR(notes.focal_mm, 35, 1e-4) << name;
    EXPECT_NEAR(notes.exposure_time, 1.0 / 250, 1e-6) << name;
  }
}

TEST(Exif, FilesWithoutSayNothing) {
  const TemporaryFolder folder;
  write_image(folder / "a.png", Image(3, 3, 3));
  write_text(folder / "a.txt", "no picture");
  for (const char* name : {"a.png", "a.txt", "none.jpg", "."}) {
    EXPECT_EQ(read_exif_of_file(folder / name).orientation, 1) << name;
    EXPECT_EQ(read_exif_of_file(folder / name).focal_mm, 0) << name;
  }
}

}  // namespace
}  // namespace sateen::io
