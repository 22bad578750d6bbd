// SPDX-License-Identifier: MIT
#include <fstream>
#include <random>

#include <gmock/gmock.h>

#include "brdf/random_directions.h"
#include "sateen/brdf/conventions.h"
#include "sateen/brdf/layered/layered.h"
#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/io/image.h"
#include "sateen/io/ktx2.h"
#include "sateen/scene/registry.h"
#include "sateen/texture/lobe_files.h"
#include "sateen/texture/mapped_appearance.h"
#include "support/files.h"
#include "support/rendering.h"
#include "support/shapes.h"
#include "support/sky.h"

namespace sateen::texture {
namespace {

using testing::HasSubstr;

constexpr double kTolerance = 5e-3;

light::Lighting lamps() {
  light::Lighting lighting;
  light::PunctualLight key;
  key.direction = Vec3(-0.3, 0.4, 0.8).normalized();
  light::PunctualLight point;
  point.kind = light::PunctualLight::Kind::point;
  point.position = {1, 0.5, -2};
  point.colour = {2, 3, 4};
  lighting.lamps = {key, point};
  return lighting;
}

light::Lighting surroundings() {
  Image sky(64, 32, 3);
  for (int y = 0; y < sky.height; ++y) {
    for (int x = 0; x < sky.width; ++x) {
      sky.set_rgb(
          x, y,
          Vec3f(0.6f + 0.4f * std::sin(0.2f * static_cast<float>(x)), 0.5f, 1 - static_cast<float>(y) / 32));
    }
  }
  light::Lighting lighting = lamps();
  lighting.surroundings = light::make_surroundings(sky);
  return lighting;
}

struct Maps {
  LobeMips mips;
  MappedMaterial material;
};

std::shared_ptr<MappedAppearance> mapped(Maps maps, const Vec3& base = {0.2, 0.15, 0.1}) {
  maps.material.base.color = base;
  return std::make_shared<MappedAppearance>(std::move(maps.mips), std::move(maps.material));
}

/// Unrelated lobes and normals side by side; with `any` the channels are no lobes at all, as damaged maps
/// hold them.
Maps adversarial(AnisotropyEncoding encoding, bool any) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(0, 1);
  const auto between = [&](double low, double high) { return low + (high - low) * value(random); };
  Maps maps;
  maps.material.f0 = {0.5, 0.4, 0.3};
  maps.mips.encoding = encoding;
  Image normals(5, 4, 2);
  Image lobes(5, 4, 3);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 5; ++x) {
      const double a = between(0, 2 * kPi);
      // Thin lobes across each other make the interpolated correlation non-positive or larger than 1.
      const Vec3 c = any ? Vec3(value(random), value(random), value(random))
                         : encode_anisotropy(brdf::roughness_matrix({between(0.5, 1), 0.15, a}), encoding);
      for (int k = 0; k < 2; ++k) normals.at(x, y, k) = static_cast<float>(between(0.3, 0.7));
      for (int k = 0; k < 3; ++k) lobes.at(x, y, k) = static_cast<float>(c[k]);
    }
  }
  maps.mips.normals = {normals};
  maps.mips.anisotropy = {lobes};
  return maps;
}

TEST(MappedOnGpu, EqualsTheEvaluatorBetweenUnrelatedTexels) {
  const auto maps = [] { return adversarial(AnisotropyEncoding::root, false); };
  test::expect_matches_evaluator(test::plane(), mapped(maps()), kTolerance, {}, {}, surroundings());
  test::expect_matches_evaluator(test::torus(), mapped(maps()), kTolerance, {}, {}, lamps());
}

