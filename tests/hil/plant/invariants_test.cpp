// What must hold of every structure of the plant whatever its parameters are: left is right
// mirrored, coasting never gains energy, a standing car stays, the tyres carry what there is to
// carry, the integrator keeps its order, and what is finite stays finite.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "hil/plant/compliant/brush_tyre.hpp"
#include "hil/plant/dynamics.hpp"
#include "hil/plant/plant.hpp"
#include "hil/plant/powertrain.hpp"
#include "hil/plant/tyre.hpp"
#include "protocol/vocabulary/random.hpp"
#include "tests/hil/plant/rolling_car.hpp"
#include "tests/hil/plant/step.hpp"

namespace pitwall::plant {
namespace {

class Invariants : public ::testing::TestWithParam<Structure> {
 protected:
  static Params params() {
    Params p;
    p.structure = GetParam();
    return p;
  }
};

INSTANTIATE_TEST_SUITE_P(EveryStructure, Invariants,
                         ::testing::Values(Structure::kDoubleTrack, Structure::kCompliantBrush),
                         [](const auto& given) {
                           return given.param == Structure::kDoubleTrack ? "DoubleTrack"
                                                                         : "CompliantBrush";
                         });

using MotionNumbers = std::array<double, sizeof(Motion) / sizeof(double)>;
MotionNumbers numbers_of(const Motion& m) { return std::bit_cast<MotionNumbers>(m); }

struct RandomValues {
  Random random;
  explicit RandomValues(std::uint64_t seed) : random{seed} {}
  double operator()(double low, double high) { return low + (high - low) * random.uniform(); }
};

// ---- Mirror: left becomes right, exactly. Compared with ==, so that only the sign of a zero may
// differ.
Wheels mirrored(const Wheels& w) { return {w[1], w[0], w[3], w[2]}; }
Wheels negated(Wheels w) {
  for (double& v : w) v = -v;
  return w;
}

State mirrored(State s) {
  Motion& m = s.motion;
  m.y_m = -m.y_m, m.yaw_rad = -m.yaw_rad, m.vy_mps = -m.vy_mps;
  m.yaw_rate_rad_per_s = -m.yaw_rate_rad_per_s;
  m.wheel_rad_per_s = mirrored(m.wheel_rad_per_s);
  m.stretch_long_m = mirrored(m.stretch_long_m);
  m.stretch_lat_m = negated(mirrored(m.stretch_lat_m));
  m.load_ay_mps2 = -m.load_ay_mps2;
  m.steering_motor_rad = -m.steering_motor_rad;
  m.roll_rad = -m.roll_rad, m.roll_rate_rad_per_s = -m.roll_rate_rad_per_s;
  m.steering_flex_rad = -m.steering_flex_rad;
  s.locked = {s.locked[1], s.locked[0], s.locked[3], s.locked[2]};
  for (double& v : s.steering_delay_rad) v = -v;
  s.tyre_c = mirrored(s.tyre_c);
  return s;
}

Actuation mirrored(Actuation a) {
  a.steering_motor_rad = -a.steering_motor_rad;
  return a;
}

// North becomes south: the car starts to the east.
Surface mirrored(Surface road) {
  road.bank_rad = -road.bank_rad;
  road.bank_rate_rad_per_s = -road.bank_rate_rad_per_s;
  road.wind_north_mps = -road.wind_north_mps;
  return road;
}

void expect_equal(const State& a, const State& b, double time_s) {
  const MotionNumbers x = numbers_of(a.motion), y = numbers_of(b.motion);
  for (std::size_t i = 0; i < x.size(); ++i)
    ASSERT_EQ(x[i], y[i]) << "entry " << i << " at " << time_s << " s";
  ASSERT_EQ(a.locked, b.locked);
  ASSERT_EQ(a.tyre_c, b.tyre_c);
  ASSERT_EQ(a.gear, b.gear);
  ASSERT_EQ(a.engine_rpm, b.engine_rpm);
  ASSERT_EQ(a.fuel_used_kg, b.fuel_used_kg);
}

// Beyond the limit of grip, with wheels that lock and spin, gears that change, wind and banking.
TEST_P(Invariants, LeftAndRightAreMirroredExactly) {
  Params p = params();
  p.thermal.cold_grip_loss = p.thermal.hot_grip_loss = 0.2;
  p.aero.side_arm_m = -0.3;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    RandomValues dice(seed);
    State left = rolling_car(dice(0.0, 70.0), 3, p), right = left;
    Actuation a{.gear = 3, .ignition = true};
    Surface road;
    for (int i = 0; i < 3000; ++i) {
      if (i % 200 == 0) {
        a.steering_motor_rad = dice(-3.0, 3.0);
        a.throttle_fraction = std::max(0.0, dice(-0.5, 1.0));
        a.brake_kpa = std::max(0.0, dice(-6000.0, 6000.0));
        a.gear = static_cast<std::uint8_t>(dice(0.0, 6.99));
        road = {.bank_rad = dice(-0.35, 0.35),
                .grip = dice(0.3, 1.2),
                .wind_east_mps = dice(-10.0, 10.0),
                .wind_north_mps = dice(-10.0, 10.0)};
      }
      left = step(p, left, a, road, kStep_s);
      right = step(p, right, mirrored(a), mirrored(road), kStep_s);
      ASSERT_NO_FATAL_FAILURE(expect_equal(left, mirrored(right), i * kStep_s)) << seed;
    }
    EXPECT_GT(std::abs(left.motion.yaw_rad), 1e-3);
  }
}

// ---- Energy.
// What the tyres' deflections hold, by the law of their force at the loads that they have.
double stored_j(const Params& p, const State& s, const Surface& road) {
  constexpr int kParts = 16;
  const Forces f = forces_of(p, s, s.motion, road);
  double sum_j = 0.0;
  for (std::size_t i = 0; i < world::kCorners; ++i) {
    const Tyre& tyre = tyre_of(p, i);
    const double long_m = s.motion.stretch_long_m[i], lat_m = s.motion.stretch_lat_m[i];
    for (int part = 0; part < kParts; ++part) {
      const double share = (part + 0.5) / kParts / tyre.relaxation_m;
      const TyreSlip slip{share * long_m, share * lat_m};
      const TyreForce force = p.structure == Structure::kDoubleTrack
                                  ? tyre_force(tyre, slip, f.load_n[i], road.grip)
                                  : brush_force(tyre, p.brush, slip, f.load_n[i], road.grip);
      sum_j += (force.long_n * long_m + force.lat_n * lat_m) / kParts;
    }
  }
  return sum_j;
}

double moving_j(const Params& p, const State& s) {
  const Motion& m = s.motion;
  double sum_j = 0.5 * mass_kg(p, s) * (m.vx_mps * m.vx_mps + m.vy_mps * m.vy_mps) +
                 0.5 * p.chassis.yaw_inertia_kgm2 * m.yaw_rate_rad_per_s * m.yaw_rate_rad_per_s;
  for (std::size_t i = 0; i < world::kCorners; ++i)
    sum_j += 0.5 * tyre_of(p, i).wheel_inertia_kgm2 * m.wheel_rad_per_s[i] * m.wheel_rad_per_s[i];
  return sum_j;
}

// Of an engine that turns with the wheels.
double engine_j(const Params& p, const State& s) {
  if (!clutch_of(p, s, s.motion).engaged) return 0.0;
  const double mean = 0.5 * (s.motion.wheel_rad_per_s[2] + s.motion.wheel_rad_per_s[3]);
  const double engine_rad_per_s = total_ratio(p.drivetrain, s) * mean;
  return 0.5 * p.engine.inertia_kgm2 * engine_rad_per_s * engine_rad_per_s;
}

struct Grown {
  double moving_j = -1e9, resting_j = -1e9;  // most in one step; most above the least before
};

// Sum of motion, rotation, height lost along the way (the body's left points down the bank) and
// what the tyres hold.
Grown coast(const Params& p, State s, const Actuation& a, const Surface& road, int steps) {
  constexpr double kRocking_mps = 0.5;
  Grown grown;
  double height_j = 0.0;
  const auto all_j = [&] {
    return moving_j(p, s) + engine_j(p, s) + height_j + stored_j(p, s, road);
  };
  double before_j = all_j(), least_j = before_j;
  for (int i = 0; i < steps; ++i) {
    const double vy_mps = s.motion.vy_mps;
    s = step(p, s, a, road, kStep_s);
    height_j -= mass_kg(p, s) * kGravity_mps2 * std::sin(road.bank_rad) * 0.5 *
                (vy_mps + s.motion.vy_mps) * kStep_s;
    const double now_j = all_j();
    if (std::hypot(s.motion.vx_mps, s.motion.vy_mps) > kRocking_mps)
      grown.moving_j = std::max(grown.moving_j, now_j - before_j);
    else
      grown.resting_j = std::max(grown.resting_j, now_j - least_j);
    before_j = now_j, least_j = std::min(least_j, now_j);
  }
  return grown;
}

// The air is still and no gear is in. While the car moves nothing is gained in any step. When it
// has stopped and rocks on its tyres, some joules come and go: pitch and roll are a first-order
// lag of the loads here, so what the suspension's springs hold is not in the sum.
TEST_P(Invariants, CoastingNeverGainsEnergy) {
  const Params p = params();
  int stopped = 0;
  for (std::uint64_t seed = 0; seed < 36; ++seed) {
    RandomValues dice(seed);
    State s = rolling_car(seed % 3 == 0 ? dice(1.0, 10.0) : dice(10.0, 85.0), 0, p);
    s.motion.vy_mps = std::max(0.0, dice(-6.0, 6.0));
    const Actuation a{.steering_motor_rad = dice(-1.0, 1.0) * dice(0.0, 4.0),
                      .brake_kpa = std::max(0.0, dice(-3000.0, 6000.0))};
    const Surface road{.bank_rad = dice(-0.35, 0.35), .grip = dice(0.4, 1.2)};
    const Grown grown = coast(p, s, a, road, 2000);
    EXPECT_LE(grown.moving_j, 0.0) << seed;
    EXPECT_LE(grown.resting_j, 20.0) << seed;  // what the car gives up sinking by 3 mm
    stopped += grown.resting_j > -1e8 ? 1 : 0;
  }
  EXPECT_GE(stopped, 3) << "too few of them came to rest";
}

// With the throttle closed the engine only brakes, whatever gear turns it.
TEST_P(Invariants, CoastingInGearNeverGainsEnergy) {
  const Params p = params();
  for (std::uint8_t gear = 1; gear <= 6; ++gear)
    for (const double bank_rad : {-0.3, 0.0, 0.2}) {
      const double engine_rad_per_s = from_rpm(6800.0);
      const double speed_mps = engine_rad_per_s * p.rear.radius_m /
                               (p.drivetrain.final_drive * p.drivetrain.gear[gear - 1U]);
      const Actuation a{.steering_motor_rad = 0.5, .gear = gear, .ignition = true};
      const Grown grown =
          coast(p, rolling_car(speed_mps, gear, p), a, {.bank_rad = bank_rad}, 1500);
      EXPECT_LE(grown.moving_j, 0.0) << int{gear} << " " << bank_rad;
    }
}

// ---- Standstill.
// On the banking of an oval, brakes on or free: it sinks into its tyres and stays.
TEST_P(Invariants, AStandingCarStays) {
  const Params p = params();
  for (const double bank_rad : {-0.4, 0.15, 0.4})
    for (const double brake_kpa : {0.0, 2000.0}) {
      const Surface road{.bank_rad = bank_rad};
      const Actuation a{.brake_kpa = brake_kpa};
      State s = standing(p, 0.0, 0.0, 0.0);
      for (int i = 0; i < 3000; ++i) s = step(p, s, a, road, kStep_s);
      const State settled = s;
      for (int i = 0; i < 5000; ++i) s = step(p, s, a, road, kStep_s);
      const Motion &now = s.motion, &then = settled.motion;
      EXPECT_LT(std::hypot(now.x_m - then.x_m, now.y_m - then.y_m), 1e-5) << bank_rad;
      EXPECT_LT(std::hypot(then.x_m, then.y_m), 0.02) << bank_rad;
      EXPECT_LT(std::abs(now.yaw_rad - then.yaw_rad), 1e-6) << bank_rad;
    }
}

// ---- Loads.
double sum_of(const Wheels& w) { return (w[0] + w[1]) + (w[2] + w[3]); }

TEST_P(Invariants, LoadsCarryWeightDownforceAndBanking) {
  const Params p = params();
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    RandomValues dice(seed);
    State s = rolling_car(dice(0.0, 85.0), 5, p);
    s.motion.yaw_rate_rad_per_s = dice(-0.4, 0.4);
    s.motion.yaw_rad = dice(-3.0, 3.0);
    s.motion.load_ax_mps2 = dice(-40.0, 30.0);  // far beyond what lifts wheels
    s.motion.load_ay_mps2 = dice(-60.0, 60.0);
    s.motion.roll_rad = dice(-0.1, 0.1);
    s.fuel_used_kg = dice(0.0, p.fuel.start_kg);
    const Surface road{.bank_rad = dice(-0.35, 0.35),
                       .wind_east_mps = dice(-15.0, 15.0),
                       .wind_north_mps = dice(-15.0, 15.0)};
    const Truth t = observe(p, s, road);
    const double air_mps = s.motion.vx_mps - road.wind_east_mps * std::cos(s.motion.yaw_rad) -
                           road.wind_north_mps * std::sin(s.motion.yaw_rad);
    const double down_n = 0.5 * p.aero.air_density_kgpm3 * air_mps * air_mps *
                          (p.aero.front_lift_area_m2 + p.aero.rear_lift_area_m2);
    const double kilograms = p.chassis.mass_kg - s.fuel_used_kg;
    const double weight_n = kilograms * kGravity_mps2 * std::cos(road.bank_rad);
    const double banking_n =
        kilograms * s.motion.vx_mps * s.motion.yaw_rate_rad_per_s * std::tan(road.bank_rad);
    const double expected_n = std::max(0.0, weight_n + banking_n) + down_n;
    ASSERT_NEAR(sum_of(t.load_n), expected_n, 1e-9 * expected_n) << seed;
    for (const double load_n : t.load_n) ASSERT_GE(load_n, 0.0) << seed;
  }
}

