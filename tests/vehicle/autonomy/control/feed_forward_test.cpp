// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/feed_forward.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/autonomy/control/single_track.hpp"

namespace pitwall::control {
namespace {

using testing::CarModel;
using testing::drive;
using testing::Lap;
using testing::oval;
using testing::recommended;

// From the second lap on: in the first one it learns what the car needs.
TEST(FeedForward, StaysOnItsPathInTheBankWhereTheRegulatorStandsBeside) {
  constexpr double kFirstLap_s = 48.0;
  for (const double stiffness : {0.85, 1.0, 1.15}) {
    CarModel car;
    car.front_per_load *= stiffness;
    Params p = recommended();
    const LateralGains gains = prepare(p).value();
    const Lap published = drive(p, gains, oval(), car, 60.0, 90.0, kFirstLap_s);
    p.controller = controller_named("feed_forward");
    const Lap ours = drive(p, gains, oval(), car, 60.0, 90.0, kFirstLap_s);
    EXPECT_FALSE(ours.lost);
    EXPECT_LT(ours.cross_track_max_m, 0.4) << stiffness;
    EXPECT_LT(ours.cross_track_mean_m, 0.5 * published.cross_track_mean_m) << stiffness;
    EXPECT_LT(ours.angle_rate_rms_rad_per_s, 0.03) << stiffness;
  }
}

TEST(FeedForward, BeginsWithTheLastAngleWhoeverSteeredBeforeAndHoldsItWithoutAPlace) {
  const Params p = recommended();
  const auto path = oval();
  const world::Trajectory t = path.window(700.0, 60.0);
  testing::Car car;
  car.vx_mps = 60.0;
  car.x_m = t.points[0].x_m, car.y_m = t.points[0].y_m + 0.7, car.yaw_rad = t.points[0].yaw_rad;
  steering::State state;
  const auto first = steer_forward(p.steering, p.lateral, {}, state, {0.021}, car.ego(Instant{}), t,
                                   milliseconds(10));
  EXPECT_EQ(first.verdict, LateralVerdict::kGood);
  EXPECT_NEAR(first.angle_rad, 0.021, 1e-12);
  world::EgoState lost = car.ego(Instant{});
  lost.validity = world::Validity::kLost;
  const auto held =
      steer_forward(p.steering, p.lateral, {}, state, {0.021}, lost, t, milliseconds(10));
  EXPECT_EQ(held.verdict, LateralVerdict::kNoEgo);
  EXPECT_EQ(held.angle_rad, 0.021);
}

// The verdict judges the place, not the steering.
TEST(FeedForward, TooFarIsWhereTheLateralLimitSaysSo) {
  const Params p = recommended();
  const world::Trajectory t = oval().window(0.0, 30.0);
  for (const double beside_m : {-5.1, -4.9, 4.9, 5.1}) {
    testing::Car car;
    car.vx_mps = 30.0;
    car.x_m = t.points[3].x_m, car.y_m = t.points[3].y_m + beside_m;
    steering::State state;
    const auto out = steer_forward(p.steering, p.lateral, {}, state, {}, car.ego(Instant{}), t,
                                   milliseconds(10));
    EXPECT_NEAR(out.cross_track_m, beside_m, 0.01);
    EXPECT_EQ(out.verdict, std::abs(beside_m) > p.lateral.deviation_max_m ? LateralVerdict::kTooFar
                                                                          : LateralVerdict::kGood);
  }
}

}  // namespace
}  // namespace pitwall::control