TEST(MappedOnGpu, BadMatricesAreGuardedAsInTheEvaluator) {
  // Thin lobes across each other, then channels that are no lobes at all: what lies between them is singular
  // or larger than 1. At the smallest alphas the highlight is a matter of the last digits, hence the share.
  for (const auto encoding : {AnisotropyEncoding::root, AnisotropyEncoding::correlation}) {
    for (const bool any : {false, true}) {
      const scene::Scene scene =
          test::scene_of(test::plane(), mapped(adversarial(encoding, any)), {}, surroundings());
      const render::Picture frame = test::render(scene, {});
      const auto difference = test::against_evaluator(frame, scene, 0.05);
      EXPECT_GT(difference.pixels, 1000);
      EXPECT_LT(difference.failing_share(), 0.01) << name_of(encoding) << any;
      for (const float v : frame.colour.data) ASSERT_TRUE(std::isfinite(v));
    }
  }
}

TEST(Mapped, ChannelsInRangeAreNeverNegativeButMayBeSingularOrTooLarge) {
  // The determinant of `correlation` is Sxx Syy (1 - c^2) with |c| <= 1, and `root` is a square: no
  // interpolation and no block compression makes either negative. The guard is for the other two cases.
  std::mt19937 random(8);
  std::uniform_real_distribution<double> value(0, 1);
  for (const auto encoding : {AnisotropyEncoding::root, AnisotropyEncoding::correlation}) {
    double least = 1;
    double largest = 0;
    for (int i = 0; i < 5000; ++i) {
      Vec3 c(value(random), value(random), value(random));
      if (i % 10 == 0) c = Vec3(1, i % 20 == 0 ? 1 : 0, 1);
      const Mat2 s = decode_anisotropy(c, encoding);
      const double mean = s.trace() / 2;
      const double radius = std::hypot((s(0, 0) - s(1, 1)) / 2, s(0, 1));
      ASSERT_GE(mean - radius, -1e-12);
      least = std::min(least, mean - radius);
      largest = std::max(largest, mean + radius);
      const brdf::AnisotropicRoughness lobe = brdf::roughness_from_matrix(s);
      ASSERT_GE(lobe.alpha_b, brdf::kMinimumAlpha);
      ASSERT_LE(lobe.alpha_t, 1);
    }
    EXPECT_LT(least, 1e-6);
    EXPECT_GT(largest, 1.5);
  }
}

TEST(Mapped, FlatMapsUnderLampsAreTheLayeredMaterial) {
  Maps maps;
  maps.mips.normals = {Image(2, 2, 2, 0.5f)};
  const Vec3 c = encode_anisotropy(brdf::roughness_matrix({0.5, 0.2, 0.7}), AnisotropyEncoding::root);
  Image lobes(2, 2, 3);
  for (int i = 0; i < 12; ++i) lobes.data[static_cast<std::size_t>(i)] = static_cast<float>(c[i % 3]);
  maps.mips.anisotropy = {lobes};
  maps.material.f0 = {0.5, 0.4, 0.3};
  brdf::LayeredMaterial material;
  material.base.color = {0.2, 0.15, 0.1};
  material.specular = brdf::GgxParameters{{0.5, 0.2, 0.7}, maps.material.f0, false};
  const auto a = mapped(maps);
  const brdf::LayeredAppearance b(material);
  for (int i = 0; i < 40; ++i) {
    appearance::Surface surface;
    surface.view = Vec3(0.9 * std::cos(i), 0.9 * std::sin(2.0 * i), 0.6).normalized();
    surface.position = -2 * surface.view;
    const Vec3 expected = b.radiance(surface, lamps(), {});
    EXPECT_LT((a->radiance(surface, lamps(), {}) - expected).norm(), 2e-3 * expected.norm());
  }
}

/// A map that is the same lobe everywhere on a flat surface.
Maps one_lobe(const brdf::AnisotropicRoughness& lobe, const Vec3& f0) {
  Maps maps;
  maps.mips.normals = {Image(1, 1, 2, 0.5f)};
  const Vec3 c = encode_anisotropy(brdf::roughness_matrix(lobe), AnisotropyEncoding::root);
  Image stored(1, 1, 3);
  stored.set_rgb(0, 0, c.cast<float>());
  maps.mips.anisotropy = {stored};
  maps.material.f0 = f0;
  return maps;
}

