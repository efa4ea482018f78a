// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/own_trail.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/autonomy/tracking/race.hpp"

namespace pitwall::tracking {
namespace {

using testing::Car;
using testing::ego_of;

const Car kCar{.s_m = 1550.0, .n_m = 2.0, .speed_mps = 60.0, .swing_mps = 5.0};

OwnTrail trail_of(int ticks) {
  OwnTrail trail;
  for (int k = 0; k < ticks; ++k)
    trail.note(ego_of(kCar.at(0.01 * k), at_ms(10 * k)), &testing::round_track());
  return trail;
}

TEST(OwnTrail, IsThePoseAtTheTime) {
  const OwnTrail trail = trail_of(200);
  for (const double t_s : {0.75, 1.2345, 1.5, 1.987, 1.99}) {
    const auto own = trail.at(at_s(t_s));
    ASSERT_TRUE(own) << t_s;
    const testing::TruePose truth = kCar.at(t_s);
    // Straight between two ticks: off by speed^2 dt^2 / (8 radius), 0.2 mm.
    EXPECT_NEAR(own->x_m, truth.x_m, 1e-3);
    EXPECT_NEAR(own->y_m, truth.y_m, 1e-3);
    EXPECT_NEAR(wrap_pi(own->yaw_rad - truth.yaw_rad), 0.0, 1e-4);
    EXPECT_NEAR(own->vx_mps, truth.speed_mps * std::cos(truth.yaw_rad), 0.01);
    EXPECT_NEAR(own->vy_mps, truth.speed_mps * std::sin(truth.yaw_rad), 0.01);
    const double s_m = testing::own_motion(truth).s_m;
    EXPECT_LE(std::abs(std::remainder(own->s_m - s_m, testing::round_track().length_m())), 0.7);
  }
}

TEST(OwnTrail, KnowsOneSecondAndNoMore) {
  EXPECT_FALSE(OwnTrail{}.at(at_ms(0)));
  const OwnTrail trail = trail_of(300);
  EXPECT_TRUE(trail.at(at_ms(2990 - 1000)));
  EXPECT_FALSE(trail.at(at_ms(2990 - 1300)));
  EXPECT_TRUE(trail.at(at_ms(2990 + 50)));
  EXPECT_FALSE(trail.at(at_ms(2990 + 51)));
}

TEST(OwnTrail, GapHasNoPose) {
  OwnTrail trail = trail_of(10);
  trail.note(ego_of(kCar.at(0.2), at_ms(200)), nullptr);
  EXPECT_FALSE(trail.at(at_ms(150)));
  EXPECT_TRUE(trail.at(at_ms(200)));
  EXPECT_TRUE(trail.at(at_ms(85)));
}

TEST(OwnTrail, IgnoresWhatItCannotUse) {
  OwnTrail trail = trail_of(10);
  world::EgoState ego = ego_of(kCar.at(0.1), at_ms(100));
  const auto refuses = [&](world::EgoState bad) {
    OwnTrail copy = trail;
    copy.note(bad, nullptr);
    return copy.newest()->at == at_ms(90);
  };
  world::EgoState bad = ego;
  bad.validity = world::Validity::kLost;
  EXPECT_TRUE(refuses(bad));
  bad = ego, bad.vy_mps = kUnset;
  EXPECT_TRUE(refuses(bad));
  bad = ego, bad.at = at_ms(90), bad.x_m += 1.0;
  OwnTrail copy = trail;
  copy.note(bad, nullptr);
  EXPECT_EQ(copy.newest()->own.x_m, trail.newest()->own.x_m);
  EXPECT_FALSE(refuses(ego));
}

}  // namespace
}  // namespace pitwall::tracking
