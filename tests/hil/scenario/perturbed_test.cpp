// Each perturbation against what it does to forces and motion, not against the number it sets.
// SPDX-License-Identifier: Apache-2.0
#include "hil/scenario/perturbed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "hil/plant/compliant/brush_tyre.hpp"
#include "hil/plant/dynamics.hpp"
#include "hil/plant/engine.hpp"
#include "hil/plant/tyre.hpp"

namespace pitwall::plant {
namespace {

using plant::Actuation;
using plant::Params;
using plant::State;
using plant::Surface;
using scenario::Perturbations;

constexpr double kSpeed_mps = 50.0;

State rolling_east(const Params& p, double yaw_rad = 0.0) {
  return plant::rolling(p, plant::standing(p, 0, 0, yaw_rad), kSpeed_mps, 4);
}

double sum(const plant::Wheels& w) { return w[0] + w[1] + w[2] + w[3]; }

TEST(Perturbed, NeutralChangesNoBit) {
  const Params p;
  const Params same = perturbed(p, {});
  EXPECT_EQ(std::memcmp(&p, &same, sizeof p), 0);
  const Surface road{.bank_rad = 0.2, .bank_rate_rad_per_s = 0.01, .grip = 0.7};
  const Surface same_road = perturbed(road, {});
  EXPECT_EQ(std::memcmp(&road, &same_road, sizeof road), 0);
}

TEST(Perturbed, ConsumptionIsTheFuelForTheSameWork) {
  const Params p;
  for (const double factor : {0.87, 1.13}) {
    const Params q = perturbed(p, {.consumption = factor});
    const auto flow = [](const Params& of) {
      return fuel_flow_kgps(of.engine, of.fuel, 6'000, engine_torque_nm(of.engine, 6'000, 0.8));
    };
    EXPECT_NEAR(flow(q), factor * flow(p), 1e-12);
  }
}

TEST(Perturbed, TheSeedDrawsTheConsumptionWithinItsSpread) {
  scenario::Scenario s;
  s.perturb.consumption_spread = 0.13;
  double least = 2.0, most = 0.0;
  for (s.seed = 0; s.seed < 100; ++s.seed) {
    const double drawn = s.plant.fuel.efficiency / plant_of(s).fuel.efficiency;
    EXPECT_EQ(plant_of(s).fuel.efficiency, plant_of(s).fuel.efficiency) << "one seed, one draw";
    least = std::min(least, drawn);
    most = std::max(most, drawn);
  }
  EXPECT_GE(least, 0.87);
  EXPECT_LT(least, 0.89);
  EXPECT_LE(most, 1.13);
  EXPECT_GT(most, 1.11);
}

TEST(Perturbed, WhatWasNotFilledInIsNotCarried) {
  scenario::Scenario s;
  const Params full = plant_of(s);
  EXPECT_EQ(std::memcmp(&full, &s.plant, sizeof full), 0);
  s.start.fuel_l = 20.0;
  const Params p = plant_of(s);
  EXPECT_NEAR(p.fuel.start_kg, 14.9, 1e-9);
  EXPECT_NEAR(full.chassis.mass_kg - p.chassis.mass_kg, full.fuel.start_kg - 14.9, 1e-9);
}

TEST(Perturbed, MassLoadsTheTyresAndKeepsItsRadiusOfGyration) {
  const Params p;
  for (const double added_kg : {-60.0, 60.0, 300.0}) {
    const Params q = perturbed(p, {.mass_kg = added_kg});
    const State s = rolling_east(p);
    const auto before = plant::forces_of(p, s, s.motion, {});
    const auto after = plant::forces_of(q, s, s.motion, {});
    EXPECT_NEAR(sum(after.load_n) - sum(before.load_n), added_kg * kGravity_mps2, 1e-9);
    EXPECT_NEAR(after.body_x_n, before.body_x_n, 1e-9) << "drag knows no mass";
    const double radius2_m2 = p.chassis.yaw_inertia_kgm2 / p.chassis.mass_kg;
    EXPECT_NEAR(q.chassis.yaw_inertia_kgm2 / q.chassis.mass_kg, radius2_m2, 1e-12);
  }
}

TEST(Perturbed, StiffnessTurnsTheCurveAboutItsPeak) {
  const Params p;
  for (const double factor : {0.5, 0.85, 1.15, 2.0}) {
    const Params q = perturbed(p, {.tyre_stiffness = factor});
    for (const auto& [was, is] : {std::pair{p.front, q.front}, std::pair{p.rear, q.rear}})
      for (const double load_n : {1000.0, 2000.0, 4000.0}) {
        EXPECT_NEAR(plant::lat_stiffness_n(is, load_n, 1.0),
                    factor * plant::lat_stiffness_n(was, load_n, 1.0), 1e-6);
        EXPECT_NEAR(plant::long_stiffness_n(is, load_n, 1.0),
                    factor * plant::long_stiffness_n(was, load_n, 1.0), 1e-6);
        double most_was_n = 0.0, most_is_n = 0.0;
        for (double sine = 0.0; sine < 0.5; sine += 1e-4) {
          const double was_n = plant::tyre_force(was, {.sine = sine}, load_n, 1.0).lat_n;
          most_was_n = std::max(most_was_n, was_n);
          const double is_n = plant::tyre_force(is, {.sine = sine / factor}, load_n, 1.0).lat_n;
          most_is_n = std::max(most_is_n, is_n);
          EXPECT_NEAR(is_n, was_n, 1e-9) << "the same force at a slip smaller by the factor";
        }
        EXPECT_NEAR(most_is_n, most_was_n, 1e-9) << "the same friction";
      }
  }
}

TEST(Perturbed, StiffnessTurnsTheCurveOfABrushAsWell) {
  const Params p;
  for (const double factor : {0.5, 2.0}) {
    const Params q = perturbed(p, {.tyre_stiffness = factor});
    for (const double load_n : {1000.0, 4000.0})
      for (double sine = 0.0; sine < 0.5; sine += 1e-3) {
        const TyreSlip was{.sine = sine}, is{.sine = sine / factor};
        EXPECT_NEAR(plant::brush_force(q.rear, q.brush, is, load_n, 1.0).lat_n,
                    plant::brush_force(p.rear, p.brush, was, load_n, 1.0).lat_n, 1e-9);
      }
  }
}

TEST(Perturbed, FrictionScalesEveryTyreForce) {
  const Params p;
  State s = rolling_east(p);
  for (std::size_t i = 0; i < 4; ++i) {
    s.motion.stretch_lat_m[i] = 0.004;
    s.motion.stretch_long_m[i] = -0.003;
  }
  const auto before = plant::forces_of(p, s, s.motion, {.grip = 0.9});
  const auto after =
      plant::forces_of(p, s, s.motion, perturbed(Surface{.grip = 0.9}, {.friction = 0.8}));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT(before.long_n[i], -100.0);
    EXPECT_NEAR(after.lat_n[i], 0.8 * before.lat_n[i], 1e-9);
    EXPECT_NEAR(after.long_n[i], 0.8 * before.long_n[i], 1e-9);
  }
}