TEST(Mapped, UnderASkyIsCloseToTheIntegralOfTheBrdf) {
  // The same lookups as a layered material's, and the same distance from the truth; between the two there is
  // the albedo by table.
  std::mt19937 random(5);
  const Image sky = test::sky();
  light::Lighting lighting;
  lighting.surroundings = light::make_surroundings(sky);
  const Vec3 f0(0.9, 0.6, 0.3);
  for (const brdf::AnisotropicRoughness& lobe :
       {brdf::AnisotropicRoughness{0.6, 0.15, 0.4}, brdf::AnisotropicRoughness{0.3, 0.3, 0},
        brdf::AnisotropicRoughness{0.4, 0.06, 1.2}}) {
    brdf::LayeredMaterial black;
    black.base.color = Vec3::Zero();
    const auto maps = mapped(one_lobe(lobe, f0), Vec3::Zero());
    black.specular = brdf::GgxParameters{lobe, f0, false};
    black.lobe_samples = 8;
    const brdf::LayeredAppearance layered(black);
    double error = 0;
    double layered_error = 0;
    double between = 0;
    constexpr int kViews = 12;
    for (int i = 0; i < kViews; ++i) {
      appearance::Surface surface;
      surface.view = test::random_up(random, 0.15);
      const Vec3 exact =
          test::summed([&](const Vec3& u) { return brdf::ggx_brdf(lobe, f0, u, surface.view); }, sky);
      const Vec3 a = maps->radiance(surface, lighting, {});
      const Vec3 b = layered.radiance(surface, lighting, {});
      error += (a - exact).norm() / exact.norm() / kViews;
      layered_error += (b - exact).norm() / exact.norm() / kViews;
      between = std::max(between, (a - b).norm() / b.norm());
    }
    RecordProperty("layered", std::to_string(layered_error));
    EXPECT_LT(error, 0.06);
    EXPECT_LT(between, 0.01);
  }
}

TEST(Mapped, BumpsSeenFromBehindAreDents) {
  // A Lambert sheet under one lamp: the cosine to the normal that the map gives the front, turned around.
  Maps maps = one_lobe({0.5, 0.5, 0}, Vec3::Zero());
  maps.mips.normals[0].data = {0.5f + 0.5f * 0.3f, 0.5f - 0.5f * 0.2f};
  light::Lighting lighting;
  light::PunctualLight lamp;
  lamp.direction = Vec3(0.5, 0.3, 0.8).normalized();
  lighting.lamps = {lamp};
  const auto sheet = mapped(std::move(maps), Vec3::Ones());
  // The sheet's front looks away: its tangent and bitangent in view space, and its normal towards -z.
  const Mat3 front = (Mat3() << -Vec3::UnitX(), Vec3::UnitY(), -Vec3::UnitZ()).finished();
  const Vec3 n(0.3, -0.2, std::sqrt(1 - 0.13));
  appearance::Surface surface;
  surface.normal = surface.mesh_normal = -front.col(2);
  surface.tangent = front.col(0);
  surface.side = -1;
  surface.bitangent_sign = -1;  // keeps the bitangent where it was
  ASSERT_LT((surface.bitangent_sign * surface.normal.cross(surface.tangent) - front.col(1)).norm(), 1e-9);
  const double expected = (-(front * n)).dot(lamp.direction) / kPi;
  EXPECT_NEAR(sheet->radiance(surface, lighting, {}).x(), expected, 1e-3);
  // On the GPU, both sides of a sheet that is turned away and to the viewer.
  for (const double turn : {0.3, kPi - 0.3}) {
    test::Shot picture;
    picture.rotation = rotation_xyz({0.2, turn, 0});
    test::expect_matches_evaluator(test::plane(), mapped(adversarial(AnisotropyEncoding::root, false)),
                                   kTolerance, {}, picture, lamps());
  }
}

