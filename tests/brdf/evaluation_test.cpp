// SPDX-License-Identifier: MIT
#include "sateen/brdf/evaluation.h"

#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "brdf/random_directions.h"
#include "sateen/brdf/conventions.h"
#include "sateen/brdf/fibre_diffuse.h"
#include "sateen/brdf/fuzz_approximations.h"
#include "sateen/brdf/fuzz_integrals.h"
#include "sateen/brdf/fuzz_table.h"
#include "sateen/brdf/ggx.h"
#include "sateen/brdf/plot.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "support/files.h"

namespace sateen::brdf {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const Vec3 kLight = Vec3(0.3, -0.2, 0.8).normalized();
const Vec3 kView = Vec3(-0.5, 0.4, 0.6).normalized();

Vec3 value(const std::string& model, const std::string& json) {
  return parse_brdf(model, json, "test")({kLight, kView});
}

TEST(Evaluation, ModelsTakeTheirParametersInDegrees) {
  EXPECT_DOUBLE_EQ(value("fibre-diffuse", "{}").x(), fibre_diffuse(kLight));
  EXPECT_LT((value("ggx", R"({"alpha_t": 0.5, "alpha_b": 0.1, "azimuth": 20, "f0": [0.9, 0.5, 0.1]})") -
             ggx_brdf({0.5, 0.1, radians(20)}, {0.9, 0.5, 0.1}, kLight, kView))
                .norm(),
            1e-12);
  FuzzParameters fuzz;
  fuzz.density = 0.3;
  fuzz.alpha = 0.4;
  fuzz.tilt = radians(40);
  fuzz.azimuth = radians(70);
  fuzz.colour = {1, 0.5, 0.2};
  const std::string json =
      R"({"density": 0.3, "alpha": 0.4, "tilt": 40, "azimuth": 70, "color": [1, 0.5, 0.2])";
  EXPECT_LT((value("fuzz", json + "}") - fuzz_brdf(fuzz, kLight, kView)).norm(), 1e-12);
  const double ps = fuzz_scattered_down(fuzz, kLight);
  EXPECT_NEAR(value("fuzz", json + R"(, "term": "ps"})").x(), ps, 1e-6);
  EXPECT_LT((value("fuzz", json + R"(, "term": "attenuation"})") - fuzz_attenuation(fuzz, kLight, kView, ps))
                .norm(),
            1e-6);
  EXPECT_NEAR(value("fuzz", json + R"(, "term": "g"})").x(), fuzz_visibility(0.3, kView.z()), 1e-9);
  EXPECT_NEAR(value("fuzz", json + R"(, "term": "q"})").x(), fuzz_passing_albedo(0.3), 1e-9);
  EXPECT_NEAR(value("fuzz", json + R"(, "term": "r"})").x(), fuzz_scattered_down_albedo(fuzz), 1e-6);
  EXPECT_NEAR(value("fuzz", json + R"(, "term": "ps", "form": "slides"})").x(), ps, 0.1);
  fuzz.phase = FuzzPhase::schlick;
  fuzz.k = 0.7;
  EXPECT_NEAR(
      value("fuzz", R"({"density": 0.3, "k": 0.7, "phase": "schlick", "tilt": 40, "azimuth": 70})").x(),
      fuzz_brdf(fuzz, kLight, kView).x(), 1e-12);
}

TEST(Evaluation, MatrixIsTheSameRoughness) {
  const Mat2 m = roughness_matrix({0.5, 0.2, 0.6});
  const std::string json = R"({"matrix": [)" + std::to_string(m(0, 0)) + "," + std::to_string(m(0, 1)) + "," +
                           std::to_string(m(1, 1)) + "]}";
  EXPECT_NEAR(value("ggx", json).x() / ggx_brdf({0.5, 0.2, 0.6}, Vec3::Constant(0.04), kLight, kView).x(), 1,
              1e-4);
}

TEST(Evaluation, WrongParametersAreNamed) {
  const auto message = [](const std::string& model, const std::string& json) -> std::string {
    try {
      parse_brdf(model, json, "p.json");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message("ggx", R"({"alpha_t": 1.5})"),
              AllOf(HasSubstr("p.json"), HasSubstr("\"alpha_t\""), HasSubstr("(0, 1]"), HasSubstr("1.5")));
  EXPECT_THAT(message("ggx", R"({"alpha": 0.5})"), HasSubstr("unknown key \"alpha\""));
  EXPECT_THAT(message("ggx", R"({"f0": [0.1, 0.2]})"), HasSubstr("\"f0\""));
  EXPECT_THAT(message("ggx", R"({"matrix": [0.1, 0.2, 0.1]})"), HasSubstr("positive definite"));
  EXPECT_THAT(message("ggx", R"({"convention": "gltf", "alpha_t": 0.1})"), HasSubstr("left out"));
  EXPECT_THAT(message("fuzz", R"({"alpha": 0.5, "k": 0.5})"), HasSubstr("\"k\""));
  EXPECT_THAT(message("fuzz", R"({"phase": "mie"})"), HasSubstr("sggx-symmetric"));
  EXPECT_THAT(message("fuzz", R"({"tilt": "steep"})"), HasSubstr("\"tilt\""));
  EXPECT_THAT(message("hair", "{}"), HasSubstr("hair"));
}

TEST(Evaluation, SheenIsReadInPlaceOfFuzz) {
  const FuzzParameters fuzz = from_sheen({{0.2, 0.5, 0.1}, 0.4});
  EXPECT_LT(
      (value("fuzz", R"({"convention": "gltf", "sheen_color": [0.2, 0.5, 0.1], "sheen_roughness": 0.4})") -
       fuzz_brdf(fuzz, kLight, kView))
          .norm(),
      1e-12);
}

TEST(Evaluation, ConventionsAreReadInPlaceOfAlphas) {
  const Vec3 f0 = Vec3::Constant(0.04);
  EXPECT_LT((value("ggx", R"({"convention": "gltf", "roughness": 0.5, "anisotropy": 0.6, "rotation": 30})") -
             ggx_brdf({0.25 + 0.75 * 0.36, 0.25, radians(30)}, f0, kLight, kView))
                .norm(),
            1e-12);
  EXPECT_LT((value("ggx", R"({"convention": "filament", "roughness": 0.5, "anisotropy": -0.6})") -
             ggx_brdf({0.1, 0.4, 0}, f0, kLight, kView))
                .norm(),
            1e-12);
}

TEST(Evaluation, EveryModelAndTermIsFiniteAtTheEdges) {
  const double t = std::sqrt(0.5);
  const std::vector<Vec3> edges = {Vec3::UnitZ(),     Vec3::UnitX(),    Vec3::UnitY(),
                                   -Vec3::UnitX(),    -Vec3::UnitZ(),   Vec3(t, 0, t),
                                   Vec3(-t, 0, t),    Vec3(t, 0, -t),   Vec3(1, 0, 1e-9),
                                   Vec3(0, 1, -1e-9), Vec3(1e-9, 0, 1), Vec3(0.6, -0.64, 0.48)};
  std::vector<std::pair<std::string, std::string>> models = {
      {"fibre-diffuse", "{}"},
      {"fibre-diffuse", R"({"form": "printed"})"},
      {"fibre-diffuse", R"({"form": "integral"})"},
      {"fibre-diffuse", R"({"form": "maximum-normal"})"},
      {"ggx", R"({"alpha_t": 1e-3, "alpha_b": 1, "f0": 1})"},
      {"ggx", R"({"alpha_t": 1, "alpha_b": 1, "f0": 0, "energy_compensation": true})"}};
  // The tilt puts the fibre on one of the edge directions. Integrals and fits, which take their time, once a
  // phase.
  for (const char* phase : {"sggx", "sggx-symmetric", "schlick"}) {
    const auto add = [&](const char* term, const char* form, const char* rest) {
      models.emplace_back(
          "fuzz", fmt::format(R"({{"tilt": 45, {}, "phase": "{}", "term": "{}", "form": "{}"}})", rest, phase,
                              term, form));
    };
    const char* thick = R"("alpha": 0.3, "density": 0.2)";
    const char* none = R"("k": 0.5, "density": 0)";
    for (const char* term : {"brdf", "g", "q", "ps", "attenuation"}) {
      add(term, "exact", thick);
      add(term, "exact", none);
    }
    for (const char* term : {"g", "q", "ps"}) add(term, "slides", thick);
    add("r", "exact", thick);
  }
  for (const auto& [model, json] : models) {
    const BrdfFunction brdf = parse_brdf(model, json, "test");
    const bool costly = json.find("\"ps\"") != std::string::npos || json.find("atten") != std::string::npos;
    for (const Vec3& light : edges) {
      if (costly) {
        const Vec3 value = brdf({light, Vec3(0.1, 0.2, 0.9).normalized()});
        EXPECT_TRUE(value.allFinite() && value.minCoeff() >= -1e-6 && value.maxCoeff() <= 1 + 1e-6)
            << model << " " << json << " light " << light.transpose() << ": " << value.transpose();
        continue;
      }
      for (const Vec3& view : edges) {
        const Vec3 value = brdf({light, view});
        EXPECT_TRUE(value.allFinite() && value.minCoeff() >= 0)
            << model << " " << json << " light " << light.transpose() << " view " << view.transpose();
      }
    }
  }
}

TEST(Evaluation, TheProgramWritesAListAndLeavesNothingOnErrors) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "p.json") << R"({"alpha_t": 0.4, "alpha_b": 0.2, "f0": [1, 0.5, 0.25]})";
  std::ofstream(folder / "d.json")
      << R"([{"light": [0, 0, 2], "view": [0.3, 0, 0.9]}, {"light": [0, 0, -1], "view": [0, 0, 1]}])";
  const auto run = [&](const std::string& directions) {
    return test::run_program("brdf eval ggx --params " + (folder / "p.json").string() + " --directions " +
                             (folder / directions).string() + " -o " + (folder / "v.json").string());
  };
  EXPECT_EQ(run("d.json").exit_code, 0);
  const nlohmann::json values = nlohmann::json::parse(std::ifstream(folder / "v.json"));
  ASSERT_EQ(values.size(), 2U);
  const Vec3 expected =
      ggx_brdf({0.4, 0.2, 0}, {1, 0.5, 0.25}, Vec3::UnitZ(), Vec3(0.3, 0, 0.9).normalized());
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(values[0][c].get<double>(), expected[static_cast<Eigen::Index>(c)], 1e-12);
    EXPECT_EQ(values[1][c].get<double>(), 0);
  }
  std::filesystem::remove(folder / "v.json");
  std::ofstream(folder / "bad.json") << R"([{"light": [0, 0, 1]}])";
  const test::ProgramResult result = run("bad.json");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output, AllOf(HasSubstr("bad.json, entry 0"), HasSubstr("\"view\" is missing")));
  EXPECT_FALSE(std::filesystem::exists(folder / "v.json"));
  EXPECT_EQ(test::run_program("brdf eval marble --params p --directions d -o v").exit_code, 2);
}

