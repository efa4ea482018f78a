// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/clusters/cluster_detector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "tests/hil/traffic/oval.hpp"
#include "tests/vehicle/autonomy/perception/lidar/lidar_scene.hpp"

namespace pitwall::perception {
namespace {

double half_turn_apart(double a_rad, double b_rad) {
  return std::abs(std::remainder(a_rad - b_rad, std::numbers::pi));
}

TEST(ClusterDetector, FindsCarsUpTo60Metres) {
  for (const double lean : {0.0, 0.1}) {
    for (std::uint32_t seed = 0; seed < 6; ++seed) {
      const LidarScene scene{.lean = lean,
                             .boxes = {{.x_m = 12.0, .y_m = -4.0, .yaw_rad = 0.05},
                                       {.x_m = 33.0, .y_m = 5.0, .yaw_rad = -0.1},
                                       {.x_m = 58.0, .y_m = -9.0, .yaw_rad = 0.15}}};
      const ClusterResult found = detect_clusters(sweep_of(scene, seed), {});
      ASSERT_EQ(found.cars.size(), 3U) << lean;
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(found.cars[i].x_m, scene.boxes[i].x_m, 0.3) << i;
        EXPECT_NEAR(found.cars[i].y_m, scene.boxes[i].y_m, 0.3) << i;
        EXPECT_LT(half_turn_apart(found.cars[i].yaw_rad, scene.boxes[i].yaw_rad), 0.1) << i;
        EXPECT_NEAR(found.cars[i].height_m, 1.2, 0.7) << i;
      }
    }
  }
}

TEST(ClusterDetector, TakesNoWallAndNoPostForACar) {
  const LidarScene scene{
      .boxes = {{.x_m = 20.0, .y_m = 8.0, .yaw_rad = 0.0, .length_m = 24.0, .width_m = 0.5},
                {.x_m = 20.0, .y_m = -3.0, .yaw_rad = 0.0, .length_m = 0.2, .width_m = 0.2},
                {.x_m = 30.0, .y_m = -6.0, .yaw_rad = 0.0, .height_m = 2.4}}};
  const ClusterResult found = detect_clusters(sweep_of(scene, 1), {});
  EXPECT_TRUE(found.cars.empty());
  EXPECT_GE(found.too_large, 1U);
  EXPECT_GE(found.too_small + found.too_thin, 1U);
  EXPECT_GE(found.too_high, 1U);
}

TEST(ClusterDetector, TwoCarsSideBySideAreTwo) {
  const LidarScene scene{.boxes = {{.x_m = 20.0, .y_m = -1.5, .yaw_rad = 0.0},
                                   {.x_m = 20.0, .y_m = 1.5, .yaw_rad = 0.0}}};
  EXPECT_EQ(detect_clusters(sweep_of(scene, 2), {}).cars.size(), 2U);
}

// Our car in the middle of a level straight: what a sensor sees from Body, put on the map.
class OnTheMap : public ::testing::Test {
 protected:
  static constexpr double kOverRoad_m = 1.0, kOurs_mps = 60.0;

  ClusterResult detect(const PointCloud& sweep) const {
    const world::TrackPoint at = traffic::oval().offset(150.0, 0.0);
    const auto ground = TrackGround::fit(grid_, {at.x_m, at.y_m, at.yaw_rad, kOverRoad_m}, sweep);
    if (!ground) return {};
    return detect_clusters(sweep, *ground, kOurs_mps, {});
  }

