// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/stop_brake.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::safety {
namespace {

TEST(StopBrake, ColdTyresHaveLessGripAndUnknownOnesCountAsCold) {
  const SafeStopParams p;
  const Grip warm = grip_at(p, 50.0, 0.004, 0.3, 85.0), cold = grip_at(p, 50.0, 0.004, 0.3, 20.0);
  EXPECT_NEAR(cold.total_mps2, p.tyres.cold() * warm.total_mps2, 1e-9);
  EXPECT_EQ(cold.lateral_mps2, warm.lateral_mps2);
  EXPECT_EQ(grip_at(p, 50.0, 0.004, 0.3).total_mps2, cold.total_mps2);
}

// As planning has it: what is level of the turn is across the car by the cosine of the bank alone.
TEST(StopBrake, TheCornerTakesWhatTheRoadAsks) {
  for (const double bank : {-0.1, 0.0, 0.2, 0.35})
    for (const double k : {-0.004, 0.0, 0.004})
      EXPECT_NEAR(grip_at({}, 50.0, k, bank).lateral_mps2,
                  2500.0 * k * std::cos(bank) - 9.80665 * std::sin(bank), 1e-12);
}

TEST(StopBrake, NeverBrakesBeyondItsShareAndWhatAirGivesIsNotBraked) {
  SafeStopParams p;
  p.drag_per_m = 0.0006, p.coast_mps2 = 0.5;
  for (const double v : {5.0, 30.0, 65.0}) {
    for (const double k : {-0.004, 0.0, 0.004}) {
      for (const StopKind kind : {StopKind::kControlled, StopKind::kEmergency}) {
        const Grip grip = grip_at(p, v, k, 0.3, 60.0);
        double last_kpa = 0.0;
        for (int i = 0; i < 400; ++i)
          last_kpa = brake_towards(p, kind, {4.0, grip, last_kpa, 0.01});
        const double brake = last_kpa / p.brake_kpa_per_mps2;
        const double share = kind == StopKind::kEmergency ? p.emergency_grip_share : p.grip_share;
        const double least = std::max(p.decel_min_mps2 - grip.free_mps2, 0.0);
        EXPECT_LE(brake, std::max(4.0 - grip.free_mps2, least) + 1e-9);
        EXPECT_LE(std::hypot(std::max(brake - least, 0.0), grip.lateral_mps2),
                  std::max(share * grip.total_mps2, std::abs(grip.lateral_mps2)) + 1e-9);
      }
    }
  }
}

// Whatever the tick; a wheel that reports nothing never costs brake.
TEST(StopBrake, AFrontWheelThatLocksTakesPressureBackAndNeverMoreThanItsShare) {
  const SafeStopParams p;
  for (const double dt_s : {0.005, 0.01, 0.02}) {
    double share = 1.0;
    for (double t_s = 0.0; t_s < 0.2 - 1e-9; t_s += dt_s)
      share = next_lock_share(p, share, {.front = 0.3}, dt_s);
    EXPECT_NEAR(share, 1.0 - 0.2 * p.lock_release_per_s, 1e-9);
    for (double t_s = 0.0; t_s < 1.0 - 1e-9; t_s += dt_s)
      share = next_lock_share(p, share, {.front = p.lock_slip}, dt_s);
    EXPECT_NEAR(share, 1.0 - 0.2 * p.lock_release_per_s + p.lock_recover_per_s, 1e-9);
    for (int i = 0; i < 10'000; ++i) share = next_lock_share(p, share, {.front = 1.0}, dt_s);
    EXPECT_EQ(share, p.lock_share_least);
    for (int i = 0; i < 10'000; ++i) share = next_lock_share(p, share, {.front = kUnset}, dt_s);
    EXPECT_EQ(share, 1.0);
  }
}

TEST(StopBrake, TheShareIsOneOfWhatTheCornerLeaves) {
  const SafeStopParams p;
  Grip grip = grip_at(p, 50.0, 0.004, 0.3, 85.0);
  const double whole_kpa = brake_for(p, StopKind::kEmergency, 30.0, grip);
  grip.share = 0.6;
  EXPECT_NEAR(brake_for(p, StopKind::kEmergency, 30.0, grip), 0.6 * whole_kpa, 1e-9);
  const double light_kpa = brake_for(p, StopKind::kEmergency, 1.0, grip);
  EXPECT_NEAR(light_kpa, p.brake_kpa_per_mps2, 1e-9) << "what asks for less stays as it is";
}

}  // namespace
}  // namespace pitwall::safety
