// SPDX-License-Identifier: MIT
#include "sateen/core/mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sateen/core/error.h"

namespace sateen {
namespace {

using ::testing::HasSubstr;

std::string fault_of(const Mesh& mesh) {
  return failure_of("", [&] { check(mesh); });
}

TEST(Mesh, ArraysOfOtherLengthsAndIndicesBeyondThemAreNamed) {
  Mesh mesh;
  mesh.positions.assign(3, Vec3f::Zero());
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(fault_of(mesh), "");
  const auto with = [&](auto change) {
    Mesh changed = mesh;
    change(changed);
    return fault_of(changed);
  };
  EXPECT_THAT(with([](Mesh& m) { m.normals.resize(2); }), HasSubstr("2 normals for 3 vertices"));
  EXPECT_THAT(with([](Mesh& m) { m.tangents.resize(4); }), HasSubstr("4 tangents"));
  EXPECT_THAT(with([](Mesh& m) { m.uvs.resize(1); }), HasSubstr("1 texture coordinates"));
  EXPECT_THAT(with([](Mesh& m) { m.occlusion.resize(1); }), HasSubstr("occlusion"));
  EXPECT_THAT(with([](Mesh& m) { m.curvature.resize(1); }), HasSubstr("curvature"));
  EXPECT_THAT(with([](Mesh& m) { m.curvature_forms.resize(1); }), HasSubstr("curvature tensors"));
  EXPECT_THAT(with([](Mesh& m) {
                m.triangles.push_back({0, 1, 3});
              }),
              HasSubstr("triangle 1 uses vertex 3, there are 3"));
  EXPECT_THAT(with([](Mesh& m) { m.material_ids = {0, 0}; }), HasSubstr("2 materials for 1 triangles"));
}

}  // namespace
}  // namespace sateen