TEST(Mapped, AlbedoTableIsCloseToTheIntegral) {
  const brdf::GgxAlbedoTable table;
  double worst = 0;
  for (const auto& [t, b] : {std::pair{0.05, 0.05}, std::pair{0.3, 0.3}, std::pair{0.5, 0.1},
                             std::pair{0.9, 0.3}, std::pair{0.87, 0.09}}) {
    for (const double cosine : {0.02, 0.05, 0.1, 0.25, 0.5, 0.75, 0.95}) {
      for (int turn = 0; turn < 11; ++turn) {
        const double phi = 0.3 * turn;
        const double sine = std::sqrt(1 - cosine * cosine);
        const Vec3 view(sine * std::cos(phi), sine * std::sin(phi), cosine);
        const brdf::GgxAlbedo expected = brdf::ggx_albedo({t, b, 0}, view);
        const brdf::GgxAlbedo got = table(t, b, view);
        worst = std::max({worst, std::abs(got.scale - expected.scale), std::abs(got.bias - expected.bias)});
      }
    }
  }
  EXPECT_LT(worst, 0.03);
}

TEST(Mapped, HighlightsRunAlongTheLargerAlpha) {
  // Axis at 30 degrees from U towards V: the highlight under the eye's own lamp is long that way on a square.
  Maps maps;
  maps.mips.normals = {Image(1, 1, 2, 0.5f)};
  const Vec3 c = encode_anisotropy(brdf::roughness_matrix({0.5, 0.1, radians(30)}), AnisotropyEncoding::root);
  Image lobe(1, 1, 3);
  for (int k = 0; k < 3; ++k) lobe.at(0, 0, k) = static_cast<float>(c[k]);
  maps.mips.anisotropy = {lobe};
  light::Lighting lighting;
  light::PunctualLight lamp;
  lamp.direction = Vec3::UnitZ();
  lighting.lamps = {lamp};
  const render::Picture frame = test::render(test::scene_of(test::plane(), mapped(maps), {}, lighting), {});
  Mat2 second = Mat2::Zero();
  const double background = frame.colour.rgb(8, 8).y();
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 128; ++x) {
      const Vec2 d(x - 63.5, 63.5 - y);
      if (d.norm() > 50) continue;
      second += std::max(frame.colour.rgb(x, y).y() - background, 0.0) * d * d.transpose();
    }
  }
  EXPECT_NEAR(degrees(0.5 * std::atan2(2 * second(0, 1), second(0, 0) - second(1, 1))), 30, 2);
}

/// A weave of 32 x 32 texels, threads of 8.
class Weave : public LobeSource {
 public:
  int width() const override { return 32; }
  int height() const override { return 32; }
  void read(std::span<LobeTexel> out) override {
    for (LobeTexel& texel : out) {
      const int x = next_ % 32;
      const int y = next_++ / 32;
      const bool over = (x / 8 + y / 8) % 2 == 0;
      const double across = ((over ? y : x) % 8 - 3.5) / 4;
      texel.normal = over ? Vec3(0, -0.7 * across, 1).normalized() : Vec3(0.7 * across, 0, 1).normalized();
      texel.s = brdf::roughness_matrix({0.3, 0.12, over ? kPi / 2 : 0});
    }
  }

 private:
  int next_ = 0;
};

/// Relative error of a far view of the weave against the mean of 16 x 16 close pixels each.
double far_view_error(FilterMethod method, const light::Lighting& lighting) {
  ChainOptions options;
  options.filter.method = method;
  Weave source;
  Maps maps;
  maps.mips = make_lobe_mips(source, options, AnisotropyEncoding::root);
  maps.material.repeat = {16, 16};
  maps.material.f0 = {0.8, 0.8, 0.8};
  const scene::Scene scene = test::scene_of(test::plane(), mapped(maps), {}, lighting);
  const auto picture = [&](int size) {
    test::Shot p;
    p.width = p.height = size;
    p.surfaces = false;
    return test::render(scene, p).colour;
  };
  const Image far = picture(32);
  const Image truth = resized(picture(512), 32, 32);
  double error = 0;
  double total = 0;
  for (int y = 4; y < 28; ++y) {
    for (int x = 4; x < 28; ++x) {
      error += (far.rgb(x, y) - truth.rgb(x, y)).squaredNorm();
      total += truth.rgb(x, y).squaredNorm();
    }
  }
  return std::sqrt(error / total);
}

