// The bounds of an impact where no stop on the track can be promised, and that the scenarios name
// no other.
// SPDX-License-Identifier: Apache-2.0
#include "tests/system/safe_stop/impact_bound.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "hil/bench/loading.hpp"
#include "tests/hil/plant/shipped.hpp"
#include "tests/system/cars/car_stops.hpp"
#include "tests/system/safe_stop/racing_faults.hpp"

namespace pitwall::testing {
namespace {

const pipeline::Setup& lvms() { return flying_lap("lvms").setup; }

plant::Params plant_of(const char* name) { return plant::testing::shipped_car(name).params; }

scenario::Scenario scenario_of(const std::string& name) {
  const std::string root = PITWALL_SOURCE_DIR;
  const auto read = bench::load(root + "/hil/scenarios/" + name + ".yaml", root);
  if (!read) ADD_FAILURE() << to_string(read.error());
  return read ? read->scenario : scenario::Scenario{};
}

// A car of the three for each of the tracks.
TEST(ImpactBound, OnEachTrack) {
  constexpr std::array kTracks{"lvms", "ims", "tms"};
  for (std::size_t i = 0; i < kTracks.size(); ++i) {
    const plant::Params car = plant_of(kRacingCars[i]);
    for (const Loss loss : {Loss::kSteering, Loss::kReference, Loss::kComputer}) {
      const ImpactBound b = bound_impact({loss, flying_lap(kTracks[i]).setup, car, kRacing_mps});
      std::printf(
          "%-4s %-14s %-14s at most %4.1f m/s (lost at s %4.0f, %s wall after %3.0f m, "
          "%.1f s); normal %4.1f m/s (lost at s %4.0f)\n",
          kTracks[i], kRacingCars[i], text_of(loss), b.fastest.speed_mps, b.fastest.from_s_m,
          b.fastest.left ? "left" : "right", b.fastest.after_m, b.fastest.after_s,
          b.steepest.normal_mps, b.steepest.from_s_m);
      EXPECT_LE(b.steepest.normal_mps, b.fastest.speed_mps);
      EXPECT_LE(b.fastest.speed_mps, kRacing_mps);
    }
  }
}

// Stronger brakes cannot raise it, and a slower car does not hit harder.
TEST(ImpactBound, FallsWithTheBrakesAndWithTheSpeed) {
  plant::Params car = plant_of("av21");
  const auto of = [&](double speed_mps) {
    return bound_impact({Loss::kComputer, lvms(), car, speed_mps}).fastest.speed_mps;
  };
  const double plain_mps = of(kRacing_mps);
  EXPECT_GT(plain_mps, 0.0);
  EXPECT_LT(of(kRacing_mps - 15.0), plain_mps);
  car.brakes.front_nm_per_kpa *= 1.5, car.brakes.rear_nm_per_kpa *= 1.5;
  EXPECT_LT(of(kRacing_mps), plain_mps);
}

// v^2 = v0^2 - 2 a d: the impact is no faster than the drive-by-wire's brake alone leaves of the
// speed over the way to the wall, and no slower than brake and air together would.
TEST(ImpactBound, KeepsTheEnergyOfTheBrake) {
  const plant::Params car = plant_of("av21");
  const Impact hit = bound_impact({Loss::kComputer, lvms(), car, kRacing_mps}).fastest;
  const double brake_mps2 = 1800.0 * (0.351 / 0.301 + 0.299 / 0.3118) / 790.0;
  const double air_mps2 = 0.5 * 1.12 * 0.858 / 790.0 * kRacing_mps * kRacing_mps;
  const double late_m = kRacing_mps * (0.1 + 0.1 + 1800.0 / 3000.0);
  const auto left_mps = [&](double decel_mps2, double way_m) {
    return std::sqrt(kRacing_mps * kRacing_mps - 2.0 * decel_mps2 * std::max(0.0, way_m));
  };
  EXPECT_LE(hit.speed_mps, left_mps(brake_mps2, hit.after_m - late_m));
  EXPECT_GE(hit.speed_mps, left_mps(brake_mps2 + air_mps2 + 0.2, hit.after_m));
}

// v dk/ds (L + K v^2) where the curvature of Las Vegas rises fastest, from 440 to 475 m; banking
// takes off at most a fifth. A motor of 6 degrees per second can do that of our own car only.
TEST(ImpactBound, KnowsHowFastTheMotorHasToTurn) {
  const auto motor_rad_per_s = [](const char* name) {
    const plant::Params car = plant_of(name);
    return car.steering.ratio *
           steering_rate_rad_per_s({Loss::kSteering, lvms(), car, kRacing_mps});
  };
  const double flat_rad_per_s = 19.5 * kRacing_mps * (0.00416 - 0.00345) / 35.0 *
                                (2.971 + 0.0022 * kRacing_mps * kRacing_mps);
  EXPECT_LE(motor_rad_per_s("av21_putnam"), flat_rad_per_s);
  EXPECT_GE(motor_rad_per_s("av21_putnam"), 0.8 * flat_rad_per_s);
  EXPECT_GT(motor_rad_per_s("av21_putnam"), kSlowMotor_rad_per_s);
  EXPECT_LT(motor_rad_per_s("av21"), kSlowMotor_rad_per_s);
}

// A scenario names the hardest of the three cars, rounded up to the next metre per second.
TEST(ImpactBound, IsWhatTheScenariosName) {
  const std::pair<const char*, Loss> kNamed[] = {{"steering_stuck", Loss::kSteering},
                                                 {"gnss_both_out", Loss::kReference},
                                                 {"computer_and_guardian_killed", Loss::kComputer}};
  for (const auto& [name, loss] : kNamed) {
    double most_mps = 0.0;
    for (const char* plant : kRacingCars)
      most_mps = std::max(
          most_mps, bound_impact({loss, lvms(), plant_of(plant), kRacing_mps}).fastest.speed_mps);
    const auto& contact = scenario_of(name).contact;
    ASSERT_TRUE(contact) << name;
    EXPECT_EQ(contact->at_most_mps, std::ceil(most_mps)) << name << " " << most_mps;
  }
}

}  // namespace
}  // namespace pitwall::testing
