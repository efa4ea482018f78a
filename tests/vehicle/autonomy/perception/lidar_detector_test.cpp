// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar_detector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/vehicle/autonomy/perception/lidar/ego_on_oval.hpp"
#include "tests/vehicle/autonomy/perception/lidar/lidar_scene.hpp"

namespace pitwall::perception {
namespace {

constexpr Instant kAt{1'000'000'000};
constexpr double kSensor_m = 1.0;  // over the road, and Body with it

// Our car on the straight at 60 m/s, as it knew itself `ago` before kAt.
world::EgoState ego_before(Duration ago) {
  return ego_on_oval(150.0 - 60.0 * ago.seconds(), 60.0, kAt - ago);
}

PointCloud two_cars() {
  return sweep_of({.sensor_m = kSensor_m,
                   .boxes = {{.x_m = 40.0, .y_m = 3.0, .yaw_rad = 0.0},
                             {.x_m = 15.0, .y_m = -3.0, .yaw_rad = 0.0}}},
                  1);
}

LidarDetector detector() {
  return LidarDetector{traffic::oval(), {.clusters = {}, .origin_over_road_m = kSensor_m}};
}

TEST(LidarDetector, MakesAFrameOfTheSweepsThatAreThere) {
  LidarDetector on_oval = detector();
  const PointCloud points = two_cars();
  for (const Duration ago : {milliseconds(0), milliseconds(40), milliseconds(-20)}) {
    const world::DetectionFrame frame =
        on_oval.detect(std::array{LidarSweep{{}, points, 0.0}}, ego_before(ago), kAt);
    EXPECT_EQ(frame.source, world::DetectionSource::kLidar);
    EXPECT_EQ(frame.at, kAt);
    ASSERT_EQ(frame.detections.size(), 2U) << ago.milliseconds();
    EXPECT_NEAR(frame.detections[0].x_m, 15.0, 0.3) << "the nearest first";
    EXPECT_NEAR(frame.detections[1].x_m, 40.0, 0.3);
    EXPECT_NEAR(frame.detections[1].y_m, 3.0, 0.3);
    EXPECT_GE(frame.detections[0].confidence, frame.detections[1].confidence);
    for (const world::Detection& d : frame.detections) {
      EXPECT_GT(d.confidence, 0.5);
      EXPECT_LE(d.confidence, 1.0);
      EXPECT_TRUE(std::isnan(d.bearing_rad) && std::isnan(d.range_rate_mps)) << "not measured";
    }
  }
  EXPECT_EQ(on_oval.counts().on_map, 3U);
  EXPECT_EQ(on_oval.counts().by_cloth, 0U);
}

TEST(LidarDetector, WithoutAPlaceOnTheTrackItHasACloth) {
  LidarDetector on_oval = detector();
  const PointCloud points = two_cars();
  const std::array sweeps{LidarSweep{{}, points, 0.0}};
  world::EgoState lost = ego_before({}), far = ego_before({});
  lost.validity = world::Validity::kLost;
  far.x_m += 1e4;
  for (const world::EgoState& ego :
       {lost, far, world::EgoState{}, ego_before(LidarDetector::kEgoOldest + milliseconds(1))})
    EXPECT_EQ(on_oval.detect(sweeps, ego, kAt).detections.size(), 2U);
  EXPECT_EQ(on_oval.counts().by_cloth, 4U);
  EXPECT_EQ(on_oval.counts().on_map, 0U);
}

TEST(LidarDetector, ASensorThatIsDeadOrSendsNonsenseLeavesTheOthers) {
  LidarDetector on_oval = detector();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const PointCloud points = two_cars(), nonsense(1'000, LidarPoint{kNan, kNan, kNan}), none;
  const std::array sweeps{LidarSweep{{}, none, 0.0}, LidarSweep{{}, nonsense, 0.0},
                          LidarSweep{{}, points, 0.0}};
  EXPECT_EQ(on_oval.detect(sweeps, ego_before({}), kAt).detections.size(), 2U);
  EXPECT_EQ(on_oval.counts().not_finite, 1'000U);
  EXPECT_TRUE(on_oval.detect({}, ego_before({}), kAt).detections.empty());
}

}  // namespace
}  // namespace pitwall::perception
