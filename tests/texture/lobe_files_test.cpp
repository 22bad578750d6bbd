// SPDX-License-Identifier: MIT
#include "sateen/texture/lobe_files.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sateen/core/error.h"
#include "sateen/io/image.h"
#include "sateen/io/ktx2.h"
#include "sateen/texture/aniso_author.h"
#include "support/files.h"
#include "texture/dds.h"

namespace sateen::texture {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

namespace fs = std::filesystem;

/// A bumpy normal map, stored n / 2 + 1/2.
Image bumps(int width, int height, int channels = 3) {
  Image image(width, height, channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Vec3 n = Vec3(0.6 * std::sin(0.7 * x), 0.4 * std::cos(0.9 * y), 1).normalized();
      for (int c = 0; c < std::min(channels, 3); ++c) image.at(x, y, c) = static_cast<float>(n[c] / 2 + 0.5);
    }
  }
  return image;
}

Image lobes(int width, int height, AnisotropyEncoding encoding = AnisotropyEncoding::root) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Vec3 c = encode_anisotropy(brdf::roughness_matrix({0.4, 0.1, 0.1 * x + 0.05 * y}), encoding);
      for (int k = 0; k < 3; ++k) image.at(x, y, k) = static_cast<float>(c[k]);
    }
  }
  return image;
}