TEST(Perturbed, ABankErrorPullsWithItsShareOfGravity) {
  const Params p;
  const State s = rolling_east(p);
  const double track_rad = from_deg(12.0), error_rad = from_deg(1.5);
  const Surface road = perturbed(Surface{.bank_rad = track_rad}, {.bank_error_rad = error_rad});
  const auto rate = plant::derivative_of(p, s, s.motion, road, {});
  EXPECT_NEAR(rate.vy_mps, kGravity_mps2 * std::sin(track_rad + error_rad), 1e-12);
}

// Against the wind the air comes with both speeds; drag goes with the square.
TEST(Perturbed, WindFromAheadRaisesDragByTheKnownAmount) {
  const Params p;
  const double area = 0.5 * p.aero.air_density_kgpm3 * p.aero.drag_area_m2;
  for (const double heading_rad : {0.0, 1.0, -2.5}) {
    const State s = rolling_east(p, heading_rad);
    const auto drag_n = [&](const Perturbations& by) {
      return -plant::forces_of(p, s, s.motion, perturbed(Surface{}, by)).body_x_n;
    };
    const double still_n = drag_n({});
    const double against_n =
        drag_n({.wind_mps = 10.0, .wind_to_rad = heading_rad + std::numbers::pi});
    const double with_n = drag_n({.wind_mps = 10.0, .wind_to_rad = heading_rad});
    EXPECT_NEAR(against_n - still_n, area * (60.0 * 60.0 - 50.0 * 50.0), 1e-6);
    EXPECT_NEAR(with_n - still_n, area * (40.0 * 40.0 - 50.0 * 50.0), 1e-6);
  }
}