TEST(Evaluation, PlotsAreDrawingsWithEveryCurve) {
  const std::string svg = brdf_plot(parse_brdf("ggx", "{}", "test"), {.title = "a < b"});
  EXPECT_THAT(svg, AllOf(testing::StartsWith("<svg"), HasSubstr("a &lt; b"), HasSubstr("light at 60 degrees"),
                         testing::EndsWith("</svg>\n"), testing::Not(HasSubstr("nan"))));
}

TEST(Evaluation, PlotsHaveTheLightsAndTheCosineAskedFor) {
  const auto first_curve = [](const std::string& svg) {
    const std::size_t end = svg.find("#1b6ca8");
    const std::size_t begin = svg.rfind("<path", end);
    return svg.substr(begin, end - begin);
  };
  EXPECT_EQ(
      first_curve(brdf_plot([](const DirectionPair&) { return Vec3::Ones().eval(); }, {.with_cosine = true})),
      first_curve(brdf_plot([](const DirectionPair& d) { return Vec3::Constant(d.view.z()).eval(); }, {})));
  const test::TemporaryFolder folder;
  std::ofstream(folder / "p.json") << R"({"alpha_t": 0.4, "alpha_b": 0.2})";
  ASSERT_EQ(test::run_program("brdf plot ggx --params " + (folder / "p.json").string() +
                              " --lights 20,-45 --cosine -o " + (folder / "a.svg").string())
                .exit_code,
            0);
  const PlotSettings settings{
      .title = "ggx, p.json", .light_angles = {radians(20), radians(-45)}, .with_cosine = true};
  EXPECT_EQ(io::read_text(folder / "a.svg"),
            brdf_plot(parse_brdf("ggx", R"({"alpha_t": 0.4, "alpha_b": 0.2})", "test"), settings));
}