TEST(MappedOnGpu, FarViewsLookLikeTheMeanOfCloseOnes) {
  // What remains is that the mean of a weave's lobes is not one lobe, and under the sky that the lookups are
  // themselves approximations, of rough lobes more than of smooth ones. Measured: 0.20 and 0.63 under lamps,
  // 0.14 and 0.32 under the sky as well.
  const double lamp = far_view_error(FilterMethod::sggx_variance, lamps());
  EXPECT_LT(lamp, 0.22);
  EXPECT_LT(lamp, 0.4 * far_view_error(FilterMethod::naive, lamps()));
  const double sky = far_view_error(FilterMethod::sggx_variance, surroundings());
  EXPECT_LT(sky, 0.16);
  EXPECT_LT(sky, 0.5 * far_view_error(FilterMethod::naive, surroundings()));
}

TEST(LobeMips, Ktx2ComesBackAsItWasFiltered) {
  const test::TemporaryFolder folder;
  ChainOptions options;
  Weave in_memory;
  const LobeMips expected = make_lobe_mips(in_memory, options, AnisotropyEncoding::root);
  for (const auto kind : {LobeOutput::Kind::ktx2, LobeOutput::Kind::ktx2_blocks}) {
    Weave source;
    LobeOutput output;
    output.kind = kind;
    output.green_down = kind == LobeOutput::Kind::ktx2;
    const auto files = write_lobe_chain(source, folder / "weave.ktx2", options, output);
    const LobeMips read = read_lobe_mips(files[0], files[1]);
    for (const auto& file : files) {
      const auto metadata = io::read_ktx2_info(file).metadata;
      EXPECT_TRUE(metadata.contains("sateen.kind")) << file;
      EXPECT_TRUE(metadata.contains("sateen.version")) << file;
    }
    EXPECT_EQ(read.green_down, output.green_down);
    EXPECT_EQ(read.encoding, AnisotropyEncoding::root);
    ASSERT_EQ(read.normals.size(), expected.normals.size());
    const double tolerance = kind == LobeOutput::Kind::ktx2 ? 0.51 / 255 : 8.0 / 255;
    for (std::size_t level = 0; level < read.normals.size(); ++level) {
      const Image& n = read.normals[level];
      const Image& a = read.anisotropy[level];
      for (int y = 0; y < n.height; ++y) {
        for (int x = 0; x < n.width; ++x) {
          const float green = expected.normals[level].at(x, y, 1);
          ASSERT_NEAR(n.at(x, y, 0), expected.normals[level].at(x, y, 0), tolerance);
          ASSERT_NEAR(n.at(x, y, 1), read.green_down ? 1 - green : green, tolerance);
          for (int c = 0; c < 3; ++c) {
            ASSERT_NEAR(a.at(x, y, c), expected.anisotropy[level].at(x, y, c), tolerance);
          }
        }
      }
    }
  }
}

TEST(LobeMips, EncodingAndCompressionAreThoseAskedFor) {
  const test::TemporaryFolder folder;
  const auto written = [&](const std::string& name, int zstd_level) {
    Weave source;
    const auto files = write_lobe_chain(source, folder / name, {},
                                        {.kind = LobeOutput::Kind::ktx2,
                                         .encoding = AnisotropyEncoding::correlation,
                                         .zstd_level = zstd_level});
    EXPECT_EQ(read_lobe_mips(files[0], files[1]).encoding, AnisotropyEncoding::correlation);
    return std::filesystem::file_size(files[0]);
  };
  EXPECT_GT(written("plain.ktx2", 0), written("packed.ktx2", 19));
}

