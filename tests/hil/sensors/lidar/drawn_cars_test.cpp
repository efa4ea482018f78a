// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/lidar/drawn_cars.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/hil/traffic/oval.hpp"

namespace pitwall::sensors {
namespace {

DrawnCars drawn(std::uint64_t seed, double spun_share = 0.0) {
  Noise noise{seed, 1};
  return draw_cars(traffic::oval(), spun_share, noise);
}

TEST(DrawnCars, LieOnTheTrackWithinSight) {
  std::size_t others = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const DrawnCars cars = drawn(seed);
    ASSERT_LE(cars.others.size(), kSceneCarsMost);
    for (const BodyMotion& car : cars.others) {
      const world::Curvilinear at = traffic::oval().project(car.at_m[0], car.at_m[1]);
      EXPECT_LT(std::abs(at.n_m), traffic::kWall_m - 1.2);
      const double ahead_m = std::remainder(at.s_m - cars.ours.s_m, traffic::oval().length_m());
      EXPECT_GT(ahead_m, -101.0);
      EXPECT_LT(ahead_m, 126.0);
    }
    others += cars.others.size();
  }
  EXPECT_NEAR(static_cast<double>(others), 250.0, 60.0);
}

TEST(DrawnCars, ThoseThatHaveSpunAreAtRest) {
  std::size_t spun = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed)
    for (const BodyMotion& car : drawn(seed, 0.5).others) {
      ++all;
      spun += dot(car.velocity_mps, car.velocity_mps) == 0.0;
    }
  EXPECT_NEAR(static_cast<double>(spun), 0.5 * static_cast<double>(all),
              0.15 * static_cast<double>(all));
}

TEST(DrawnCars, DustTrailsCarsAndIsAsDenseAsAskedFor) {
  const auto densest = [](double density) {
    double most_per_m = 0.0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      Noise noise{seed, 2};
      for (const DustCloud& cloud : draw_dust(traffic::oval(), drawn(seed), density, noise))
        most_per_m = std::max(most_per_m, cloud.extinction_per_m);
    }
    return most_per_m;
  };
  EXPECT_EQ(densest(0.0), 0.0);
  EXPECT_GT(densest(1.0), 0.1);
  EXPECT_NEAR(densest(3.0), 3.0 * densest(1.0), 1e-9);
}

TEST(DrawnCars, OurSpringsMoveLittle) {
  double squares_rad2 = 0.0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Noise noise{seed, 3};
    const BodyMotion body = sprung_body(traffic::oval(), {100.0, 0.0, 50.0, 0.0}, noise);
    squares_rad2 += body.attitude.pitch_rad * body.attitude.pitch_rad;
  }
  EXPECT_NEAR(std::sqrt(squares_rad2 / 400.0), from_deg(0.4), from_deg(0.05));
}

}  // namespace
}  // namespace pitwall::sensors
