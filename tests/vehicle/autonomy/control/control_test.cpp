// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/control.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "protocol/transport/clock.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/vehicle/autonomy/control/single_track.hpp"

namespace pitwall::control {
namespace {

using testing::CarModel;
using testing::drive;
using testing::Lap;
using testing::oval;
using testing::recommended;

LateralGains gains_of(const Params& p) {
  const auto gains = prepare(p);
  EXPECT_TRUE(gains) << to_string(gains.error());
  return *gains;
}

TEST(Control, LapsTheOvalAtEverySpeed) {
  const Params p = recommended();
  const LateralGains gains = gains_of(p);
  for (const double v : {5.0, 15.0, 22.5, 37.5, 52.5, 65.0}) {
    const Lap lap = drive(p, gains, oval(), CarModel{}, v, 60.0);
    EXPECT_FALSE(lap.lost) << v;
    EXPECT_LT(lap.cross_track_max_m, 0.6) << v;
    EXPECT_LT(lap.speed_error_max_mps, 1.5) << v;
    EXPECT_LT(lap.angle_rate_rms_rad_per_s, 0.02) << v;  // no weaving
  }
}

TEST(Control, StaysStableWhenTheCarIsNotTheModel) {
  const Params p = recommended();
  const LateralGains gains = gains_of(p);
  for (const double stiffness : {0.8, 1.2}) {
    for (const double mass : {730.0, 850.0}) {
      for (const double lag_s : {0.02, 0.06}) {
        CarModel car;
        car.front_per_load *= stiffness;
        car.rear_per_load *= stiffness;
        car.mass_kg = mass;
        car.steering_lag_s = lag_s;
        car.steering_delay_s = 0.060;
        const Lap lap = drive(p, gains, oval(), car, 65.0, 45.0);
        EXPECT_FALSE(lap.lost) << stiffness << ' ' << mass << ' ' << lag_s;
        EXPECT_LT(lap.cross_track_max_m, 1.5) << stiffness << ' ' << mass << ' ' << lag_s;
        EXPECT_LT(lap.angle_rate_rms_rad_per_s, 0.03) << stiffness << ' ' << mass;
      }
    }
  }
}

TEST(Control, ABadTuneLosesTheCar) {
  // The tests above can fail: a gain far too high for the steering delay does lose the car.
  Params p = recommended();
  for (auto& w : p.lateral.weights) w = {.state = {100.0, 0.0, 100.0, 0.0}, .steering = 1.0};
  const Lap lap = drive(p, gains_of(p), oval(), CarModel{}, 65.0, 45.0);
  EXPECT_TRUE(lap.lost || lap.angle_rate_rms_rad_per_s > 0.3);
}

TEST(Control, HoldsSteeringAndLetsGoWithoutTrajectory) {
  const Params p = recommended();
  const LateralGains gains = gains_of(p);
  State state{.road_wheel_rad = 0.02,
              .longitudinal = {0.7, 0.0},
              .gear = {},
              .steering = {},
              .speed = {},
              .lqr_ff = {}};
  const world::Trajectory none;
  testing::Car car;
  car.vx_mps = 40.0;
  for (int i = 0; i < 100; ++i) {
    const Instant now{i * 10'000'000LL};
    const world::EgoState ego = car.ego(now);
    const Output out =
        step(p, gains, state, {.ego = ego, .trajectory = none}, now, milliseconds(10));
    EXPECT_EQ(out.lateral.verdict, LateralVerdict::kNoTrajectory);
    EXPECT_EQ(out.command.road_wheel_rad, 0.02);
    EXPECT_LE(out.command.throttle_fraction, state.longitudinal.throttle_fraction);
    EXPECT_EQ(out.command.at, now);
    state = out.next;
  }
  EXPECT_EQ(state.longitudinal.throttle_fraction, 0.0);
  EXPECT_EQ(state.longitudinal.brake_kpa, 0.0);
}

TEST(Control, CommandIsFiniteWhateverTheEgo) {
  Params p = recommended();
  const LateralGains gains = gains_of(p);
  const auto path = oval();
  for (const double bad : {kUnset, 1.0 / 0.0, -1.0 / 0.0, 1e300}) {
    for (int field = 0; field < 6; ++field) {
      world::EgoState ego = testing::Car{}.ego(Instant{});
      ego.vx_mps = 20.0;
      double* const fields[] = {&ego.x_m,    &ego.y_m,    &ego.yaw_rad,
                                &ego.vx_mps, &ego.vy_mps, &ego.yaw_rate_rad_per_s};
      *fields[field] = bad;
      const world::Trajectory t = path.window(0.0, 20.0);
      for (const Controller& controller : kControllers) {
        p.controller = controller;
        const Output out =
            step(p, gains, {}, {.ego = ego, .trajectory = t}, Instant{}, milliseconds(10));
        EXPECT_LE(std::abs(out.command.road_wheel_rad), p.lateral.angle_max_rad);
        EXPECT_GE(out.command.throttle_fraction, 0.0);
        EXPECT_LE(out.command.throttle_fraction, 1.0);
        EXPECT_GE(out.command.brake_kpa, 0.0);
        EXPECT_LE(out.command.brake_kpa, p.longitudinal.brake_max_kpa);
      }
    }
  }
}

// A tick of every controller with all that it can be given: engine, gearbox, what was applied.
struct FullTick {
  Params params = recommended();
  LateralGains gains;
  world::Trajectory trajectory = oval().window(700.0, 45.0);
  testing::Car car;
  world::ActuatorCommand applied{.throttle_fraction = 0.3, .brake_kpa = 0.0};

