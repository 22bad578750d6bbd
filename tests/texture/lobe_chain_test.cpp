// SPDX-License-Identifier: MIT
#include "sateen/texture/lobe_chain.h"

#include <atomic>
#include <map>

#include <gtest/gtest.h>

#include "sateen/core/parallel.h"
#include "texture/lobe_radiance.h"

namespace sateen::texture {
namespace {

constexpr FilterMethod kMethods[] = {FilterMethod::sggx, FilterMethod::sggx_variance, FilterMethod::lean,
                                     FilterMethod::naive};

class Texels : public LobeSource {
 public:
  Texels(int width, int height, std::function<LobeTexel(int x, int y)> texel)
      : width_(width), height_(height), texel_(std::move(texel)) {}
  int width() const override { return width_; }
  int height() const override { return height_; }
  void read(std::span<LobeTexel> out) override {
    for (LobeTexel& texel : out) {
      texel = texel_(next_ % width_, next_ / width_);
      ++next_;
    }
  }

 private:
  int width_;
  int height_;
  std::function<LobeTexel(int x, int y)> texel_;
  int next_ = 0;
};

/// Texels by level, y, x; counts rows that come twice.
class Collected : public LobeSink {
 public:
  void write(int level, std::span<const LobeRow> rows) override {
    for (const LobeRow& row : rows) EXPECT_TRUE(levels[level].emplace(row.y, row.texels).second);
  }
  const LobeTexel& at(int level, int x, int y) { return levels[level][y][static_cast<std::size_t>(x)]; }
  std::map<int, std::map<int, std::vector<LobeTexel>>> levels;
};

ChainOptions options_for(FilterMethod method, MipKernel kernel = MipKernel::box) {
  ChainOptions options;
  options.filter.method = method;
  options.kernel = kernel;
  return options;
}

Collected chain(LobeSource&& source, const ChainOptions& options) {
  Collected sink;
  filter_lobe_chain(source, sink, options);
  return sink;
}

/// A plain weave: threads over and under, each a half cylinder.
LobeTexel weave(int x, int y) {
  const int period = 8;
  const bool over = ((x / period) + (y / period)) % 2 == 0;
  const double across = ((over ? y : x) % period + 0.5) / period * 2 - 1;
  const double along = ((over ? x : y) % period + 0.5) / period * 2 - 1;
  Vec3 n(0.5 * along, 0.8 * across, 1);
  if (!over) std::swap(n.x(), n.y());
  return {n.normalized(), brdf::roughness_matrix({0.3, 0.1, over ? kPi / 2 : 0})};
}

double mean_error(FilterMethod method) {
  Collected sink = chain(Texels(32, 32, weave), options_for(method));
  double error = 0;
  double total = 0;
  for (int i = 0; i < 60; ++i) {
    const double tilt = std::acos(std::sqrt(1 - 0.95 * (i + 0.5) / 60));
    const Vec3 light(std::sin(tilt) * std::cos(2.4 * i), std::sin(tilt) * std::sin(2.4 * i), std::cos(tilt));
    const Vec3 view = Vec3(0.5 * std::cos(i), 0.5 * std::sin(i), 1).normalized();
    double truth = 0;
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) truth += lobe_radiance(weave(x, y), light, view) / 256;
    }
    error += std::pow(lobe_radiance(sink.at(4, 0, 0), light, view) - truth, 2);
    total += truth * truth;
  }
  return std::sqrt(error / total);
}

TEST(LobeChain, ConstantMapsStayWhatTheyAre) {
  for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(0.3, -0.2, 1)}) {
    const LobeTexel texel{normal.normalized(), brdf::roughness_matrix({0.4, 0.15, 0.6})};
    for (const FilterMethod method : kMethods) {
      for (const MipKernel kernel : {MipKernel::box, MipKernel::kaiser}) {
        Collected sink = chain(Texels(20, 12, [&](int, int) { return texel; }), options_for(method, kernel));
        ASSERT_EQ(sink.levels.size(), 5u);
        for (auto& [level, rows] : sink.levels) {
          EXPECT_EQ(static_cast<int>(rows.size()), std::max(12 >> level, 1));
          for (auto& [y, row] : rows) {
            ASSERT_EQ(static_cast<int>(row.size()), std::max(20 >> level, 1));
            for (const LobeTexel& t : row) {
              EXPECT_NEAR((t.normal - texel.normal).norm(), 0, 1e-5);
              EXPECT_NEAR((t.s - texel.s).norm(), 0, 1e-5) << name_of(method);
            }
          }
        }
      }
    }
  }
}