TEST(Mapped, MaterialFilesSayHowOftenMapsRepeatAndHowTheyAreMeant) {
  const test::TemporaryFolder folder;
  std::mt19937 random(6);
  std::uniform_real_distribution<float> value(0.3f, 0.7f);
  Image normals(4, 4, 3, 1);
  for (int i = 0; i < 16; ++i) {
    for (int c = 0; c < 2; ++c) normals.at(i % 4, i / 4, c) = value(random);
  }
  io::write_data(folder / "n.exr", normals);
  std::ofstream(folder / "m.json") << R"({"model": "mapped", "normals": "n.exr", "green_down": true,
      "roughness": [0.6, 0.3], "repeat": [2, 3], "f0": 0.6, "base": {"color": 0.1}})";
  const auto read = scene::load_appearance(folder / "m.json");

  LobeMapFiles files;
  files.normals = folder / "n.exr";
  files.normal_format.green_down = true;
  files.constant = brdf::from_uv({0.6, 0.3, 0});
  LobeFileSource source(files);
  Maps maps{make_lobe_mips(source, {}, AnisotropyEncoding::root), {}};
  maps.material.f0 = Vec3::Constant(0.6);
  const auto once = mapped(maps, Vec3::Constant(0.1));
  maps.material.repeat = {2, 3};
  const auto often = mapped(maps, Vec3::Constant(0.1));
  for (const Vec2& uv : {Vec2(0.1, 0.2), Vec2(0.45, 0.3)}) {
    appearance::Surface surface;
    surface.uv = uv;
    const Vec3 expected = often->radiance(surface, lamps(), {});
    EXPECT_LT((read->radiance(surface, lamps(), {}) - expected).norm(), 1e-6);
    surface.uv = uv.cwiseProduct(Vec2(2, 3));
    EXPECT_LT((once->radiance(surface, lamps(), {}) - expected).norm(), 1e-9);
  }
}

TEST(Mapped, MaterialFilesAreReadAndWrongOnesNamed) {
  const test::TemporaryFolder folder;
  const auto load = [&](const std::string& text) -> std::string {
    std::ofstream(folder / "m.json") << text;
    try {
      const auto appearance = scene::load_appearance(folder / "m.json");
      return appearance->radiance({}, lamps(), {}).allFinite() ? "" : "not finite";
    } catch (const Error& error) {
      return error.what();
    }
  };
  const std::string weave = (test::examples() / "textures/weave_normal.png").string();
  EXPECT_EQ(load(R"({"model": "mapped", "normals": ")" + weave +
                 R"(", "roughness": [0.5, 0.3], "repeat": 4, "f0": 0.6, "base": {"color": 0.1}})"),
            "");
  io::write_data(folder / "small.png", Image(8, 8, 3, 0.5f));
  Weave source;
  write_lobe_chain(source, folder / "w.ktx2", {}, {.kind = LobeOutput::Kind::ktx2_blocks});
  EXPECT_EQ(load(R"({"model": "mapped", "normals": "w_normal.ktx2", "anisotropy": "w_aniso.ktx2"})"), "");
  EXPECT_THAT(load(R"({"model": "mapped", "normals": "w_aniso.ktx2", "anisotropy": "w_aniso.ktx2"})"),
              HasSubstr("w_aniso.ktx2: is no such map"));
  EXPECT_THAT(load(R"({"model": "mapped", "normals": "w_normal.ktx2"})"), HasSubstr("both"));
  EXPECT_THAT(load(R"({"model": "mapped"})"), HasSubstr("nothing to filter"));
  EXPECT_THAT(load(R"({"model": "mapped", "normals": ")" + weave + R"(", "anisotropy": "small.png"})"),
              HasSubstr("small.png: is 8 x 8"));
  EXPECT_THAT(load(R"({"model": "mapped", "normals": ")" + weave + R"(", "repeat": 0})"),
              HasSubstr("repeat"));
  EXPECT_THAT(load(R"({"model": "mapped", "normals": ")" + weave + R"(", "bass": 0})"), HasSubstr("bass"));
  EXPECT_THAT(load(R"({"model": "mapped", "normals": ")" + weave + R"(", "fuzz": {}})"), HasSubstr("fuzz"));
}

}  // namespace
}  // namespace sateen::texture
