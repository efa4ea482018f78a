// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/lidar/car_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

namespace pitwall::sensors {
namespace {

struct Bounds {
  std::array<float, 3> least, most;
};

Bounds bounds_of(const std::vector<Mesh>& meshes) {
  constexpr float kFar = std::numeric_limits<float>::max();
  Bounds bounds{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (const Mesh& mesh : meshes)
    for (const Corner& corner : mesh.corners)
      for (std::size_t k = 0; k < 3; ++k) {
        bounds.least[k] = std::min(bounds.least[k], corner[k]);
        bounds.most[k] = std::max(bounds.most[k], corner[k]);
      }
  return bounds;
}

TEST(CarMesh, HasTheOuterSizesOfItsCar) {
  for (const CarShape& shape : {av21_shape(), sf23_shape()}) {
    const Bounds bounds = bounds_of(car_meshes(shape));
    EXPECT_NEAR(bounds.most[0], 0.5 * shape.length_m, 0.01) << shape.name;
    EXPECT_NEAR(bounds.least[0], -0.5 * shape.length_m, 0.01) << shape.name;
    EXPECT_NEAR(bounds.most[1], 0.5 * shape.width_m, 0.02) << shape.name;
    EXPECT_NEAR(bounds.most[2], shape.height_m, 0.01) << shape.name;
    EXPECT_NEAR(bounds.least[2], 0.0, 0.01) << "its wheels stand on the road: " << shape.name;
  }
}

TEST(CarMesh, IsTheSameOnBothSides) {
  for (const Mesh& mesh : car_meshes(av21_shape())) {
    for (const Corner& corner : mesh.corners) {
      const bool has_twin = std::ranges::any_of(mesh.corners, [&](const Corner& other) {
        return std::abs(other[0] - corner[0]) < 1e-5F && std::abs(other[1] + corner[1]) < 1e-5F &&
               std::abs(other[2] - corner[2]) < 1e-5F;
      });
      EXPECT_TRUE(has_twin) << corner[0] << ' ' << corner[1] << ' ' << corner[2];
    }
  }
}

TEST(CarMesh, TrianglesNameTheirCorners) {
  for (const Mesh& mesh : car_meshes(sf23_shape()))
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t corner : triangle) EXPECT_LT(corner, mesh.corners.size());
}

}  // namespace
}  // namespace pitwall::sensors
