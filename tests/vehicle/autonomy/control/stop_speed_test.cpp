// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/stop_speed.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/autonomy/control/single_track.hpp"

namespace pitwall::control {
namespace {

constexpr Duration kTick = milliseconds(10);

TEST(StopSpeed, PressureIsWhatThePlannedDecelerationNeedsBesideTheAir) {
  const Params p = testing::recommended();
  for (const double v : {10.0, 40.0, 65.0}) {
    for (const double decel : {0.0, 2.0, 5.0}) {
      LongitudinalState state{0.5, 0.0};
      for (int i = 0; i < 300; ++i) {
        const auto next = slow(p.stop_speed, p.longitudinal, state, {v, -decel}, v, kTick).next;
        EXPECT_LE(std::abs(next.brake_kpa - state.brake_kpa),
                  p.stop_speed.brake_rate_kpa_per_s * 0.01 + 1e-9);
        EXPECT_LE(next.throttle_fraction, state.throttle_fraction);
        EXPECT_GE(next.throttle_fraction,
                  state.throttle_fraction - p.stop_speed.throttle_fall_per_s * 0.01 - 1e-9);
        state = next;
      }
      const double free = p.stop_speed.coast_mps2 + p.stop_speed.drag_per_m * v * v;
      EXPECT_NEAR(state.brake_kpa, std::max(decel - free, 0.0) * p.stop_speed.kpa_per_mps2, 1e-6);
      EXPECT_EQ(state.throttle_fraction, 0.0);
    }
  }
}

TEST(StopSpeed, HoldsTheCarWhereItStandsAndLetsGoWithoutATarget) {
  const Params p = testing::recommended();
  LongitudinalState state;
  for (int i = 0; i < 300; ++i)
    state = slow(p.stop_speed, p.longitudinal, state, {0.0, 0.0}, 0.0, kTick).next;
  EXPECT_NEAR(state.brake_kpa, p.longitudinal.hold_brake_kpa, 1e-9);
  for (int i = 0; i < 300; ++i)
    state = slow(p.stop_speed, p.longitudinal, state, {}, 30.0, kTick).next;
  EXPECT_EQ(state.brake_kpa, 0.0);
}

}  // namespace
}  // namespace pitwall::control
