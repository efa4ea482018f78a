// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/pillars/pillar_detector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "hil/scenes/pillar_scenes.hpp"
#include "hil/scenes/scene_cloud.hpp"
#include "hil/sensors/lidar/car_mesh.hpp"
#include "protocol/transport/file.hpp"
#include "tests/hil/traffic/oval.hpp"

namespace pitwall::perception {
namespace {

// The one that is shipped.
PillarDetector shipped_network() {
  auto network =
      PillarDetector::read(std::string(PITWALL_SOURCE_DIR) + "/" + kPillarNetworkFile,
                           [](const std::string& path) { return transport::read_file(path); });
  if (!network) throw std::runtime_error(to_string(network.error()));
  return **std::move(network);
}

// A track and a body that it was not trained on.
TEST(PillarDetector, FindsTheCarsOfDrawnScenesWhereTheyAre) {
  PillarDetector network = shipped_network();
  const TrackGrid grid{traffic::oval()};
  sensors::SceneMaker maker{traffic::oval(), {sensors::sf23_shape()}};
  std::size_t cars = 0, found = 0, others = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const sensors::LidarScene scene = maker.make(seed);
    const PointCloud cloud = scenes::merged(scene);
    const auto ground = TrackGround::fit(grid, scenes::pose_of(scene), cloud);
    ASSERT_TRUE(ground);
    const std::vector<CarBox> boxes = network.detect(cloud, *ground, scene.speed_mps);
    std::size_t right = 0;
    for (const sensors::TrueBox& car : scene.cars) {
      const bool is_asked = car.returns >= 20 && std::hypot(car.x_m, car.y_m) < 60.0;
      cars += is_asked;
      for (const CarBox& box : boxes)
        if (std::hypot(box.x_m - car.x_m, box.y_m - car.y_m) < 0.8) {
          ++right, found += is_asked;
          EXPECT_NEAR(std::remainder(box.yaw_rad - car.yaw_rad, std::numbers::pi), 0.0, 0.15)
              << seed;
          EXPECT_NEAR(box.length_m, car.length_m, 0.8) << seed;
        }
    }
    others += boxes.size() - right;
  }
  EXPECT_GE(cars, 10U) << "or the test has seen next to nothing";
  EXPECT_GE(found + 1, cars);
  EXPECT_LE(others, 1U);
}

// Of the stored scenes, in which many a car is far away and seen by a few rays.
TEST(PillarDetector, WhereItDoesNotLookThereIsNoCar) {
  PillarDetector network = shipped_network();
  const auto stored = scenes::read_scenes(
      std::string(PITWALL_SOURCE_DIR) + "/tests/vehicle/autonomy/perception/lidar/pillars/scenes");
  ASSERT_TRUE(stored) << to_string(stored.error());
  std::size_t cars = 0, in_windows = 0;
  for (const auto& scene : *stored) {
    std::vector<float> planes = planes_of(scene.pillars);
    const auto whole = decode(network.run(planes), PillarDetector::kConfidenceLeast);
    const auto boxes = network.boxes_in(scene.pillars, PillarDetector::kConfidenceLeast);
    ASSERT_EQ(boxes.size(), whole.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      EXPECT_NEAR(boxes[i].ahead_m, whole[i].ahead_m, 1e-3);
      EXPECT_NEAR(boxes[i].n_m, whole[i].n_m, 1e-3);
      EXPECT_NEAR(boxes[i].yaw_rad, whole[i].yaw_rad, 1e-3);
      EXPECT_NEAR(boxes[i].confidence, whole[i].confidence, 1e-3);
    }
    cars += whole.size();
    in_windows += windows_of(scene.pillars).size() <= 3;
  }
  EXPECT_GE(cars, 50U);
  EXPECT_GE(2 * in_windows, stored->size()) << "or it looks everywhere most of the time";
}

TEST(PillarDetector, AFileThatCannotBeReadIsNamed) {
  const auto refuses = [](const std::string& path) -> Result<std::string, Problem> {
    return refuse(path, "no such file");
  };
  const auto missing = PillarDetector::read("none.onnx", refuses);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().place, "none.onnx");
  const auto unasked = PillarDetector::read("", refuses);
  ASSERT_TRUE(unasked);
  EXPECT_FALSE(*unasked);
}

TEST(PillarDetector, WithoutPointsThereIsNoCar) {
  PillarDetector network = shipped_network();
  const TrackGrid grid{traffic::oval()};
  const world::TrackPoint at = traffic::oval().at(150.0);
  const auto ground = TrackGround::fit(grid, {at.x_m, at.y_m, at.yaw_rad, 0.3}, {});
  ASSERT_TRUE(ground);
  EXPECT_TRUE(network.detect({}, *ground, 60.0).empty());
}

}  // namespace
}  // namespace pitwall::perception