  FullTick() {
    params.speed.car.engine = envelope::testing::av21_engine();
    gains = gains_of(params);
    car.vx_mps = 43.0;
    car.x_m = trajectory.points[4].x_m, car.y_m = trajectory.points[4].y_m + 0.3;
    car.yaw_rad = trajectory.points[4].yaw_rad;
  }
  Output run(const Controller& controller, State state, Instant now) {
    params.controller = controller;
    return step(params, gains, state,
                {.ego = car.ego(now),
                 .trajectory = trajectory,
                 .gearbox = {.known = true, .gear = 3, .shifting = false},
                 .tyre_c = 70.0,
                 .climb_rad = 0.01,
                 .applied = &applied},
                now, milliseconds(10));
  }
};

TEST(Control, TakesNothingFromTheHeap) {
  if (!pitwall::testing::kAllocationsCounted) GTEST_SKIP() << "the sanitizer has its own heap";
  FullTick tick;
  EXPECT_EQ(pitwall::testing::allocations_of([&] {
              for (const Controller& controller : kControllers)
                (void)tick.run(controller, {}, Instant{});
            }),
            0u);
}

// Of the least time of each tick in several runs: the rest is disturbance by the machine.
TEST(Control, ATickCostsAtMostTwentyMicroseconds) {
  constexpr double kMost_us = 20.0;
  constexpr std::size_t kTicks = 400, kRuns = 8;
  for (const Controller& controller : kControllers) {
    std::array<double, kTicks> least_us;
    least_us.fill(1e9);
    for (std::size_t run = 0; run < kRuns; ++run) {
      FullTick tick;
      State state;
      state.gear.gear = 3;
      for (std::size_t i = 0; i < kTicks; ++i) {
        const Instant now{static_cast<std::int64_t>(i) * 10'000'000};
        tick.car.vx_mps = 43.0 + 0.005 * static_cast<double>(i);
        const Duration before = transport::thread_time();
        const Output out = tick.run(controller, state, now);
        const double took_us = (transport::thread_time() - before).seconds() * 1e6;
        least_us[i] = std::min(least_us[i], took_us);
        state = out.next;
      }
    }
    std::ranges::sort(least_us);
    EXPECT_LE(least_us[kTicks * 99 / 100], kMost_us) << controller.name;
    std::printf("%s: %.2f us, p99 of %zu ticks\n", std::string(controller.name).c_str(),
                least_us[kTicks * 99 / 100], kTicks);
  }
}

TEST(Control, PrepareNamesTheIllegalParameter) {
  const auto place = [](auto change) {
    Params p = recommended();
    change(p);
    const auto gains = prepare(p);
    return gains ? std::string("legal") : gains.error().place;
  };
  EXPECT_EQ(place([](Params&) {}), "legal");
  EXPECT_EQ(place([](Params& p) { p.controller = controller_named("pid"); }), "controller");
  EXPECT_EQ(place([](Params& p) { p.bicycle.mass_kg = kUnset; }), "bicycle.mass_kg");
  EXPECT_EQ(place([](Params& p) { p.lateral.angle_max_rad = 1.0; }), "lateral.angle_max_rad");
  EXPECT_EQ(place([](Params& p) { p.longitudinal.kp_per_mps = -1.0; }), "longitudinal.kp_per_mps");
  EXPECT_EQ(place([](Params& p) { p.gear.up_above_mps[2] = 1.0; }), "gear.up_above_mps[2]");
  EXPECT_EQ(place([](Params& p) { p.gear.down_below_mps[1] = 99.0; }), "gear.down_below_mps[1]");
  EXPECT_EQ(place([](Params& p) { p.steering.damping = 0.0; }), "steering.damping");
  EXPECT_EQ(place([](Params& p) { p.steering.lead_s = kUnset; }), "steering.lead_s");
  EXPECT_EQ(place([](Params& p) { p.steering.bicycle.wheelbase_m = 0.0; }),
            "steering.bicycle.wheelbase_m");
  EXPECT_EQ(place([](Params& p) { p.steering.learning.lag_s = 0.0; }), "steering.learning.lag_s");
}

}  // namespace
}  // namespace pitwall::control
