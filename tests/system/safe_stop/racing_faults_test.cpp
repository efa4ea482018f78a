// Faults at racing speed in a turn of Las Vegas, on both structures and in the set-up that
// understeers.
// SPDX-License-Identifier: Apache-2.0
#include "tests/system/safe_stop/racing_faults.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/hil/plant/shipped.hpp"
#include "tests/system/cars/car_stops.hpp"
#include "tests/system/safe_stop/impact_bound.hpp"

namespace pitwall::testing {
namespace {

constexpr double kAtLeast_mps = 60.0, kSpinFrom_deg = 20.0;

constexpr std::array kBounded{std::pair{RacingFault::kSteeringStuck, Loss::kSteering},
                              std::pair{RacingFault::kReference, Loss::kReference},
                              std::pair{RacingFault::kComputer, Loss::kComputer}};

// A slow motor cannot turn the wheels back as fast as the car that understeers needs: it hits no
// faster than one that holds them. Has to be told once it does not hit.
bool is_too_slow(const std::string& car, RacingFault fault) {
  return fault == RacingFault::kSteeringSlow && car == "av21_putnam";
}

void expect_within_bound(const ImpactCase& lost, const RacingFigures& f, const std::string& row) {
  const ImpactBound bound = bound_impact(lost);
  EXPECT_LE(f.impact_mps, bound.fastest.speed_mps) << row;
  EXPECT_LE(f.normal_mps, bound.steepest.normal_mps) << row;
}

class RacingFaults : public ::testing::TestWithParam<const char*> {};

TEST_P(RacingFaults, EndWithoutContactOrWithinTheirBound) {
  const plant::Params plant = plant::testing::shipped_car(GetParam()).params;
  const pipeline::Setup& setup = flying_lap("lvms").setup;
  const RacingResults results = race_into_faults(plant);
  for (std::size_t i = 0; i < kRacingFaults; ++i) {
    const auto fault = static_cast<RacingFault>(i);
    const RacingFigures& f = results[i];
    const std::string row = row_of(fault, f);
    std::printf("%-14s %s\n", GetParam(), row.c_str());
    ASSERT_TRUE(f.begun) << row;
    EXPECT_GE(f.from_mps, kAtLeast_mps) << row;
    EXPECT_TRUE(f.stood || f.contact) << row;
    if (fault >= RacingFault::kSteeringStuck) continue;
    EXPECT_EQ(f.contact, is_too_slow(GetParam(), fault)) << row;
    EXPECT_LT(f.slip_deg, kSpinFrom_deg) << row;
    if (!f.contact) continue;
    const ImpactCase held{Loss::kSteering, setup, plant, kRacing_mps};
    EXPECT_GT(steering_rate_rad_per_s(held), kSlowMotor_rad_per_s / plant.steering.ratio) << row;
    expect_within_bound(held, f, row);
  }
  for (const auto& [fault, loss] : kBounded) {
    const RacingFigures& f = results[static_cast<std::size_t>(fault)];
    expect_within_bound({loss, setup, plant, kRacing_mps}, f, row_of(fault, f));
  }
}

INSTANTIATE_TEST_SUITE_P(Cars, RacingFaults, ::testing::ValuesIn(kRacingCars));

}  // namespace
}  // namespace pitwall::testing
