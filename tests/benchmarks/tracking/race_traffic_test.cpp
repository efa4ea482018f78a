// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/tracking/race_traffic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/benchmarks/tracking/tracking_plan.hpp"

namespace pitwall::tracking_bench {
namespace {

constexpr Duration kDt = milliseconds(2);

const RaceLanes& lanes() {
  static const RaceLanes of_track{las_vegas()};
  return of_track;
}

// A car's speed is that of its place, and it moves where it points. The map has a point each metre
// or so and is straight between two, which makes the steps of 2 ms uneven: 20 ms are compared.
TEST(RaceTraffic, CarsMoveAtTheirSpeedInTheirDirection) {
  const Scene scene = race_scene();
  RaceTraffic traffic(scene.traffic, 1);
  for (int i = 0; i < 5'000; ++i) {
    std::vector<plant::CarPose> before;
    for (std::size_t c = 0; c < traffic.size(); ++c)
      before.push_back(lanes().placed(traffic.motion(c)));
    for (int k = 0; k < 10; ++k) traffic.step(lanes(), kDt);
    for (std::size_t c = 0; c < traffic.size(); ++c) {
      const plant::CarPose after = lanes().placed(traffic.motion(c));
      const double dx_m = after.x_m - before[c].x_m, dy_m = after.y_m - before[c].y_m;
      const double speed_mps = std::hypot(after.vx_mps, after.vy_mps);
      ASSERT_NEAR(speed_mps, traffic.motion(c).speed_mps, 1e-9);
      ASSERT_NEAR(std::hypot(dx_m, dy_m) / 0.02, speed_mps, 0.01 * speed_mps);
      ASSERT_NEAR(wrap_pi(std::atan2(dy_m, dx_m) - after.yaw_rad), 0.0, 0.02);
    }
  }
}

// An hour, as the benchmark has it: the cars pass us and are passed, brake hard, stay on the road,
// mostly in reach, and never touch.
TEST(RaceTraffic, TheHourIsARaceWithoutContact) {
  const Scene scene = race_scene();
  RaceTraffic traffic(scene.traffic, scene.seed);
  const world::TrackMap& track = las_vegas();
  std::vector<double> ahead_m(traffic.size(), 0.0);
  std::size_t passes = 0, braking = 0, changes = 0, near = 0, samples = 0;
  double last_mps2 = 0.0;
  for (int i = 0; i < 1'800'000; ++i) {
    traffic.step(lanes(), kDt);
    ASSERT_LE(std::abs(traffic.motion(1).accel_mps2 - last_mps2), kJerk_mps3 * 0.002 + 1e-9);
    last_mps2 = traffic.motion(1).accel_mps2;
    if (i % 25 != 0) continue;
    for (std::size_t a = 0; a < traffic.size(); ++a) {
      const Motion& m = traffic.motion(a);
      ASSERT_GE(m.accel_mps2, -5.0 - 1e-9);
      ASSERT_LE(m.accel_mps2, 4.0 + 1e-9);
      braking += m.accel_mps2 < -4.9;
      changes += std::abs(m.lane_rate_mps) > 1.0;
      const double before_m = std::exchange(ahead_m[a], m.s_m - traffic.motion(0).s_m);
      passes += before_m * ahead_m[a] < 0.0;
      near += std::abs(ahead_m[a]) <= 110.0, ++samples;
      for (std::size_t b = 0; b < a; ++b) {
        const Motion& other = traffic.motion(b);
        const bool is_apart =
            std::abs(m.s_m - other.s_m) > 5.3 || std::abs(m.lane_m - other.lane_m) > 2.1;
        ASSERT_TRUE(is_apart) << a << ' ' << b << " at " << i * 0.002 << " s: " << m.s_m - other.s_m
                              << ' ' << m.lane_m - other.lane_m;
      }
      const plant::CarPose car = lanes().placed(m);
      const world::Curvilinear place = track.project(car.x_m, car.y_m, track.wrap_station(m.s_m));
      const world::TrackPoint wall = track.at(place.s_m);
      ASSERT_LT(place.n_m, wall.width_left_m);
      ASSERT_GT(place.n_m, -wall.width_right_m);
    }
  }
  EXPECT_GT(static_cast<double>(near), 0.95 * static_cast<double>(samples));
  EXPECT_GT(passes, 300U);
  EXPECT_GT(braking, 3000U);
  EXPECT_GT(changes, 3000U);
}

}  // namespace
}  // namespace pitwall::tracking_bench
