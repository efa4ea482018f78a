// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/stop_steering.hpp"

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

TEST(StopSteering, StaysOnItsPathInTheBankWhereTheRegulatorStandsBeside) {
  for (const double stiffness : {0.85, 1.0, 1.15}) {
    CarModel car;
    car.front_per_load *= stiffness;
    Params p = recommended();
    const LateralGains gains = prepare(p).value();
    const Lap published = drive(p, gains, oval(), car, 60.0, 45.0);
    p.drive_law = LateralLaw::kFeedForward;
    const Lap ours = drive(p, gains, oval(), car, 60.0, 45.0);
    EXPECT_FALSE(ours.lost);
    EXPECT_LT(ours.cross_track_max_m, 0.4) << stiffness;
    EXPECT_LT(ours.cross_track_mean_m, 0.5 * published.cross_track_mean_m) << stiffness;
    EXPECT_LT(ours.angle_rate_rms_rad_per_s, 0.03) << stiffness;
  }
}

TEST(StopSteering, BeginsWithTheLastAngleWhoeverSteeredBefore) {
  const Params p = recommended();
  const auto path = oval();
  const world::Trajectory t = path.window(700.0, 60.0);
  testing::Car car;
  car.vx_mps = 60.0;
  car.x_m = t.points[0].x_m, car.y_m = t.points[0].y_m + 0.7, car.yaw_rad = t.points[0].yaw_rad;
  StopSteering state;
  const auto first = steer_stop(p.stop_steering, p.lateral, p.bicycle, state, 0.021,
                                car.ego(Instant{}), t, milliseconds(10));
  EXPECT_EQ(first.verdict, LateralVerdict::kGood);
  EXPECT_NEAR(first.angle_rad, 0.021, 0.001);
  world::EgoState lost = car.ego(Instant{});
  lost.validity = world::Validity::kLost;
  const auto held =
      steer_stop(p.stop_steering, p.lateral, p.bicycle, state, 0.021, lost, t, milliseconds(10));
  EXPECT_EQ(held.verdict, LateralVerdict::kNoEgo);
  EXPECT_EQ(held.angle_rad, 0.021);
}

}  // namespace
}  // namespace pitwall::control
