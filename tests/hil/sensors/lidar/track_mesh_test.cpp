// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/lidar/track_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/hil/traffic/oval.hpp"

namespace pitwall::sensors {
namespace {

constexpr std::size_t kRoad = 0, kWalls = 1, kFence = 2;

TEST(TrackMesh, RoadLiesOnTheSurfaceOfTheMap) {
  const Mesh road = track_meshes(traffic::oval())[kRoad];
  double widest_m = 0.0;
  for (const Corner& corner : road.corners) {
    const world::Curvilinear at = traffic::oval().project(corner[0], corner[1]);
    EXPECT_NEAR(corner[2], traffic::oval().road(at.s_m, at.n_m).height_m, 0.002);
    EXPECT_LE(std::abs(at.n_m), traffic::kWall_m + 0.01);
    widest_m = std::max(widest_m, std::abs(at.n_m));
  }
  EXPECT_NEAR(widest_m, traffic::kWall_m, 0.01);
}

TEST(TrackMesh, NoGapIsLeftAlongTheLap) {
  // The area of all quads is that of the road: length times width, and the banking's cosine.
  const Mesh road = track_meshes(traffic::oval())[kRoad];
  double area_m2 = 0.0;
  for (const auto& [a, b, c] : road.triangles) {
    std::array<double, 3> u{}, v{};
    for (std::size_t k = 0; k < 3; ++k) {
      u[k] = road.corners[b][k] - road.corners[a][k];
      v[k] = road.corners[c][k] - road.corners[a][k];
    }
    area_m2 += 0.5 * std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                u[0] * v[1] - u[1] * v[0]);
  }
  const double expected_m2 = traffic::oval().length_m() * 2.0 * traffic::kWall_m / std::cos(0.1);
  EXPECT_NEAR(area_m2, expected_m2, 0.002 * expected_m2);
}

TEST(TrackMesh, WallsStandAtTheEdgesAndTheFenceOverTheRightOne) {
  const TrackSurroundings sizes;
  const auto meshes = track_meshes(traffic::oval(), sizes);
  for (const Corner& corner : meshes[kWalls].corners) {
    const world::Curvilinear at = traffic::oval().project(corner[0], corner[1]);
    EXPECT_GE(std::abs(at.n_m), traffic::kWall_m - 0.01);
    EXPECT_LE(std::abs(at.n_m), traffic::kWall_m + sizes.wall_thick_m + 0.01);
  }
  double highest_m = 0.0;
  for (const Corner& corner : meshes[kFence].corners) {
    EXPECT_LT(traffic::oval().project(corner[0], corner[1]).n_m, -traffic::kWall_m);
    highest_m = std::max(highest_m, static_cast<double>(corner[2]));
  }
  // The right edge of a road whose left side is lower.
  EXPECT_NEAR(highest_m, sizes.fence_m + traffic::kWall_m * std::tan(0.1), 0.01);
}

TEST(TrackMesh, LinesLieOnTheRoadBeforeBothWalls) {
  const Mesh lines = line_mesh(traffic::oval());
  std::size_t left = 0, right = 0;
  for (const Corner& corner : lines.corners) {
    const world::Curvilinear at = traffic::oval().project(corner[0], corner[1]);
    EXPECT_NEAR(corner[2], traffic::oval().road(at.s_m, at.n_m).height_m + 0.01, 0.003);
    left += at.n_m > traffic::kWall_m - 0.7, right += at.n_m < 0.7 - traffic::kWall_m;
  }
  EXPECT_GT(left, 1'000U);
  EXPECT_GT(right, 1'000U);
}

}  // namespace
}  // namespace pitwall::sensors
