// SPDX-License-Identifier: MIT
#include "sateen/geometry/occlusion.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/core/parallel.h"
#include "sateen/geometry/tangents.h"
#include "sateen/geometry/weld.h"

namespace sateen::geometry {
namespace {

// Rays start this share of the mesh's diagonal above the surface: clear of rounding and of the facets around
// the vertex, below the gap between two layers of cloth.
constexpr double kLift = 2e-4;

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, DeviceRelease>;
using Scene = std::unique_ptr<RTCSceneTy, SceneRelease>;

void check(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  throw Error(error == RTC_ERROR_OUT_OF_MEMORY ? "not enough memory to trace rays through the mesh"
                                               : "the ray tracer could not take the mesh");
}

Scene make_scene(RTCDevice device, const Mesh& mesh) {
  Scene scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(Vec3f), mesh.positions.size());
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          sizeof(mesh.triangles[0]), mesh.triangles.size());
  if (vertices != nullptr && indices != nullptr) {
    std::memcpy(vertices, mesh.positions.data(), mesh.positions.size() * sizeof(Vec3f));
    std::memcpy(indices, mesh.triangles.data(), mesh.triangles.size() * sizeof(mesh.triangles[0]));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
  }
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());
  check(device);
  return scene;
}

// Point i of the R2 sequence (the plastic number's additive recurrence), shifted by an amount of the vertex'
// own.
Vec2 sample(int i, const Vec2& shift) {
  return {wrap(shift.x() + 0.7548776662466927 * i), wrap(shift.y() + 0.5698402909980532 * i)};
}

Vec3 cosine_weighted(const Vec2& uniform) {
  const double radius = std::sqrt(uniform.x());
  const double angle = 2 * kPi * uniform.y();
  return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - uniform.x())};
}

bool blocked(RTCScene scene, const Vec3f& origin, const Vec3f& direction, float reach) {
  RTCRay ray{};
  ray.org_x = origin.x();
  ray.org_y = origin.y();
  ray.org_z = origin.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tfar = reach;
  ray.mask = ~0u;
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded1(scene, &ray);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
#endif
  return ray.tfar < 0;
}

}  // namespace

void compute_occlusion(Mesh& mesh, int rays, double reach, const Progress& progress) {
  if (rays < 1) throw Error("ambient occlusion needs at least one ray per vertex");
  if (!(reach >= 0)) throw Error("the reach of ambient occlusion must not be negative");
  compute_normals(mesh);
  mesh.occlusion.assign(mesh.positions.size(), 1.0f);
  if (mesh.positions.empty() || mesh.triangles.empty()) return;

  const Device device(rtcNewDevice(nullptr));
  const Scene scene = make_scene(device.get(), mesh);
  Eigen::AlignedBox3f box;
  for (const Vec3f& p : mesh.positions) box.extend(p);
  const float lift = static_cast<float>(kLift) * box.diagonal().norm();
  const float far = reach > 0 ? static_cast<float>(reach) : std::numeric_limits<float>::infinity();

  constexpr int kBlock = 256;
  const int count = static_cast<int>(mesh.positions.size());
  const int blocks = (count + kBlock - 1) / kBlock;
  std::atomic<int> done = 0;
  parallel_for(blocks, [&](int block) {
    for (int v = block * kBlock; v < std::min(count, (block + 1) * kBlock); ++v) {
      const auto vertex = static_cast<std::size_t>(v);
      const Vec3 normal = mesh.normals[vertex].cast<double>();
      Mat3 frame;
      Vec3 tangent;
      Vec3 bitangent;
      frame_around(normal, tangent, bitangent);
      frame << tangent, bitangent, normal;
      // Hashed from the position so that the copies of a vertex at a seam agree.
      const std::uint64_t hash = position_hash(mesh.positions[vertex]);
      const Vec2 shift(static_cast<double>(hash >> 32) * 0x1p-32,
                       static_cast<double>(hash & 0xffffffffu) * 0x1p-32);
      const Vec3f origin = mesh.positions[vertex] + lift * mesh.normals[vertex];
      int open = 0;
      for (int i = 0; i < rays; ++i) {
        const Vec3f direction = (frame * cosine_weighted(sample(i, shift))).cast<float>();
        if (!blocked(scene.get(), origin, direction, far)) ++open;
      }
      mesh.occlusion[vertex] = static_cast<float>(open) / static_cast<float>(rays);
    }
    report(progress, static_cast<double>(++done) / blocks);
  });
}

}  // namespace sateen::geometry
