// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/lidar/mesh.hpp"

#include <gtest/gtest.h>

namespace pitwall::sensors {
namespace {

TEST(Mesh, AQuadIsTwoTrianglesThatShareADiagonal) {
  Mesh mesh;
  mesh.add_quad({Corner{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  mesh.add_quad({Corner{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}});
  ASSERT_EQ(mesh.corners.size(), 8U);
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::uint32_t, 3>>{
                                {0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}}));
  EXPECT_EQ(mesh.corners[6], (Corner{1, 1, 1}));
}

}  // namespace
}  // namespace pitwall::sensors
