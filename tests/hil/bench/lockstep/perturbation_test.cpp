// What a scenario does to the modelled car and its road arrives in the rig, composes with faults,
// and leaves the map of the car alone.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "hil/bench/lockstep/lockstep.hpp"
#include "tests/hil/bench/standing.hpp"

namespace pitwall::bench {
namespace {

scenario::Scenario standing_in_a_turn() {
  scenario::Scenario s = standing();
  s.start.s_m = 600.0;  // banked
  return s;
}

Rig rig_of(const scenario::Scenario& s) {
  auto rig = Rig::build(s, lap().setup.track);
  if (!rig) ADD_FAILURE() << to_string(rig.error());
  return *std::move(rig);
}

template <class Look>
void each_step(Rig& rig, Duration span, Look look) {
  for (Instant at = Instant{} + kRigStep; at - Instant{} <= span; at += kRigStep) {
    rig.step({}, at);
    look(at);
  }
}

std::string digest_of(const scenario::Scenario& s) {
  const auto run = run_lockstep(s, lap().setup, {.log = nowhere()});
  if (!run) ADD_FAILURE() << to_string(run.error());
  return run ? run->digest : "";
}

TEST(RigPerturbation, NeutralOnesChangeNoByteOfTheRunAndOthersDo) {
  scenario::Scenario s = lap().scenario;
  s.duration = seconds(14);
  const std::string plain = digest_of(s);
  s.perturb = {.mass_kg = 0.0, .tyre_stiffness = 1.0, .wind_mps = 0.0, .wind_to_rad = 2.0};
  EXPECT_EQ(digest_of(s), plain);
  for (const scenario::Perturbations& by : {scenario::Perturbations{.mass_kg = 60.0},
                                            {.tyre_stiffness = 0.85},
                                            {.friction = 0.8},
                                            {.bank_error_rad = 0.02},
                                            {.wind_mps = 10.0},
                                            {.steering_delay_s = 0.05},
                                            {.throttle_delay_s = 0.05},
                                            {.brake_delay_s = 0.1},
                                            {.gear_delay_s = 0.1}}) {
    s.perturb = by;
    EXPECT_NE(digest_of(s), plain);
  }
}

TEST(RigPerturbation, TheCarLeansMoreThanItsMapSays) {
  scenario::Scenario s = standing_in_a_turn();
  s.perturb.bank_error_rad = from_deg(1.5);
  Rig rig = rig_of(s);
  const double map_rad = lap().setup.track.at(s.start.s_m).bank_rad;
  EXPECT_GT(map_rad, 0.2);
  EXPECT_NEAR(rig.truth().bank_rad, map_rad + from_deg(1.5), 1e-12);
  each_step(rig, seconds(3), [&](Instant) {
    EXPECT_NEAR(rig.truth().bank_rad, map_rad + from_deg(1.5), 1e-4);
    EXPECT_NEAR(rig.road().surface.bank_rad, map_rad, 1e-4);
  });
  // What an accelerometer of the standing car feels across: all of gravity that the bank lets.
  EXPECT_NEAR(std::abs(rig.truth().specific_force_mps2[1]),
              kGravity_mps2 * std::sin(rig.truth().bank_rad), 0.01);
}

TEST(RigPerturbation, MassAndPlantAreThoseOfTheScenario) {
  scenario::Scenario s = standing_in_a_turn();
  s.perturb.mass_kg = 100.0;
  s.plant.chassis.mass_kg = 700.0;
  Rig rig = rig_of(s);
  each_step(rig, milliseconds(500), [](Instant) {});
  const plant::Wheels& load_n = rig.truth().load_n;
  EXPECT_NEAR(load_n[0] + load_n[1] + load_n[2] + load_n[3],
              800.0 * kGravity_mps2 * std::cos(rig.truth().bank_rad), 1.0);
}

TEST(RigPerturbation, FrictionComposesWithTheFaultOfGrip) {
  // On a bank the standing car uses tan(bank) / mu of what its tyres can; the plant bounds that.
  const auto use_of = [](double friction, double fault_grip) {
    scenario::Scenario s = standing_in_a_turn();
    s.perturb.friction = friction;
    s.faults = {fault_at(Duration{}, "low_grip", fault_grip)};
    Rig rig = rig_of(s);
    each_step(rig, milliseconds(800), [](Instant) {});
    return rig.truth().friction_use;
  };
  EXPECT_NEAR(use_of(0.8, 0.9), use_of(0.9, 0.8), 1e-9);
  EXPECT_NEAR(use_of(0.72, 1.0), use_of(0.8, 0.9), 1e-9);
  EXPECT_GT(use_of(0.8, 0.9), 1.2 * use_of(1.0, 1.0));
}

TEST(RigFaults, ColdTyresAreHeldAtTheirTemperatureAndThenWarmUp) {
  scenario::Scenario s = standing_in_a_turn();
  s.faults = {fault_at(seconds(1), "cold_tyres", 15.0)};
  Rig rig = rig_of(s);
  each_step(rig, seconds(3), [&](Instant at) {
    const double tyre_c = rig.truth().tyre_c[0];
    if (at < Instant{} + seconds(1))
      EXPECT_NEAR(tyre_c, s.tyres.temperature_c, 1.0);
    else if (at < Instant{} + seconds(2))
      EXPECT_EQ(tyre_c, 15.0);
    else
      EXPECT_NEAR(tyre_c, 15.0, 1.0);
  });
  EXPECT_GT(rig.truth().tyre_c[0], 15.0) << "the air is warmer";
}

TEST(RigFaults, AnEmptyTankStopsTheEngineForGood) {
  scenario::Scenario s = lap().scenario;
  s.duration = seconds(24);
  s.faults = {fault_at(seconds(20), "fuel_out")};
  LockstepOptions options;
  int ran = 0, stood = 0;
  options.watch = [&](const pipeline::Outputs&, const Rig& rig, Instant at) {
    const Duration t = at - Instant{};
    if (t > seconds(12) && t < seconds(20)) ran += rig.truth().engine_running ? 1 : 0;
    if (t > seconds(20)) stood += rig.truth().engine_running ? 0 : 1;
    EXPECT_EQ(rig.truth().fuel_kg > 0.0, t < seconds(20)) << t.seconds();
  };
  ASSERT_TRUE(run_lockstep(s, lap().setup, options));
  EXPECT_EQ(ran, 799);
  EXPECT_EQ(stood, 400);
}

TEST(RigFaults, ABiasedGyroIsWrongByTheBiasInItsUnitOnly) {
  const auto rates = [](double bias, int unit) {
    scenario::Scenario s = standing_in_a_turn();
    s.faults = {fault_at(seconds(1), "imu_bias", bias)};
    s.faults[0].unit = 1;
    Rig rig = rig_of(s);
    std::vector<std::pair<Instant, double>> received;
    each_step(rig, seconds(3), [&](Instant) {
      for (const auto& sample : rig.take_samples().imu)
        if (sample.unit == unit) received.emplace_back(sample.at, sample.rate_rad_per_s[2]);
    });
    return received;
  };
  EXPECT_EQ(rates(0.05, 0), rates(0.0, 0));
  const auto plain = rates(0.0, 1), biased = rates(0.05, 1);
  ASSERT_EQ(plain.size(), biased.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const Duration at = plain[i].first - Instant{};
    const bool active = at >= seconds(1) && at < seconds(2);
    EXPECT_NEAR(biased[i].second - plain[i].second, active ? 0.05 : 0.0, 1e-12);
  }
}

TEST(RigFaults, LostWheelSpeedsTakeTheirReportAndNoOther) {
  scenario::Scenario s = standing_in_a_turn();
  s.faults = {fault_at(seconds(1), "wheel_speed_loss")};
  Rig rig = rig_of(s);
  std::array<int, 3> wheels{}, steering{};  // by second
  each_step(rig, milliseconds(2999), [&](Instant at) {
    const auto second = static_cast<std::size_t>((at - Instant{}).seconds());
    for (const Outgoing& outgoing : rig.take_frames()) {
      wheels[second] += outgoing.frame.id == 1300 ? 1 : 0;
      steering[second] += outgoing.frame.id == 1303 ? 1 : 0;
    }
  });
  EXPECT_NEAR(wheels[0], 200, 1);
  EXPECT_EQ(wheels[1], 0);
  EXPECT_NEAR(wheels[2], 200, 1);
  for (const int count : steering) EXPECT_NEAR(count, 100, 1);
}

}  // namespace
}  // namespace pitwall::bench