TEST(LobeChain, AHorizontalNormalHasAFiniteSlope) {
  std::array<float, kMoments> moments{};
  const FilterOptions options{.method = FilterMethod::lean};
  pack_moments({{1, 0, 0}, brdf::roughness_matrix({0.4, 0.4, 0})}, options, moments);
  const LobeTexel texel = unpack_moments(moments, options);
  EXPECT_TRUE(texel.s.allFinite());
  EXPECT_GT(texel.normal.z(), 0);
}

TEST(LobeChain, SlopeVarianceAddsOnceOrTwice) {
  // Ridges along V: slopes +m and -m along U have variance m^2.
  const double m = 0.1;
  const double alpha = 0.2;
  const auto ridges = [&](int x, int) {
    return LobeTexel{Vec3(x % 2 == 0 ? m : -m, 0, 1).normalized(), brdf::roughness_matrix({alpha, alpha, 0})};
  };
  const auto at_level_1 = [&](FilterMethod method) {
    return chain(Texels(8, 8, ridges), options_for(method)).at(1, 0, 0);
  };
  const auto check = [&](FilterMethod method, double times, double tolerance) {
    const LobeTexel t = at_level_1(method);
    EXPECT_NEAR((t.normal - Vec3::UnitZ()).norm(), 0, 1e-5);
    EXPECT_NEAR(t.s(0, 0), alpha * alpha + times * m * m, tolerance) << name_of(method);
    EXPECT_NEAR(t.s(1, 1), alpha * alpha, tolerance);
    EXPECT_NEAR(t.s(0, 1), 0, 1e-6);
  };
  check(FilterMethod::naive, 0, 1e-6);
  check(FilterMethod::lean, 2, 1e-6);
  check(FilterMethod::sggx, 1, 1e-3);
  check(FilterMethod::sggx_variance, 2, 1e-3);
}

TEST(LobeChain, EveryLevelIsTheAverageOfItsFootprint) {
  // The moments are linear: level 3 from level 2 is the same as straight from the texels.
  for (const FilterMethod method : kMethods) {
    ChainOptions options = options_for(method);
    Collected sink = chain(Texels(32, 32, weave), options);
    for (int by = 0; by < 4; ++by) {
      for (int bx = 0; bx < 4; ++bx) {
        std::array<double, kMoments> sum{};
        for (int i = 0; i < 64; ++i) {
          std::array<float, kMoments> moments{};
          pack_moments(weave(bx * 8 + i % 8, by * 8 + i / 8), options.filter, moments);
          for (std::size_t k = 0; k < kMoments; ++k) sum[k] += moments[k] / 64.0;
        }
        std::array<float, kMoments> mean{};
        for (std::size_t k = 0; k < kMoments; ++k) mean[k] = static_cast<float>(sum[k]);
        const LobeTexel expected = unpack_moments(mean, options.filter);
        EXPECT_NEAR((sink.at(3, bx, by).normal - expected.normal).norm(), 0, 1e-4);
        EXPECT_NEAR((sink.at(3, bx, by).s - expected.s).norm(), 0, 1e-4);
      }
    }
  }
}

TEST(LobeChain, AgreesWithTheAveragedLobesInTheOrderOfTheMethods) {
  const double naive = mean_error(FilterMethod::naive);
  const double sggx = mean_error(FilterMethod::sggx);
  const double variance = mean_error(FilterMethod::sggx_variance);
  EXPECT_GT(naive, 1);
  EXPECT_LT(sggx, 0.5 * naive);
  EXPECT_LT(variance, 0.9 * sggx);
  EXPECT_LT(variance, 0.35);
}