LobeMapFiles maps_of(const fs::path& normals, const fs::path& anisotropy = {},
                     const fs::path& roughness = {}) {
  LobeMapFiles files;
  files.normals = normals;
  files.anisotropy = anisotropy;
  files.roughness = roughness;
  return files;
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

Vec3 decoded(std::vector<float> pixel, const NormalMapFormat& format = {}) {
  bool repaired = false;
  return decode_normal(pixel, format, repaired);
}

bool is_repaired(std::vector<float> pixel, const NormalMapFormat& format = {}) {
  bool repaired = false;
  decode_normal(pixel, format, repaired);
  return repaired;
}

TEST(DecodeNormal, KnowsTheUsualFormats) {
  const Vec3 n = Vec3(0.3, -0.4, 1).normalized();
  const auto f = [](double v) { return static_cast<float>(v); };
  const std::vector<float> stored{f(n.x() / 2 + 0.5), f(n.y() / 2 + 0.5), f(n.z() / 2 + 0.5)};
  EXPECT_NEAR((decoded(stored) - n).norm(), 0, 1e-6);
  EXPECT_NEAR((decoded({stored[0], stored[1]}) - n).norm(), 0, 1e-6);
  EXPECT_NEAR((decoded({stored[0], stored[1], 0}) - n).norm(), 0, 1e-6) << "blue channel is missing";
  EXPECT_NEAR((decoded({stored[0], 1 - stored[1], stored[2]}, {true, false}) - n).norm(), 0, 1e-6);
  EXPECT_NEAR((decoded({f(n.x()), f(n.y()), f(n.z())}, {false, true}) - n).norm(), 0, 1e-6);
  EXPECT_FALSE(is_repaired(stored));
}

TEST(DecodeNormal, MendsWhatHasNoDirection) {
  EXPECT_EQ(decoded({0, 0, 0}), Vec3::UnitZ());
  EXPECT_TRUE(is_repaired({0, 0, 0}));
  EXPECT_EQ(decoded({0, 0, 0}, {false, true}), Vec3::UnitZ());
  EXPECT_TRUE(is_repaired({1, 1, 0})) << "x and y are longer than 1";
  EXPECT_NEAR(decoded({1, 1}).norm(), 1, 1e-12);
  EXPECT_GT(decoded({1, 1}).z(), 0);
  EXPECT_GT(decoded({1, 0.5f, 0.2f}).z(), 0) << "into the surface";
}

TEST(LobeFiles, BadInputIsNamed) {
  const TemporaryFolder folder;
  io::write_data(folder / "normal.png", bumps(16, 8));
  io::write_data(folder / "small.png", lobes(8, 8));
  io::write_data(folder / "grey.png", Image(16, 8, 1, 0.5f));
  const auto open = [&](LobeMapFiles files) { return message_of([&] { LobeFileSource source(files); }); };
  EXPECT_THAT(open({}), HasSubstr("nothing to filter"));
  EXPECT_THAT(open(maps_of(folder / "none.png")), HasSubstr("none.png"));
  EXPECT_THAT(open(maps_of(folder / "normal.png", folder / "small.png")),
              HasSubstr("small.png: is 8 x 8 but"));
  EXPECT_THAT(open(maps_of(folder / "grey.png")), HasSubstr("one channel"));
  EXPECT_THAT(open(maps_of({}, folder / "grey.png")), HasSubstr("three"));
  std::ofstream(folder / "text.png") << "not a picture";
  EXPECT_THAT(open(maps_of(folder / "text.png")), HasSubstr("text.png"));
}

TEST(LobeFiles, DamagedInputLeavesNothing) {
  const TemporaryFolder folder;
  io::write_data(folder / "normal.png", bumps(64, 64));
  fs::resize_file(folder / "normal.png", fs::file_size(folder / "normal.png") / 2);
  for (const LobeOutput::Kind kind : {LobeOutput::Kind::png, LobeOutput::Kind::ktx2_blocks}) {
    LobeOutput output;
    output.kind = kind;
    EXPECT_THAT(message_of([&] {
                  LobeFileSource source(maps_of(folder / "normal.png"));
                  write_lobe_chain(source, folder / "out.png", {}, output);
                }),
                HasSubstr("normal.png"));
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST(LobeFiles, PicturesHoldEveryLevelOfOddSizes) {
  const TemporaryFolder folder;
  io::write_data(folder / "normal.png", bumps(21, 13));
  io::write_data(folder / "aniso.png", lobes(21, 13));
  for (const LobeOutput::Kind kind : {LobeOutput::Kind::png, LobeOutput::Kind::png8, LobeOutput::Kind::exr}) {
    LobeFileSource source(maps_of(folder / "normal.png", folder / "aniso.png"));
    LobeOutput output;
    output.kind = kind;
    const auto files = write_lobe_chain(source, folder / "mip.png", {}, output);
    ASSERT_EQ(files.size(), 10u);
    EXPECT_EQ(source.repaired(), 0u);
    const Image first = io::read_data(files[0]);
    const Image aniso = io::read_data(files[1]);
    const Image expected = bumps(21, 13);
    const float tolerance = kind == LobeOutput::Kind::png ? 1e-4f : 4e-3f;
    for (std::size_t i = 0; i < expected.data.size(); ++i) {
      const float stored = kind == LobeOutput::Kind::exr ? first.data[i] / 2 + 0.5f : first.data[i];
      ASSERT_NEAR(stored, expected.data[i], tolerance);
      ASSERT_NEAR(aniso.data[i], lobes(21, 13).data[i], tolerance);
    }
    EXPECT_EQ(io::read_image_info(files[4]).width, 5);
    EXPECT_EQ(io::read_image_info(files[4]).height, 3);
    EXPECT_EQ(io::read_image_info(files[9]).width, 1);
  }
}

TEST(LobeFiles, Ktx2HoldsTheSameValuesAsPictures) {
  const TemporaryFolder folder;
  io::write_data(folder / "normal.png", bumps(32, 24));
  io::write_data(folder / "aniso.png", lobes(32, 24));
  const LobeMapFiles maps = maps_of(folder / "normal.png", folder / "aniso.png");
  LobeFileSource for_pictures(maps);
  LobeOutput output;
  output.kind = LobeOutput::Kind::png8;
  ChainOptions chain;
  chain.kernel = MipKernel::kaiser;
  const auto pictures = write_lobe_chain(for_pictures, folder / "mip.png", chain, output);
  output.kind = LobeOutput::Kind::ktx2;
  LobeFileSource for_texels(maps);
  const auto plain = write_lobe_chain(for_texels, folder / "plain.ktx2", chain, output);
  output.kind = LobeOutput::Kind::ktx2_blocks;
  output.effort = Bc7Effort::best;
  LobeFileSource for_blocks(maps);
  const auto blocks = write_lobe_chain(for_blocks, folder / "blocks.ktx2", chain, output);

  const io::Ktx2 normal = io::read_ktx2(plain[0]);
  const io::Ktx2 aniso = io::read_ktx2(plain[1]);
  EXPECT_EQ(normal.format, io::VkFormat::rg8_unorm);
  EXPECT_EQ(aniso.metadata.at("SateenAnisotropy"), "root");
  ASSERT_EQ(normal.levels.size(), 6u);
  for (std::size_t level = 0; level < 6; ++level) {
    const Image n = io::read_data(pictures[level * 2]);
    const Image a = io::read_data(pictures[level * 2 + 1]);
    for (int i = 0; i < n.width * n.height; ++i) {
      for (int c = 0; c < 2; ++c) {
        ASSERT_NEAR(std::to_integer<int>(normal.levels[level][static_cast<std::size_t>(i * 2 + c)]),
                    n.at(i % n.width, i / n.width, c) * 255, 1.01);
      }
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(std::to_integer<int>(aniso.levels[level][static_cast<std::size_t>(i * 4 + c)]),
                    a.at(i % a.width, i / a.width, c) * 255, 1.01);
      }
    }
  }
  EXPECT_EQ(io::read_ktx2(blocks[0]).format, io::VkFormat::bc5_unorm);
  const io::Ktx2 bc7 = io::read_ktx2(blocks[1]);
  EXPECT_EQ(bc7.format, io::VkFormat::bc7_unorm);
  const auto texels = test::decode_blocks(BlockFormat::bc7, bc7.levels[0], 32, 24, folder / "level.dds");
  double sum = 0;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    if (i % 4 == 3) continue;
    sum += std::pow(double(texels[i]) - std::to_integer<int>(aniso.levels[0][i]), 2);
  }
  EXPECT_LT(std::sqrt(sum / (32 * 24 * 3)), 4);
}

TEST(LobeFiles, RoughnessMapsAndConstantsMayReplaceTheAnisotropyMap) {
  const TemporaryFolder folder;
  io::write_data(folder / "rough.png", Image(8, 8, 1, 0.5f));
  std::vector<LobeTexel> texels(64);
  LobeFileSource rough(maps_of({}, {}, folder / "rough.png"));
  rough.read(texels);
  EXPECT_NEAR(brdf::roughness_from_matrix(texels[5].s).alpha_t, 0.25, 1e-4);
  EXPECT_EQ(texels[5].normal, Vec3::UnitZ());
  // Nothing is rougher than 1.
  std::vector<LobeTexel> roughest(64);
  io::write_data(folder / "one.exr", Image(8, 8, 1, 1));
  io::write_data(folder / "more.exr", Image(8, 8, 1, 1.5f));
  LobeFileSource one(maps_of({}, {}, folder / "one.exr"));
  one.read(roughest);
  LobeFileSource more(maps_of({}, {}, folder / "more.exr"));
  more.read(texels);
  EXPECT_EQ(texels[5].s, roughest[5].s);
  io::write_data(folder / "normal.png", bumps(8, 8));
  LobeMapFiles files = maps_of(folder / "normal.png");
  files.constant = {0.3, 0.2, 0.5};
  LobeFileSource constant(files);
  constant.read(texels);
  EXPECT_NEAR(brdf::roughness_from_matrix(texels[9].s).alpha_b, 0.2, 1e-9);
}

TEST(Author, ConstantsAndMapsMeet) {
  const TemporaryFolder folder;
  Image rotation(6, 3, 1);
  for (int x = 0; x < 6; ++x) {
    for (int y = 0; y < 3; ++y) rotation.at(x, y, 0) = static_cast<float>(x) / 6;
  }
  io::write_data(folder / "rotation.png", rotation);
  AuthorInputs in;
  in.along = parse_map_input("0.6");
  in.across = parse_map_input("0.3");
  in.rotation = parse_map_input((folder / "rotation.png").string() + ":r");
  for (const auto encoding : {AnisotropyEncoding::root, AnisotropyEncoding::correlation}) {
    author_anisotropy(in, folder / "aniso.png", encoding);
    const Image map = io::read_data(folder / "aniso.png");
    ASSERT_EQ(map.width, 6);
    for (int x = 0; x < 6; ++x) {
      const Mat2 s = decode_anisotropy({map.at(x, 1, 0), map.at(x, 1, 1), map.at(x, 1, 2)}, encoding);
      EXPECT_NEAR((s - brdf::roughness_matrix({0.36, 0.09, 2 * kPi * x / 6})).norm(), 0, 2e-4);
    }
  }
}

TEST(Author, EveryStyleComesBackThroughDecode) {
  const TemporaryFolder folder;
  io::write_data(folder / "aniso.exr", lobes(9, 5));
  const auto check = [&](AuthorInputs in) {
    author_anisotropy(in, folder / "again.exr", AnisotropyEncoding::root);
    const Image again = io::read_data(folder / "again.exr");
    const Image expected = lobes(9, 5);
    for (std::size_t i = 0; i < expected.data.size(); ++i) ASSERT_NEAR(again.data[i], expected.data[i], 1e-4);
  };
  const auto decode = [&](DecodeStyle style) {
    return decode_anisotropy_map(folder / "aniso.exr", AnisotropyEncoding::root, style, folder / "style.exr");
  };
  AuthorInputs in;
  in.roughness = {folder / "style.exr", 0, 0};
  in.amount = {folder / "style.exr", 1, 0};
  in.rotation = {folder / "style.exr", 2, 0};
  for (const char* style : {"blender", "substance", "materialx", "filament"}) {
    decode(decode_style_from_name(style));
    in.style = anisotropy_style_from_name(style);
    check(in);
  }
  decode(DecodeStyle::uv);
  AuthorInputs uv;
  uv.along = in.roughness;
  uv.across = in.amount;
  uv.rotation = in.rotation;
  uv.turns_at_one = 0.5;
  check(uv);
  const auto files = decode(DecodeStyle::gltf);
  ASSERT_EQ(files.size(), 2u);
  AuthorInputs gltf;
  gltf.style = AnisotropyStyle::gltf;
  gltf.roughness = {files[1], 1, 0};
  gltf.amount.value = 1;
  gltf.vectors = files[0];
  check(gltf);
}

TEST(Author, ConstantAnglesAreTurnsWhateverAMapHolds) {
  const TemporaryFolder folder;
  AuthorInputs in;
  in.along.value = 0.6;
  in.across.value = 0.3;
  in.rotation.value = 1 / 12.0;
  in.turns_at_one = 0.25;
  author_anisotropy(in, folder / "a.exr", AnisotropyEncoding::root);
  decode_anisotropy_map(folder / "a.exr", AnisotropyEncoding::root, DecodeStyle::alphas, folder / "d.exr");
  // Squares of the roughness, and thirty degrees of half a turn.
  EXPECT_LT((io::read_data(folder / "d.exr").rgb(0, 0) - Vec3f(0.36f, 0.09f, 1 / 6.0f)).norm(), 1e-3f);
}

TEST(Author, BadInputIsNamed) {
  const TemporaryFolder folder;
  io::write_data(folder / "a.png", Image(8, 8, 1, 0.5f));
  io::write_data(folder / "b.png", Image(8, 4, 1, 0.5f));
  AuthorInputs in;
  in.along = {folder / "a.png", 0, 0};
  in.across = {folder / "b.png", 0, 0};
  const auto author = [&](const fs::path& output) {
    return message_of([&] { author_anisotropy(in, output, AnisotropyEncoding::root); });
  };
  EXPECT_THAT(author(folder / "out.png"), HasSubstr("b.png: is 8 x 4 but"));
  in.across = {folder / "a.png", 2, 0};
  EXPECT_THAT(author(folder / "out.png"), HasSubstr("channel 3"));
  in.across = {};
  EXPECT_THAT(author(folder / "out.gif"), HasSubstr("out.gif"));
  EXPECT_FALSE(fs::exists(folder / "out.png"));
}

}  // namespace
}  // namespace sateen::texture