// While no wheel lifts, the loads also carry the moments of the accelerations.
TEST_P(Invariants, LoadsCarryPitchAndRoll) {
  const Params p = params();
  const Chassis& c = p.chassis;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    RandomValues dice(seed);
    State s = rolling_car(dice(0.0, 85.0), 5, p);
    const Wheels level = observe(p, s, {}).load_n;
    const double ax_mps2 = dice(-15.0, 8.0), ay_mps2 = dice(-14.0, 14.0);
    settle_loads(p, c.mass_kg, ax_mps2, ay_mps2, s.motion);
    const Wheels n = observe(p, s, {}).load_n;
    const double pitch_nm = (n[2] + n[3] - level[2] - level[3]) * (c.front_axle_m + c.rear_axle_m);
    const double roll_nm = 0.5 * ((n[1] - n[0]) * c.track_front_m + (n[3] - n[2]) * c.track_rear_m);
    ASSERT_GT(*std::min_element(n.begin(), n.end()), 0.0) << "the case lifts a wheel";
    EXPECT_NEAR(pitch_nm, c.mass_kg * c.height_m * ax_mps2, 1e-6);
    EXPECT_NEAR(roll_nm, c.mass_kg * c.height_m * ay_mps2, 1e-6);
  }
}

// ---- Integrator.
double apart(const State& a, const State& b) {
  const MotionNumbers x = numbers_of(a.motion), y = numbers_of(b.motion);
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += (x[i] - y[i]) * (x[i] - y[i]);
  return std::sqrt(sum);
}

