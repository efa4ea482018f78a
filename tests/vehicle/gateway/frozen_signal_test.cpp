// SPDX-License-Identifier: Apache-2.0
#include "vehicle/gateway/frozen_signal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/support/tick.hpp"

namespace pitwall::gateway {
namespace {

struct Moment {
  double speed_mps = 60.0, steering_rad = 0.0, command_rad = 0.0, brake_kpa = 0.0;
  double reported_kpa = 0.0, throttle = 0.5, reported_throttle = 0.5, powertrain_mps = 60.0;
  bool reported = true;
};

// From `moment(t)`, with t in seconds: the first instant at which anything is frozen.
double frozen_at(const std::function<Moment(double)>& moment, double end_s,
                 Watched* which = nullptr) {
  FrozenState state;
  world::VehicleSignals signals;
  for (int i = 0; i * 0.01 < end_s; ++i) {
    const Instant now = Instant{} + seconds(1) + kTick * i;
    const Moment m = moment(i * 0.01);
    world::PerWheel wheels{{m.speed_mps, m.speed_mps, m.speed_mps, m.speed_mps}};
    signals.wheel_speed_mps = {wheels, now, true};
    signals.steering_motor_rad = {m.steering_rad, now, true};
    signals.brake = {{m.brake_kpa, m.brake_kpa}, now, true};
    signals.throttle_fraction = {m.throttle, now, true};
    world::Powertrain powertrain;
    powertrain.vehicle_speed_mps = m.powertrain_mps;
    signals.powertrain = {powertrain, now, true};
    judge_frozen(state, signals, now);
    if (state.any()) {
      for (std::size_t w = 0; w < kWatched; ++w)
        if (state.tracks[w].frozen && which != nullptr) *which = static_cast<Watched>(w);
      return i * 0.01;
    }
    world::ActuatorCommand command;
    command.road_wheel_rad = m.command_rad;
    command.brake_kpa = m.reported_kpa;
    command.throttle_fraction = m.reported_throttle;
    store(state, command, m.reported, now);
  }
  return kUnset;
}

constexpr double kRatio = 19.5;

// The motor as it is: 40 ms of delay, 60 ms of lag, reported in halves of a degree.
double follows(const std::function<double(double)>& command, double t) {
  double motor = 0.0;
  for (double at = 0.0; at < t; at += 0.001)
    motor += 0.001 / 0.06 * (kRatio * command(at - 0.04) - motor);
  return std::round(motor / 0.00872665) * 0.00872665;
}

TEST(FrozenSignal, AStraightLineAtOneSpeedFreezesNothing) {
  EXPECT_TRUE(std::isnan(frozen_at([](double) { return Moment{}; }, 10.0)));
}

TEST(FrozenSignal, AMotorThatFollowsIsNotFrozen) {
  const auto weave = [](double t) { return t < 0.0 ? 0.0 : 0.03 * std::sin(3.0 * t); };
  const auto moment = [&](double t) {
    Moment m;
    m.command_rad = weave(t);
    m.steering_rad = follows(weave, t);
    return m;
  };
  EXPECT_TRUE(std::isnan(frozen_at(moment, 4.0)));
}

TEST(FrozenSignal, AnAngleThatStandsWhileTheCarIsToldToTurnIsSeenWithinAFifthOfASecond) {
  const auto moment = [](double t) {
    Moment m;
    m.command_rad = t < 1.0 ? 0.0 : 0.02 * (t - 1.0);  // 22 deg/s at the motor
    return m;
  };
  Watched which{};
  const double at = frozen_at(moment, 3.0, &which);
  EXPECT_GT(at, 1.0);
  EXPECT_LE(at, 1.2);
  EXPECT_EQ(which, Watched::kSteering);
}

TEST(FrozenSignal, WheelsThatStandStillWhileTheCarGathersSpeed) {
  const auto moment = [](double t) {
    Moment m;
    m.powertrain_mps = 30.0 + 4.0 * t;
    m.speed_mps = t < 1.0 ? m.powertrain_mps : 34.0;
    return m;
  };
  Watched which{};
  const double at = frozen_at(moment, 3.0, &which);
  EXPECT_GT(at, 1.0);
  EXPECT_LE(at, 1.2);
  EXPECT_EQ(which, Watched::kWheels);
}

TEST(FrozenSignal, ABrakeThatReportsNothingWhileItIsTold) {
  const auto moment = [](double t) {
    Moment m;
    m.reported_kpa = t < 1.0 ? 0.0 : 3000.0 * (t - 1.0);
    return m;
  };
  Watched which{};
  const double at = frozen_at(moment, 3.0, &which);
  EXPECT_LE(at, 1.22);
  EXPECT_EQ(which, Watched::kBrake);
}

TEST(FrozenSignal, NothingIsJudgedAtAStandstillOrOfAnActuatorThatIsToldNothing) {
  const auto standing = [](double t) {
    Moment m;
    m.speed_mps = m.powertrain_mps = 0.0;
    m.reported_kpa = 1000.0 * t;
    m.command_rad = 0.1 * t;
    return m;
  };
  EXPECT_TRUE(std::isnan(frozen_at(standing, 3.0)));
  const auto unreported = [](double t) {
    Moment m;
    m.reported = false;
    m.command_rad = 0.1 * t;
    return m;
  };
  EXPECT_TRUE(std::isnan(frozen_at(unreported, 3.0)));
}

// At one speed the powertrain says the same for seconds: a wheel that lies must not accuse it, nor
// wheels that lied a moment ago.
TEST(FrozenSignal, WheelsThatLieDoNotAccuseThePowertrainForLong) {
  for (const int liars : {1, 3}) {
    FrozenState state;
    world::VehicleSignals signals;
    int during = 0, after = 0;
    for (int i = 0; i < 100; ++i) {
      const Instant now = Instant{} + seconds(1) + kTick * i;
      world::PerWheel wheels{{22.0, 22.0, 22.0, 22.0}};
      const bool lie = i >= 40 && (i < 60 || liars == 1);
      for (int w = 0; lie && w < liars; ++w) wheels.at[static_cast<std::size_t>(w)] = 0.1 * i;
      signals.wheel_speed_mps = {wheels, now, true};
      world::Powertrain powertrain;
      powertrain.vehicle_speed_mps = 22.0;
      signals.powertrain = {powertrain, now, true};
      judge_frozen(state, signals, now);
      const bool frozen = state.tracks[static_cast<std::size_t>(Watched::kPowertrain)].frozen;
      during += frozen && i < 60 ? 1 : 0;
      after += frozen && i >= 60 ? 1 : 0;
    }
    EXPECT_EQ(during > 0, liars == 3);
    EXPECT_EQ(after, 0);
  }
}

TEST(FrozenSignal, LockedWheelsAreNotFrozen) {
  const auto moment = [](double t) {
    Moment m;
    m.powertrain_mps = 60.0 - 10.0 * t;
    m.speed_mps = t < 1.0 ? m.powertrain_mps : 0.0;
    return m;
  };
  Watched which{};
  const double at = frozen_at(moment, 2.0, &which);
  EXPECT_TRUE(std::isnan(at)) << static_cast<int>(which);
}

TEST(FrozenSignal, AFrozenSignalGrowsOldAndAChangeMakesItYoungAgain) {
  FrozenState state;
  world::VehicleSignals signals;
  Instant now = Instant{} + seconds(1);
  const auto tick = [&](double wheels_mps, double powertrain_mps) {
    now += kTick;
    signals.wheel_speed_mps = {{{wheels_mps, wheels_mps, wheels_mps, wheels_mps}}, now, true};
    world::Powertrain powertrain;
    powertrain.vehicle_speed_mps = powertrain_mps;
    signals.powertrain = {powertrain, now, true};
    judge_frozen(state, signals, now);
  };
  tick(30.0, 30.0);
  tick(30.0, 30.6);
  ASSERT_TRUE(state.any());
  const Instant since = now;
  for (int i = 0; i < 20; ++i) tick(30.0, 30.6);
  EXPECT_EQ(signals.wheel_speed_mps.at, since);
  tick(30.6, 30.7);
  EXPECT_FALSE(state.any());
  EXPECT_EQ(signals.wheel_speed_mps.at, now);
}

}  // namespace
}  // namespace pitwall::gateway
