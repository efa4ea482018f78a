// That sensors are heard is tested in tests/system/dds.
// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/perception/car_sensors.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "tests/hil/traffic/oval.hpp"

namespace pitwall::io {
namespace {

Result<std::string, Problem> read_whole(const std::string& path) {
  return transport::read_file(path);
}

TEST(CarSensors, WithoutAFileThereAreNone) {
  const auto none = CarSensors::open({}, traffic::oval(), read_whole);
  ASSERT_TRUE(none);
  EXPECT_EQ(*none, nullptr);
  const auto missing = CarSensors::open({.file = "/none.yaml"}, traffic::oval(), read_whole);
  ASSERT_FALSE(missing);
  EXPECT_NE(to_string(missing.error()).find("/none.yaml"), std::string::npos);
}

TEST(CarSensors, ThoseOfTheShippedFilesAreOpenedAndTold) {
  for (const std::string name : {"av21.yaml", "av21_lidars.yaml", "av21_cameras.yaml"}) {
    const auto opened = CarSensors::open(
        {.file = std::string(PITWALL_SOURCE_DIR) + "/vehicle/config/sensors/" + name, .domain = 65},
        traffic::oval(), read_whole);
    ASSERT_TRUE(opened) << to_string(opened.error());
    EXPECT_TRUE((*opened)->take().empty());
    (*opened)->report({});
    const Instant now = transport::monotonic_now();
    const std::string json = (*opened)->json(now);
    EXPECT_EQ(json.find("\"lidars\"") != std::string::npos, name == "av21_lidars.yaml") << json;
    EXPECT_EQ(json.find("\"cameras\"") != std::string::npos, name == "av21_cameras.yaml") << json;
    ASSERT_TRUE((*opened)->lidar_frames(now));
    EXPECT_TRUE((*opened)->figures(SensorType::kDetection2DArray, 0, now)) << name;
  }
}

}  // namespace
}  // namespace pitwall::io