TEST(Perturbed, WindAcrossPushesToWhereItBlows) {
  const Params p;
  const State s = rolling_east(p);
  const Surface road =
      perturbed(Surface{}, {.wind_mps = 10.0, .wind_to_rad = std::numbers::pi / 2.0});
  const double north_n = plant::forces_of(p, s, s.motion, road).body_y_n;
  EXPECT_NEAR(north_n,
              0.5 * p.aero.air_density_kgpm3 * p.aero.side_area_m2 * std::hypot(50.0, 10.0) * 10.0,
              1e-6);
}

// Steps until the watched quantity has left its first value.
template <class Watch>
int first_move(const Params& p, const Actuation& after, Watch watch) {
  State s = rolling_east(p);
  Actuation a{.gear = 4, .ignition = true};
  for (int i = 0; i < 700; ++i) s = plant::step(p, s, a, {}, 0.001);  // the lines hold what it did
  a = after;
  const auto before = watch(s);
  for (int i = 1; i < 700; ++i) {
    s = plant::step(p, s, a, {}, 0.001);
    if (watch(s) != before) return i;
  }
  return -1;
}

TEST(Perturbed, EveryDelayShiftsItsActuatorAndNoOther) {
  const auto moves = [](const Perturbations& by) {
    const Params p = perturbed(Params{}, by);
    const Actuation kept{.gear = 4, .ignition = true};
    Actuation steer = kept, throttle = kept, brake = kept, gear = kept;
    steer.steering_motor_rad = 0.2;
    throttle.throttle_fraction = 0.5;
    brake.brake_kpa = 500.0;
    gear.gear = 5;
    return std::array{
        first_move(p, steer, [](const State& s) { return s.motion.steering_motor_rad; }),
        first_move(p, throttle, [](const State& s) { return s.motion.throttle_fraction; }),
        first_move(p, brake, [](const State& s) { return s.motion.brake_front_kpa; }),
        first_move(p, gear, [](const State& s) { return static_cast<int>(s.shift); })};
  };
  const auto still = moves({});
  const std::array<Perturbations, 4> one{{{.steering_delay_s = 0.5},
                                          {.throttle_delay_s = 0.5},
                                          {.brake_delay_s = 0.5},
                                          {.gear_delay_s = 0.5}}};
  for (std::size_t i = 0; i < one.size(); ++i) {
    const auto moved = moves(one[i]);
    for (std::size_t j = 0; j < moved.size(); ++j)
      EXPECT_EQ(moved[j] - still[j], i == j ? 500 : 0) << i << " " << j;
  }
}

TEST(Perturbed, DetectionsHaveTheMeasuredErrorsTimesTheNoise) {
  scenario::Scenario run;
  run.perturb.detection_noise = 2.0;
  const auto modelled = detection_sensors_of(run);
  run.lidar_errors = sensors::DetectorErrors{.rows = {{.from_m = 0.0,
                                                       .to_m = 100.0,
                                                       .found_share = 0.5,
                                                       .position_rms_m = std::numbers::sqrt2,
                                                       .yaw_rms_rad = 0.1}},
                                             .false_per_sweep = 0.25};
  const auto measured = detection_sensors_of(run);
  ASSERT_EQ(measured[0].source, world::DetectionSource::kLidar);
  EXPECT_EQ(modelled[0].lidar.position_sigma_m[0].value, 0.30) << "0.15 m in the model";
  EXPECT_NEAR(measured[0].lidar.position_sigma_m[0].value, 2.0, 1e-12);
  EXPECT_EQ(measured[0].hit_rate[0].value, 0.5);
  EXPECT_EQ(measured[0].false_per_frame, 0.25);
  EXPECT_EQ(measured[1].hit_rate[0].value, modelled[1].hit_rate[0].value);
}

}  // namespace
}  // namespace pitwall::plant