TEST(Evaluation, AlbedoOfAPlotIsTheIntegral) {
  EXPECT_NEAR(directional_albedo([](const DirectionPair&) { return Vec3::Constant(1 / kPi).eval(); }, kLight),
              1, 1e-3);
  const AnisotropicRoughness sharp{0.05, 0.02, 0};
  const GgxAlbedo albedo = ggx_albedo(sharp, kLight);
  EXPECT_NEAR(
      directional_albedo(
          [&](const DirectionPair& d) { return ggx_brdf(sharp, Vec3::Ones(), d.light, d.view); }, kLight),
      albedo.total(), 0.01);
}

TEST(FuzzApproximations, ConstantsAreWhatTheFitsGive) {
  const VisibilityFit g = fit_visibility();
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(g.coefficients[i], kVisibilitySlides[i], 1e-4);
  EXPECT_LT(g.error.rmse, 0.0125);
  EXPECT_LT(g.error.largest, 0.1);
  const PassingFit q = fit_passing();
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(q.coefficients[i], kPassingSlides[i], 1e-4);
  EXPECT_LT(q.error.rmse, 0.0048);
  EXPECT_LT(q.error.largest, 0.0091);
}

TEST(FuzzApproximations, ScatteredDownFitsReachTheirResidualsAndTheTableBeatsThem) {
  FuzzParameters fuzz;
  for (const auto& [alpha, rmse, largest] :
       {std::array{0.2, 0.0365, 0.11}, std::array{0.5, 0.0101, 0.0295}}) {
    fuzz.alpha = alpha;
    fuzz.tilt = radians(45);
    const FitError six = fit_scattered_down(fuzz, ScatteredDownPolynomial::kSlidesDegree).error;
    const FitError fifteen = fit_scattered_down(fuzz, 4).error;
    EXPECT_LT(six.rmse, rmse);
    EXPECT_LT(six.largest, largest);
    EXPECT_LT(fifteen.rmse, six.rmse / 2);
    const FuzzTable table = make_fuzz_table(fuzz);
    std::mt19937 random(1);
    double worst = 0;
    for (int i = 0; i < 60; ++i) {
      const Vec3 u = test::random_up(random, 0.02);
      worst = std::max(worst, std::abs(table.scattered_down(u).x() - fuzz_scattered_down(fuzz, u, 1e-5)));
    }
    EXPECT_LT(worst, six.largest / 8);
    EXPECT_NEAR(table.scattered_down_mean, fuzz_scattered_down_albedo(fuzz, 1e-4), 1e-3);
  }
}

}  // namespace
}  // namespace sateen::brdf