  TrackGrid grid_{traffic::oval()};
};

TEST_F(OnTheMap, FindsCarsUpTo100Metres) {
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    const LidarScene scene{.sensor_m = kOverRoad_m,
                           .boxes = {{.x_m = 12.0, .y_m = -4.0, .yaw_rad = 0.05},
                                     {.x_m = 45.0, .y_m = 3.0, .yaw_rad = -0.05},
                                     {.x_m = 95.0, .y_m = -2.0, .yaw_rad = 0.02}}};
    const ClusterResult found = detect(sweep_of(scene, seed));
    ASSERT_EQ(found.cars.size(), 3U) << seed;
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(found.cars[i].x_m, scene.boxes[i].x_m, 0.3) << i;
      EXPECT_NEAR(found.cars[i].y_m, scene.boxes[i].y_m, 0.3) << i;
      EXPECT_LT(half_turn_apart(found.cars[i].yaw_rad, scene.boxes[i].yaw_rad), 0.1) << i;
    }
  }
}

TEST_F(OnTheMap, WhatIsBeyondTheWallsIsNoCar) {
  const LidarScene scene{.sensor_m = kOverRoad_m,
                         .boxes = {{.x_m = 30.0, .y_m = 9.5, .yaw_rad = 0.0},
                                   {.x_m = 30.0, .y_m = -11.0, .yaw_rad = 0.0}}};
  EXPECT_TRUE(detect(sweep_of(scene, 1)).cars.empty());
}

TEST_F(OnTheMap, ACarAsFastAsOursIsWhereItIsAtTheReferenceTime) {
  PointCloud sweep = sweep_of({.sensor_m = kOverRoad_m, .boxes = {{12.0, -4.0, 0.0}}}, 2);
  const ClusterResult still = detect(sweep);
  // Each point of the car as it is seen from 30 ms before to 30 ms after, on a road that stands.
  std::size_t i = 0;
  for (LidarPoint& p : sweep) {
    p.after_s = 0.06F * static_cast<float>(i++) / static_cast<float>(sweep.size()) - 0.03F;
    if (std::abs(p.x_m - 12.0F) < 2.6F && std::abs(p.y_m + 4.0F) < 1.1F)
      p.x_m += static_cast<float>(kOurs_mps) * p.after_s;
  }
  const ClusterResult moving = detect(sweep);
  ASSERT_EQ(still.cars.size(), 1U);
  ASSERT_EQ(moving.cars.size(), 1U);
  EXPECT_NEAR(moving.cars[0].x_m, still.cars[0].x_m, 0.05);
}

TEST_F(OnTheMap, DustIsNoCar) {
  std::mt19937_64 random{4};
  PointCloud sweep = sweep_of({.sensor_m = kOverRoad_m, .boxes = {}}, 3);
  for (const double ahead_m : {10.0, 25.0, 50.0})
    for (int i = 0; i < 60; ++i)
      sweep.push_back({static_cast<float>(ahead_m + testing::draw_normal(random, 1.0)),
                       static_cast<float>(testing::draw_normal(random, 1.0)),
                       static_cast<float>(testing::draw_normal(random, 0.4) - 0.4), 0.05F});
  const ClusterResult found = detect(sweep);
  EXPECT_TRUE(found.cars.empty());
  EXPECT_GT(found.dust, 60U);
}

TEST(ClusterDetector, CountsPointsThatAreNone) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  PointCloud points = sweep_of({.boxes = {{.x_m = 12.0, .y_m = -4.0, .yaw_rad = 0.0}}}, 1);
  const ClusterResult before = detect_clusters(points, {});
  for (const float bad : {kNan, kInfinite, -kInfinite})
    points.insert(points.end(), {{bad, 0, 0, 0}, {0, bad, 0, 0}, {0, 0, bad, 0}});
  points.insert(points.end(), {{100.1F, 0, 0, 0}, {0, -20.1F, 0, 0}});
  const ClusterResult found = detect_clusters(points, {});
  EXPECT_EQ(found.not_finite, 9U);
  EXPECT_EQ(found.beside, before.beside + 2);
  EXPECT_EQ(found.cars.size(), before.cars.size());
  EXPECT_EQ(found.ground, before.ground);
}

TEST(ClusterDetector, WithoutPointsFindsNothing) {
  EXPECT_TRUE(detect_clusters({}, {}).cars.empty());
}

}  // namespace
}  // namespace pitwall::perception