// All of the continuous state on a smooth manoeuvre. What is not smooth is held off: set points
// stand still from the first substep on (no delay, no dead band), the rate limit of the steering is
// out of reach, no gear is in (the engine's tables have kinks, gears and clutch switch), wheels
// roll freely (their holding torque changes sign at standstill), no wheel lifts, and temperature,
// which goes by one Euler step per substep, has no effect on grip and rolling.
TEST_P(Invariants, RungeKuttaConvergesWithItsOrder) {
  Params p = params();
  p.thermal.cold_grip_loss = p.thermal.rolling_fall_per_k = 0.0;
  p.steering.rate_max_rad_per_s = 1e3;
  p.steering.delay_s = 0.0;
  p.hydraulics.dead_band_kpa = 0.0;
  // The force of a brush has a curvature that jumps where slip changes its sign.
  const double order = p.structure == Structure::kDoubleTrack ? 4.0 : 3.0;
  constexpr double kSpan_s = 0.06;
  for (const double speed_mps : {20.0, 50.0, 75.0})
    for (const double brake_kpa : {0.0, 600.0}) {
      const auto after = [&](int steps) {
        Params fine = p;
        fine.substep_s = kSpan_s / steps;
        return step(fine, rolling_car(speed_mps, 0, fine),
                    {.steering_motor_rad = 0.6, .brake_kpa = brake_kpa},
                    {.bank_rad = 0.2, .wind_north_mps = 5.0}, kSpan_s);
      };
      const State exact = after(12'800);
      double coarse = apart(after(60), exact);  // the step in use
      EXPECT_LT(coarse, 1e-6);
      for (const int steps : {120, 240}) {
        const double fine = apart(after(steps), exact);
        EXPECT_GE(std::log2(coarse / fine), order - 0.2)
            << speed_mps << " " << coarse << " " << fine;
        coarse = fine;
      }
    }
}

// ---- Finite stays finite.
TEST_P(Invariants, RemainsFiniteWhateverIsAskedOfIt) {
  Params p = params();
  p.engine.throttle_delay_s = 0.1, p.brakes.delay_s = 0.2, p.drivetrain.shift_delay_s = 0.3;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    RandomValues dice(seed);
    State s = rolling_car(70.0, 6, p);
    for (int i = 0; i < 8'000; ++i) {
      const std::array<double, 4> wild{1e300, -1e300, std::nan(""), dice(-4.0, 4.0)};
      const auto any = [&] { return wild[static_cast<std::size_t>(dice(0.0, 3.999))]; };
      Actuation a{.steering_motor_rad = dice(-4.0, 4.0),
                  .throttle_fraction = dice(0.0, 1.0),
                  .brake_kpa = i % 3000 < 1500 ? 0.0 : dice(0.0, 6000.0),
                  .gear = 3,
                  .ignition = true};
      if (i % 20 == 0)
        a = {.steering_motor_rad = any(),
             .throttle_fraction = any(),
             .brake_kpa = any(),
             .gear = static_cast<std::uint8_t>(dice(0.0, 255.9)),
             .ignition = dice(0.0, 1.0) < 0.9,
             .starter = dice(0.0, 1.0) < 0.5};
      s = step(p, s, a,
               {.bank_rad = 0.35 * std::sin(i * 1e-3),
                .grip = dice(0.05, 1.5),
                .wind_east_mps = dice(-40.0, 40.0),
                .wind_north_mps = dice(-40.0, 40.0)},
               kStep_s);
      for (const double v : numbers_of(s.motion)) ASSERT_TRUE(std::isfinite(v)) << seed << " " << i;
      ASSERT_TRUE(std::isfinite(s.engine_rpm) && std::isfinite(sum_of(s.tyre_c)));
      ASSERT_LT(std::abs(s.motion.vx_mps), 120.0) << seed << " " << i;
    }
  }
}

}  // namespace
}  // namespace pitwall::plant
