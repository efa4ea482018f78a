// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/wheel_speeds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/hil/sensors/sensor_log.hpp"

namespace pitwall::sensors {
namespace {

plant::Wheels all(double speed_mps) { return {speed_mps, speed_mps, speed_mps, speed_mps}; }

WheelParams exact() { return {.growth_s2_per_m2 = 0.0, .radius_sigma = 0.0, .sigma_mps = {}}; }

TEST(WheelSpeeds, AreTheTruthWithoutErrors) {
  WheelState state = make_wheels(exact(), 1, Instant{});
  for (const double speed_mps : {0.0, 5.0, 70.0, -3.0})
    EXPECT_EQ(step_wheels(exact(), state, all(speed_mps), Instant{}), all(speed_mps));
}

TEST(WheelSpeeds, SeeNothingThatIsTooSlow) {
  WheelState state = make_wheels({}, 1, Instant{});
  EXPECT_EQ(step_wheels({}, state, all(0.2), Instant{}), all(0.0));
  EXPECT_GT(step_wheels({}, state, all(0.5), Instant{})[0], 0.0);
}

// What was fitted to the recorded drive: 0.27 % to 0.42 % between 10 and 28 m/s.
TEST(WheelSpeeds, FallShortAsTheTyreGrows) {
  WheelParams p;
  p.radius_sigma = 0.0, p.sigma_mps = {};
  WheelState state = make_wheels(p, 1, Instant{});
  const auto ratio = [&](double speed_mps) {
    return step_wheels(p, state, all(speed_mps), Instant{})[2] / speed_mps;
  };
  EXPECT_NEAR(ratio(10.0) - ratio(28.0), 0.0026, 2e-4);
  EXPECT_NEAR(ratio(p.calibrated_mps), 1.0, 1e-12);
  EXPECT_NEAR(ratio(68.0), 1.0 - 0.0142, 2e-4);
}

TEST(WheelSpeeds, ScatterAsTheRecordedOnes) {
  const WheelParams p;
  WheelState state = make_wheels(p, 1, Instant{});
  std::array<std::vector<double>, world::kCorners> received;
  for (int ms = 0; ms < 60'000; ++ms) {
    const plant::Wheels w = step_wheels(p, state, all(30.0), Instant{} + milliseconds(ms));
    if (ms % 10 != 0) continue;
    for (std::size_t i = 0; i < w.size(); ++i) received[i].push_back(w[i]);
  }
  for (std::size_t i = 0; i < received.size(); ++i) {
    const Moments m = moments(received[i]);
    EXPECT_NEAR(m.sigma, p.sigma_mps[i], 0.05 * p.sigma_mps[i]);
    EXPECT_NEAR(m.lag_one, 0.0, 0.05);
    EXPECT_NEAR(m.mean, 30.0, 30.0 * 4.0 * p.radius_sigma);
  }
}

TEST(WheelSpeeds, OneWheelFailsAlone) {
  WheelState state = make_wheels(exact(), 1, Instant{});
  const auto received = [&](const WheelFault& fault) {
    state.fault = {};
    state.fault[2] = fault;
    return step_wheels(exact(), state, all(40.0), Instant{});
  };
  EXPECT_EQ(received({.trouble = WheelTrouble::kLost}), (plant::Wheels{40.0, 40.0, 0.0, 40.0}));
  EXPECT_EQ(received({.trouble = WheelTrouble::kSpinning, .factor = 1.5})[2], 60.0);
  EXPECT_EQ(received({.trouble = WheelTrouble::kLocked, .since_s = 0.0})[2], 40.0);
  EXPECT_NEAR(received({.trouble = WheelTrouble::kLocked, .since_s = 0.05})[2], 20.0, 1e-9);
  EXPECT_EQ(received({.trouble = WheelTrouble::kLocked, .since_s = 0.2})[2], 0.0);
}

}  // namespace
}  // namespace pitwall::sensors
