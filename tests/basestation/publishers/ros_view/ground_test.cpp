// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/ros_view/ground.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>

namespace pitwall::publishers::ros_view {
namespace {

constexpr double kAngle_deg = 1e-9;  // a tenth of a millimetre
constexpr double kLength_m = 1e-4;

ros::Vector3 rotated(const ros::Quaternion& q, const ros::Vector3& v) {
  const ros::Vector3 t{2.0 * (q.y * v.z - q.z * v.y), 2.0 * (q.z * v.x - q.x * v.z),
                       2.0 * (q.x * v.y - q.y * v.x)};
  return {v.x + q.w * t.x + q.y * t.z - q.z * t.y, v.y + q.w * t.y + q.z * t.x - q.x * t.z,
          v.z + q.w * t.z + q.x * t.y - q.y * t.x};
}

// GeographicLib has its own formulas.
TEST(Ground, IsWhereGeographicLibHasIt) {
  for (const auto& [latitude, longitude] : {std::pair{36.2722, -115.0103},
                                            {39.795, -86.2347},
                                            {-33.9, 151.2},
                                            {0.0, 0.0},
                                            {70.0, 179.9}}) {
    const double height_m = 594.0;
    const Ground ground{{latitude, longitude, height_m}};
    const GeographicLib::LocalCartesian plane{latitude, longitude, height_m};
    for (const double x : {-3'000.0, 0.0, 1'234.5}) {
      for (const double y : {-2'000.0, 0.0, 4'321.0}) {
        double b = 0.0, l = 0.0, h = 0.0;
        plane.Reverse(x, y, 7.0, b, l, h);
        const Geodetic got = ground.at(x, y, 7.0);
        EXPECT_NEAR(got.latitude_deg, b, kAngle_deg);
        EXPECT_NEAR(got.longitude_deg, l, kAngle_deg);
        EXPECT_NEAR(got.height_m, h, kLength_m);
      }
    }
  }
}

TEST(Ground, TheFrameMapStandsInTheFrameEarthAsItsPointsDo) {
  const Ground ground{{36.2722, -115.0103, 594.0}};
  const ros::Transform t = ground.earth_to_map();
  const ros::Vector3 in_map{700.0, -300.0, 12.0};
  const ros::Vector3 turned = rotated(t.rotation, in_map);
  const Geodetic place = ground.at(in_map.x, in_map.y, in_map.z);
  double x = 0.0, y = 0.0, z = 0.0;
  GeographicLib::Geocentric::WGS84().Forward(place.latitude_deg, place.longitude_deg,
                                             place.height_m, x, y, z);
  EXPECT_NEAR(t.translation.x + turned.x, x, kLength_m);
  EXPECT_NEAR(t.translation.y + turned.y, y, kLength_m);
  EXPECT_NEAR(t.translation.z + turned.z, z, kLength_m);
}

TEST(Quaternion, TurnsAsRollPitchAndYawDo) {
  const double quarter = std::acos(0.0);
  const ros::Vector3 left = rotated(quaternion_of(0, 0, quarter), {1, 0, 0});
  EXPECT_NEAR(left.y, 1.0, 1e-12);  // yaw to the left
  const ros::Vector3 down = rotated(quaternion_of(0, 0.1, 0), {1, 0, 0});
  EXPECT_NEAR(down.z, -std::sin(0.1), 1e-12);  // nose down positive
  const ros::Vector3 up = rotated(quaternion_of(0.1, 0, 0), {0, 1, 0});
  EXPECT_NEAR(up.z, std::sin(0.1), 1e-12);  // left side up positive
  const ros::Quaternion q = quaternion_of(0.3, -0.2, 2.0);
  EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1.0, 1e-12);
}

}  // namespace
}  // namespace pitwall::publishers::ros_view
