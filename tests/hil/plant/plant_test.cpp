// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/plant.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include "tests/hil/plant/rolling_car.hpp"
#include "tests/hil/plant/step.hpp"

namespace pitwall::plant {
namespace {

Actuation drive(double motor_rad, double throttle, double brake_kpa, std::uint8_t gear) {
  return {.steering_motor_rad = motor_rad,
          .throttle_fraction = throttle,
          .brake_kpa = brake_kpa,
          .gear = gear,
          .ignition = true};
}

State run(const Params& p, State s, const Actuation& a, const Surface& road, double duration_s) {
  const auto steps = std::lround(duration_s / kStep_s);
  for (long i = 0; i < steps; ++i) s = step(p, s, a, road, kStep_s);
  return s;
}

TEST(Plant, OneLongStepIsManyShortOnes) {
  const Params p;
  const State s = rolling_car(30.0, 3);
  State many = s;
  for (int i = 0; i < 10; ++i) many = step(p, many, drive(0.4, 0.2, 0.0, 3), {}, 0.001);
  const State one = step(p, s, drive(0.4, 0.2, 0.0, 3), {}, 0.010);
  EXPECT_EQ(std::memcmp(&many.motion, &one.motion, sizeof(Motion)), 0);
}

// ---- Standstill.
TEST(Plant, HoldsOnABankWithoutCreeping) {
  Params p;
  p.thermal.cold_grip_loss = 0.0;  // tyres that cool yield more: by 20 um in a minute
  const Surface bank{.bank_rad = from_deg(20.0)};
  const Actuation hold = drive(0.0, 0.0, 1000.0, 0);
  const State settled = run(p, standing(p, 0.0, 0.0, 0.5), hold, bank, 10.0);
  const State later = run(p, settled, hold, bank, 60.0);
  EXPECT_LT(std::hypot(settled.motion.x_m, settled.motion.y_m), 0.05);  // settles into its tyres
  EXPECT_NEAR(later.motion.x_m, settled.motion.x_m, 1e-6);
  EXPECT_NEAR(later.motion.y_m, settled.motion.y_m, 1e-6);
  EXPECT_NEAR(later.motion.yaw_rad, settled.motion.yaw_rad, 1e-8);
  // What holds it is the side force of the tyres.
  const Truth t = observe(p, later, bank);
  EXPECT_NEAR(t.specific_force_mps2[1], -kGravity_mps2 * std::sin(bank.bank_rad), 1e-6);
}

TEST(Plant, SlidesDownABankThatIsSteeperThanItsGrip) {
  const Params p;
  const Surface ice{.bank_rad = from_deg(20.0), .grip = 0.15};
  const State s = run(p, standing(p, 0.0, 0.0, 0.0), drive(0.0, 0.0, 1000.0, 0), ice, 3.0);
  EXPECT_GT(s.motion.y_m, 1.0);  // to the lower, left side
}

TEST(Plant, StandsStillInGearWithTheThrottleClosed) {
  const Params p;
  const State s =
      run(p, rolling(p, standing(p, 1.0, 2.0, 0.3), 0.0, 1), drive(0.0, 0.0, 0.0, 1), {}, 10.0);
  EXPECT_DOUBLE_EQ(s.motion.x_m, 1.0);
  EXPECT_DOUBLE_EQ(s.motion.vx_mps, 0.0);
}

TEST(Plant, BrakesToACompleteStopFromAnySpeed) {
  const Params p;
  for (const double speed_mps : {1.0, 10.0, 40.0, 80.0})
    for (const double brake_kpa : {300.0, 1500.0, 6000.0})
      for (const double motor_rad : {0.0, 0.8}) {
        const Actuation stop = drive(speed_mps < 30.0 ? motor_rad : 0.0, 0.0, brake_kpa, 0);
        State s = rolling_car(speed_mps, 0);
        for (int i = 0; i < 90'000 && std::hypot(s.motion.vx_mps, s.motion.vy_mps) > 1e-9; ++i)
          s = step(p, s, stop, {}, kStep_s);
        EXPECT_LT(std::hypot(s.motion.vx_mps, s.motion.vy_mps), 1e-6)
            << speed_mps << " " << brake_kpa;
        const State later = run(p, s, stop, {}, 2.0);
        EXPECT_NEAR(later.motion.x_m, s.motion.x_m, 1e-3);
      }
}

// ---- Steady turn.
TEST(Plant, SteadyTurnBalancesLateralForces) {
  const Params p;
  for (const double bank_deg : {0.0, 20.0}) {
    const Surface road{.bank_rad = from_deg(bank_deg)};
    // Held near 45 m/s by a proportional throttle.
    State s = rolling_car(45.0, 4);
    for (int i = 0; i < 20'000; ++i)
      s = step(p, s, drive(0.30, 0.25 + 0.3 * (45.0 - s.motion.vx_mps), 0.0, 4), road, kStep_s);
    const Truth t = observe(p, s, road);
    EXPECT_NEAR(t.specific_force_mps2[1] + kGravity_mps2 * std::sin(road.bank_rad),
                s.motion.vx_mps * s.motion.yaw_rate_rad_per_s, 0.02);
    EXPECT_GT(t.yaw_rate_rad_per_s, 0.05);  // left steering turns left
    EXPECT_GT(t.load_n[1], t.load_n[0]);    // and loads the right
    // Heading turns with the path: a closed circle in the map.
    const double radius_m = t.speed_mps / t.heading_rate_rad_per_s;
    const State lap = run(p, s, drive(0.30, 0.25 + 0.3 * (45.0 - s.motion.vx_mps), 0.0, 4), road,
                          2.0 * std::numbers::pi / t.heading_rate_rad_per_s);
    EXPECT_LT(std::hypot(lap.motion.x_m - s.motion.x_m, lap.motion.y_m - s.motion.y_m),
              0.02 * radius_m);
    // Neither far under- nor oversteering: near the kinematic curvature of the map.
    const double wheelbase_m = p.chassis.front_axle_m + p.chassis.rear_axle_m;
    EXPECT_NEAR(t.yaw_rate_rad_per_s * wheelbase_m / t.vx_mps, std::tan(t.road_wheel_rad), 0.008);
  }
}

// Hands off on a bank the car turns or slides to the low side only as physics says: gravity pulls
// left when the left side is lower.
TEST(Plant, GravityPullsToTheLowerSide) {
  const Params p;
  const State s =
      run(p, rolling_car(30.0, 3), drive(0.0, 0.1, 0.0, 3), {.bank_rad = from_deg(10.0)}, 1.0);
  EXPECT_GT(s.motion.y_m, 0.05);
}

// ---- Truth.
TEST(Plant, AccelerometerFeelsWhatChangesTheVelocity) {
  const Params p;
  const Surface road{.bank_rad = 0.3};
  State s = run(p, rolling_car(40.0, 3), drive(0.5, 0.6, 0.0, 3), road, 0.3);
  for (int i = 0; i < 200; ++i) {
    const State before = s, mid = step(p, before, drive(0.5, 0.6, 0.0, 3), road, kStep_s);
    s = step(p, mid, drive(0.5, 0.6, 0.0, 3), road, kStep_s);
    const Truth t = observe(p, mid, road);
    const double dvx = (s.motion.vx_mps - before.motion.vx_mps) / (2.0 * kStep_s);
    const double dvy = (s.motion.vy_mps - before.motion.vy_mps) / (2.0 * kStep_s);
    EXPECT_NEAR(t.specific_force_mps2[0], dvx - t.vy_mps * t.yaw_rate_rad_per_s, 0.01);
    EXPECT_NEAR(t.specific_force_mps2[1],
                dvy + t.vx_mps * t.yaw_rate_rad_per_s - kGravity_mps2 * std::sin(0.3), 0.01);
    EXPECT_NEAR(t.specific_force_mps2[2],
                kGravity_mps2 * std::cos(0.3) + t.vx_mps * t.yaw_rate_rad_per_s * std::tan(0.3),
                1e-9);
    EXPECT_NEAR(t.map_vx_mps, (s.motion.x_m - before.motion.x_m) / (2.0 * kStep_s), 1e-3);
    EXPECT_NEAR(t.map_vy_mps, (s.motion.y_m - before.motion.y_m) / (2.0 * kStep_s), 1e-3);
    EXPECT_NEAR(t.heading_rate_rad_per_s,
                (s.motion.yaw_rad - before.motion.yaw_rad) / (2.0 * kStep_s), 1e-4);
  }
}

TEST(Plant, StandingOnABankFeelsGravityOnly) {
  const Params p;
  const Surface road{.bank_rad = 0.25};
  const Actuation hold = drive(0.0, 0.0, 1000.0, 0);
  const Truth t = observe(p, run(p, standing(p, 0, 0, 0), hold, road, 10.0), road);
  EXPECT_NEAR(std::hypot(t.specific_force_mps2[1], t.specific_force_mps2[2]), kGravity_mps2, 1e-6);
  EXPECT_LT(t.specific_force_mps2[1], 0.0);
}

// ---- Actuators.
TEST(Plant, SteeringHasDelayLagRateAndResolution) {
  const Params p;
  State s = rolling_car(20.0, 2);
  const double command_rad = from_deg(20.2);  // shall be taken as 20.0
  double before_rad = 0.0, fastest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    s = step(p, s, drive(command_rad, 0.0, 0.0, 2), {}, kStep_s);
    ASSERT_EQ(s.motion.steering_motor_rad > 0.0, i >= 40) << i;
    fastest = std::max(fastest, (s.motion.steering_motor_rad - before_rad) / kStep_s);
    before_rad = s.motion.steering_motor_rad;
  }
  EXPECT_NEAR(s.motion.steering_motor_rad, from_deg(20.0), 1e-6);
  EXPECT_LE(fastest, p.steering.rate_max_rad_per_s + 1e-9);
  s = run(p, s, drive(99.0, 0.0, 0.0, 2), {}, 3.0);
  EXPECT_NEAR(s.motion.steering_motor_rad, p.steering.angle_max_rad, 0.01);
}

TEST(Plant, BrakesAndThrottleLag) {
  const Params p;
  const State s = run(p, rolling_car(60.0, 4), drive(0.0, 1.0, 2000.0, 4), {}, 0.1);
  EXPECT_NEAR(s.motion.brake_front_kpa, 2000.0 * (1.0 - std::exp(-1.0)), 1.0);
  EXPECT_NEAR(s.motion.throttle_fraction, 1.0 - std::exp(-2.0), 1e-3);
}

// First substep at which each actuator has answered a step of its command.
struct Answered {
  int throttle = -1, brake = -1, gear = -1;
};

Answered answers_of(const Params& p) {
  State s = rolling_car(40.0, 3, p);
  Answered seen;
  for (int i = 0; i < 900; ++i) {
    s = step(p, s, drive(0.0, 0.5, 2000.0, 4), {}, kStep_s);
    if (seen.throttle < 0 && s.motion.throttle_fraction > 0.0) seen.throttle = i;
    if (seen.brake < 0 && s.motion.brake_front_kpa > 0.0) seen.brake = i;
    if (seen.gear < 0 && s.shift != ShiftPhase::kReady) seen.gear = i;
  }
  return seen;
}

TEST(Plant, ActuatorsAnswerAfterTheirDelayAndNotBefore) {
  for (const auto& [throttle_s, brake_s, shift_s] :
       {std::array{0.0, 0.0, 0.0}, std::array{0.120, 0.050, 0.003},
        std::array{0.500, 0.600, 0.639}}) {
    Params p;
    p.engine.throttle_delay_s = throttle_s;
    p.brakes.delay_s = brake_s;
    p.drivetrain.shift_delay_s = shift_s;
    const Answered seen = answers_of(p);
    EXPECT_EQ(seen.throttle, std::lround(1e3 * throttle_s));
    EXPECT_EQ(seen.brake, std::lround(1e3 * brake_s));
    EXPECT_EQ(seen.gear, std::lround(1e3 * shift_s));
  }
}

TEST(Plant, ADelayedGearBoxKeepsTheGearThatItRollsIn) {
  Params p;
  p.drivetrain.shift_delay_s = 0.4;
  State s = rolling_car(40.0, 3, p);
  for (int i = 0; i < 1000; ++i) {
    s = step(p, s, drive(0.0, 0.2, 0.0, 3), {}, kStep_s);
    ASSERT_EQ(s.gear, 3);
    ASSERT_EQ(s.shift, ShiftPhase::kReady);
  }
}

TEST(Plant, WindPushesTheCarItsWay) {
  const Params p;
  const auto after = [&](double east_mps, double north_mps) {
    return run(p, rolling_car(50.0, 0), drive(0.0, 0.0, 0.0, 0),
               {.wind_east_mps = east_mps, .wind_north_mps = north_mps}, 2.0);
  };
  const State still = after(0.0, 0.0);
  EXPECT_LT(after(-15.0, 0.0).motion.vx_mps, still.motion.vx_mps - 0.5);
  EXPECT_GT(after(15.0, 0.0).motion.vx_mps, still.motion.vx_mps + 0.4);
  EXPECT_GT(after(0.0, 10.0).motion.y_m, 0.1);
  EXPECT_LT(after(0.0, -10.0).motion.y_m, -0.1);
}

TEST(Plant, AnEmptyTankLeavesALighterCarThatCoasts) {
  const Params p;
  State s = rolling_car(50.0, 4);
  empty_tank(p, s);
  const Truth dry = observe(p, s, {}), full = observe(p, rolling_car(50.0, 4), {});
  EXPECT_EQ(dry.fuel_kg, 0.0);
  EXPECT_EQ(full.fuel_kg, p.fuel.start_kg);
  const auto sum = [](const Wheels& w) { return w[0] + w[1] + w[2] + w[3]; };
  EXPECT_NEAR(sum(full.load_n) - sum(dry.load_n), p.fuel.start_kg * kGravity_mps2, 1e-9);
  s = run(p, s, drive(0.0, 1.0, 0.0, 4), {}, 3.0);
  EXPECT_FALSE(s.engine_running);
  EXPECT_LT(s.motion.vx_mps, 48.0);
  // The lighter car feels the same drag more.
  State empty = rolling_car(70.0, 0);
  empty_tank(p, empty);
  EXPECT_LT(observe(p, empty, {}).specific_force_mps2[0],
            observe(p, rolling_car(70.0, 0), {}).specific_force_mps2[0]);
}

TEST(Plant, ALapBurnsLessThanAKilogram) {
  const Params p;
  State s = rolling_car(58.0, 6);
  for (int i = 0; i < 40'000; ++i)
    s = step(p, s, drive(0.0, 0.5 + 0.1 * (58.0 - s.motion.vx_mps), 0.0, 6), {}, kStep_s);
  EXPECT_GT(s.fuel_used_kg, 0.25);
  EXPECT_LT(s.fuel_used_kg, 1.0);
}

TEST(Plant, AFaultTakesPowerOrBrakesAway) {
  const Params whole;
  Params weak = whole;
  weak.engine.power = 0.5;
  weak.brakes.front_remaining = 0.0;
  const auto speed = [](const Params& p, const Actuation& a) {
    return run(p, rolling_car(40.0, 3, p), a, {}, 2.0).motion.vx_mps;
  };
  EXPECT_LT(speed(weak, drive(0.0, 1.0, 0.0, 3)), speed(whole, drive(0.0, 1.0, 0.0, 3)) - 3.0);
  EXPECT_GT(speed(weak, drive(0.0, 0.0, 1500.0, 0)),
            speed(whole, drive(0.0, 0.0, 1500.0, 0)) + 3.0);
}

// ---- Performance: plausible, from published figures of the car.
struct Sprint {
  double top_mps = 0.0, to_60_s = 0.0;
};

Sprint full_throttle() {
  const Params p;
  State s = rolling_car(0.0, 1);
  Sprint result;
  std::uint8_t gear = 1;
  for (int i = 0; i < 90'000; ++i) {
    if (s.gear == gear && s.shift == ShiftPhase::kReady && s.engine_rpm > 6800.0 && gear < 6)
      ++gear;
    s = step(p, s, drive(0.0, 1.0, 0.0, gear), {}, kStep_s);
    if (result.to_60_s == 0.0 && s.motion.vx_mps > 60.0) result.to_60_s = i * kStep_s;
    result.top_mps = std::max(result.top_mps, s.motion.vx_mps);
  }
  return result;
}

TEST(Plant, TopSpeedAndAccelerationArePlausible) {
  const Sprint r = full_throttle();
  EXPECT_GT(r.top_mps, 70.0);
  EXPECT_LT(r.top_mps, 85.0);
  EXPECT_GT(r.to_60_s, 5.0);
  EXPECT_LT(r.to_60_s, 15.0);
}

// ---- Road.
world::TrackMap ring(bool with_pit) {
  world::TrackDescription d;
  d.name = "ring";
  constexpr double kRadius_m = 200.0;
  d.length_m = 2.0 * std::numbers::pi * kRadius_m;
  d.datum_latitude_deg = 36.0, d.datum_longitude_deg = -115.0, d.datum_height_m = 0.0;
  for (int i = 0; i < 8; ++i)
    d.knots.push_back(
        {i * d.length_m / 8, 1.0 / kRadius_m, 0.1 + 0.01 * std::min(i, 8 - i), 6.0, 9.0});
  if (with_pit)
    d.pit = world::PitLane{.entry_s_m = 1200.0,
                           .exit_s_m = 100.0,
                           .offset_m = 20.0,
                           .width_m = 10.0,
                           .speed_limit_mps = 20.0};
  auto map = world::TrackMap::build(d);
  if (!map) throw std::runtime_error(to_string(map.error()));
  return *std::move(map);
}

TEST(Road, GapsAreThoseOfTheNearestCorner) {
  const Params p;
  const auto map = ring(false);
  for (const double n_m : {-7.0, 0.0, 4.5}) {
    const auto point = map.offset(300.0, n_m);
    const Road r = road_at(p, map, standing(p, point.x_m, point.y_m, point.yaw_rad));
    EXPECT_NEAR(r.s_m, 300.0, 1e-6);
    EXPECT_NEAR(r.n_m, n_m, 1e-6);
    EXPECT_NEAR(r.wall_gap_left_m, 6.0 - n_m - 0.5 * p.chassis.width_m, 1e-6);
    EXPECT_NEAR(r.wall_gap_right_m, 9.0 + n_m - 0.5 * p.chassis.width_m, 1e-6);
    EXPECT_FALSE(r.contact);
    const Road across =
        road_at(p, map, standing(p, point.x_m, point.y_m, point.yaw_rad + std::numbers::pi / 2));
    EXPECT_LT(across.wall_gap_left_m, r.wall_gap_left_m);
  }
  const auto outside = map.offset(300.0, -8.5);
  EXPECT_TRUE(road_at(p, map, standing(p, outside.x_m, outside.y_m, outside.yaw_rad)).contact);
}

TEST(Road, ThePitLaneIsRoomToTheLeft) {
  const Params p;
  const auto map = ring(true);
  for (const auto& [s_m, contact] :
       {std::pair{50.0, false}, std::pair{1230.0, false}, std::pair{600.0, true}}) {
    const auto point = map.offset(s_m, 20.0);
    EXPECT_EQ(road_at(p, map, standing(p, point.x_m, point.y_m, point.yaw_rad)).contact, contact);
  }
}

TEST(Road, BankRateIsTheDerivativeOfBankAlongThePath) {
  const Params p;
  const auto map = ring(false);
  const auto here = map.offset(200.0, 2.0);
  State s = rolling(p, standing(p, here.x_m, here.y_m, here.yaw_rad), 30.0, 3);
  const Road r = road_at(p, map, s);
  s.motion.x_m += 0.01 * 30.0 * std::cos(here.yaw_rad);
  s.motion.y_m += 0.01 * 30.0 * std::sin(here.yaw_rad);
  const Road later = road_at(p, map, s, r.s_m);
  EXPECT_NEAR(r.surface.bank_rate_rad_per_s, (later.surface.bank_rad - r.surface.bank_rad) / 0.01,
              1e-4);
  EXPECT_NE(r.surface.bank_rate_rad_per_s, 0.0);
}

}  // namespace
}  // namespace pitwall::plant