TEST(LobeChain, OppositeSteepNormalsStayUpright) {
  const auto saw = [](int x, int y) {
    const double a = radians(60);
    const double side = (x + y) % 2 == 0 ? 1 : -1;
    return LobeTexel{Vec3(side * std::sin(a), 0, std::cos(a)), brdf::roughness_matrix({0.05, 0.05, 0})};
  };
  for (const FilterMethod method : kMethods) {
    Collected sink = chain(Texels(8, 8, saw), options_for(method));
    for (int level = 1; level < 4; ++level) {
      const LobeTexel& t = sink.at(level, 0, 0);
      EXPECT_GT(t.normal.z(), 0);
      EXPECT_TRUE(t.s.allFinite());
      EXPECT_LE(brdf::roughness_from_matrix(t.s).alpha_t, 1);
      EXPECT_GT(brdf::roughness_from_matrix(t.s).alpha_b, 0);
    }
  }
}

TEST(LobeChain, IsotropicOutputHasOneAlpha) {
  ChainOptions options = options_for(FilterMethod::sggx_variance);
  options.filter.isotropic = true;
  Collected sink = chain(Texels(16, 16, weave), options);
  for (auto& [level, rows] : sink.levels) {
    for (auto& [y, row] : rows) {
      for (const LobeTexel& t : row) {
        EXPECT_DOUBLE_EQ(t.s(0, 0), t.s(1, 1));
        EXPECT_DOUBLE_EQ(t.s(0, 1), 0);
      }
    }
  }
}

TEST(LobeChain, DoesNotDependOnTheNumberOfThreads) {
  const auto run = [] {
    return chain(Texels(67, 45, weave), options_for(FilterMethod::sggx_variance, MipKernel::kaiser));
  };
  limit_threads(1);
  Collected one = run();
  limit_threads(0);
  Collected many = run();
  for (auto& [level, rows] : one.levels) {
    for (auto& [y, row] : rows) {
      for (std::size_t x = 0; x < row.size(); ++x) {
        EXPECT_EQ(row[x].s, many.at(level, static_cast<int>(x), y).s);
        EXPECT_EQ(row[x].normal, many.at(level, static_cast<int>(x), y).normal);
      }
    }
  }
}

/// Counts how many rows are read before those that they make are given.
class Ahead : public LobeSink {
 public:
  explicit Ahead(const std::atomic<int>& rows_read) : read_(rows_read) {}
  void write(int level, std::span<const LobeRow> rows) override {
    // Rows of the file that the last of these rows covers; of the small levels one row is many.
    const int covered = (rows.back().y + 1) << level;
    most = std::max(most, read_ - covered - (8 << level));
  }
  int most = 0;

 private:
  const std::atomic<int>& read_;
};

TEST(LobeChain, HoldsAFewStripsWhateverTheHeight) {
  // A picture as wide as 16 K: 16 rows a strip, and one is read while another is filtered.
  for (const MipKernel kernel : {MipKernel::box, MipKernel::kaiser}) {
    for (const int height : {96, 192}) {
      int texels = 0;
      std::atomic<int> rows = 0;
      const int width = 16384;
      Texels source(width, height, [&](int, int) {
        rows = ++texels / width;
        return LobeTexel{};
      });
      Ahead sink(rows);
      ChainOptions options = options_for(FilterMethod::sggx_variance, kernel);
      options.wrap_v = MipWrap::clamp;
      options.levels = 4;
      filter_lobe_chain(source, sink, options);
      EXPECT_LE(sink.most, 3 * 16) << height;
    }
  }
}

TEST(LobeChain, StopsAtTheLevelsAskedFor) {
  ChainOptions options = options_for(FilterMethod::sggx);
  options.levels = 2;
  EXPECT_EQ(chain(Texels(16, 16, weave), options).levels.size(), 2u);
}

}  // namespace
}  // namespace sateen::texture
