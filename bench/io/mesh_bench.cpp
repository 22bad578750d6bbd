// SPDX-License-Identifier: MIT
// Mesh files of a waved cloth: reading them beside reading their bytes, and what is computed from them
// afterwards. The argument is the number of triangles; rates are triangles per second.
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "sateen/geometry/curvature.h"
#include "sateen/geometry/occlusion.h"
#include "sateen/geometry/tangents.h"
#include "sateen/io/file.h"
#include "sateen/io/mesh.h"
#include "support/files.h"
#include "support/meshes.h"

namespace sateen::io {
namespace {

namespace fs = std::filesystem;

Mesh cloth(std::int64_t triangles) {
  const int n = static_cast<int>(std::lround(std::sqrt(static_cast<double>(triangles) / 2)));
  return test::make_grid(
      n, n, [](double u, double v) { return Vec3(u, v, 0.02 * std::sin(20 * u) * std::sin(30 * v)); });
}

void write_ply(const fs::path& path, const Mesh& mesh) {
  std::ofstream file(path, std::ios::binary);
  file << fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty "
      "float z\n"
      "property float s\nproperty float t\nelement face {}\nproperty list uchar int "
      "vertex_indices\nend_header\n",
      mesh.positions.size(), mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    file.write(reinterpret_cast<const char*>(mesh.positions[i].data()), 12);
    file.write(reinterpret_cast<const char*>(mesh.uvs[i].data()), 8);
  }
  for (const auto& triangle : mesh.triangles) {
    file.put(3);
    file.write(reinterpret_cast<const char*>(triangle.data()), 12);
  }
}

void write_obj(const fs::path& path, const Mesh& mesh) {
  std::ofstream file(path);
  for (const Vec3f& p : mesh.positions) file << fmt::format("v {:.6f} {:.6f} {:.6f}\n", p.x(), p.y(), p.z());
  for (const Vec2f& uv : mesh.uvs) file << fmt::format("vt {:.6f} {:.6f}\n", uv.x(), uv.y());
  for (const auto& t : mesh.triangles) {
    file << fmt::format("f {0}/{0} {1}/{1} {2}/{2}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  }
}

// Files are written once and stay until the program ends.
const fs::path& file_of(const std::string& extension, std::int64_t triangles) {
  static const test::TemporaryFolder folder;
  static std::map<std::string, fs::path> files;
  const std::string name = fmt::format("{}{}", triangles, extension);
  auto [place, added] = files.try_emplace(name, folder / name);
  if (added) (extension == ".ply" ? write_ply : write_obj)(place->second, cloth(triangles));
  return place->second;
}

void count(benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void read_file(benchmark::State& state, const std::string& extension) {
  const fs::path& path = file_of(extension, state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(read_model(path));
  count(state);
}

// What a renderer waits for: the mesh with normals and tangents.
void read_and_prepare(benchmark::State& state, const std::string& extension) {
  const fs::path& path = file_of(extension, state.range(0));
  for (auto _ : state) {
    Model model = read_model(path);
    geometry::compute_tangents(model.mesh);
    benchmark::DoNotOptimize(model.mesh.tangents.data());
  }
  count(state);
}

void read_file_bytes(benchmark::State& state, const std::string& extension) {
  const fs::path& path = file_of(extension, state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(read_bytes(path));
  count(state);
}

// Runs `compute` on a fresh copy of the mesh each time, the copy untimed.
template <class Compute>
void compute(benchmark::State& state, const Compute& work, bool normals) {
  Mesh mesh = cloth(state.range(0));
  if (normals) geometry::compute_normals(mesh);
  for (auto _ : state) {
    state.PauseTiming();
    Mesh copy = mesh;
    state.ResumeTiming();
    work(copy);
    benchmark::DoNotOptimize(copy.normals.data());
  }
  count(state);
}

void normals(benchmark::State& state) {
  compute(state, geometry::compute_normals, false);
}
void tangents(benchmark::State& state) {
  compute(state, geometry::compute_tangents, true);
}
void curvature(benchmark::State& state) {
  compute(state, geometry::compute_curvature, true);
}
void occlusion_32_rays(benchmark::State& state) {
  compute(
      state, [](Mesh& mesh) { geometry::compute_occlusion(mesh, 32); }, true);
}

void small_and_large(benchmark::internal::Benchmark* bench) {
  bench->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond)->UseRealTime();
}
void up_to_ten_million(benchmark::internal::Benchmark* bench) {
  small_and_large(bench);
  bench->Arg(10'000'000);
}

BENCHMARK_CAPTURE(read_file_bytes, ply, ".ply")->Apply(up_to_ten_million);
BENCHMARK_CAPTURE(read_file, ply, ".ply")->Apply(up_to_ten_million);
BENCHMARK_CAPTURE(read_file_bytes, obj, ".obj")->Apply(small_and_large);
BENCHMARK_CAPTURE(read_file, obj, ".obj")->Apply(small_and_large);
BENCHMARK_CAPTURE(read_and_prepare, ply, ".ply")->Apply(up_to_ten_million);
BENCHMARK_CAPTURE(read_and_prepare, obj, ".obj")->Apply(up_to_ten_million);
BENCHMARK(normals)->Apply(up_to_ten_million);
BENCHMARK(tangents)->Apply(up_to_ten_million);
BENCHMARK(curvature)->Apply(small_and_large);
BENCHMARK(occlusion_32_rays)->Arg(100'000)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace sateen::io
