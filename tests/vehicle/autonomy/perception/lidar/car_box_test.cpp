// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/car_box.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::perception {
namespace {

CarBox car_at(double along_m, double across_m, double yaw_rad) {
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  return {.x_m = 30.0 + along_m * c - across_m * s,
          .y_m = -2.0 + along_m * s + across_m * c,
          .yaw_rad = yaw_rad,
          .length_m = 5.0,
          .width_m = 2.0};
}

TEST(CarBox, TwoAreInOnePlaceWhereTheirMiddlesAreCloserThanACarIsLongAndWide) {
  for (const double yaw_rad : {-2.0, -0.3, 0.0, 1.1, 3.0}) {
    const CarBox car = car_at(0.0, 0.0, yaw_rad);
    EXPECT_TRUE(is_same_place(car, car));
    for (const double sign : {-1.0, 1.0}) {
      EXPECT_TRUE(is_same_place(car, car_at(sign * 4.4, sign * 1.7, yaw_rad))) << yaw_rad;
      EXPECT_FALSE(is_same_place(car, car_at(sign * 4.6, 0.0, yaw_rad))) << yaw_rad;
      EXPECT_FALSE(is_same_place(car, car_at(0.0, sign * 1.9, yaw_rad))) << yaw_rad;
    }
  }
}

}  // namespace
}  // namespace pitwall::perception
