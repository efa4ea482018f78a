// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/localization.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/support/allocation_guard.hpp"
#include "tests/vehicle/autonomy/localization/drive.hpp"

namespace pitwall::localization {
namespace {

using testing::banked_turn;
using testing::Course;
using testing::Rig;
using world::Excludable;
using world::Monitor;
using world::Validity;

// On the heap: a state of the filter is large.
std::unique_ptr<Rig> rig_on(const Course& course, FilterKind kind = FilterKind::kSpatial) {
  auto rig = std::make_unique<Rig>();
  rig->course = course;
  rig->params.filter.kind = kind;
  return rig;
}

constexpr auto kFilters = {FilterKind::kPlanar, FilterKind::kSpatial};

TEST(Localization, FindsTheCarOnStraightsTurnsAndAtRest) {
  for (const FilterKind kind : kFilters) {
    for (const Course& course :
         {Course{}, banked_turn(55.0), banked_turn(20.0), Course{.speed_mps = 0.0}}) {
      auto rig = rig_on(course, kind);
      rig->run(6.0);
      double error2 = 0.0, yaw2 = 0.0, speed2 = 0.0;
      for (int i = 0; i < 600; ++i) {
        const world::EgoState ego = rig->tick().ego, truth = rig->truth();
        ASSERT_EQ(ego.validity, Validity::kGood);
        ASSERT_EQ(ego.at, rig->now());
        ASSERT_TRUE(rig->out.seen.empty()) << rig->out.seen.bits;
        error2 += std::pow(rig->position_error_m(), 2);
        yaw2 += std::pow(wrap_pi(ego.yaw_rad - truth.yaw_rad), 2);
        speed2 += std::pow(ego.vx_mps - truth.vx_mps, 2) + std::pow(ego.vy_mps - truth.vy_mps, 2);
      }
      EXPECT_LT(std::sqrt(error2 / 600.0), 0.03) << course.speed_mps;
      EXPECT_LT(std::sqrt(yaw2 / 600.0), from_deg(0.2)) << course.speed_mps;
      EXPECT_LT(std::sqrt(speed2 / 600.0), 0.15) << course.speed_mps;
    }
  }
}

TEST(Localization, SaysHeightRollAndPitch) {
  auto rig = rig_on(banked_turn());
  rig->run(6.0);
  const world::EgoState truth = rig->truth(), &ego = rig->out.ego;
  EXPECT_NEAR(ego.z_m, truth.z_m, 0.05);
  EXPECT_NEAR(ego.roll_rad, truth.roll_rad, from_deg(0.5));
  EXPECT_NEAR(ego.pitch_rad, truth.pitch_rad, from_deg(0.5));
}

TEST(Localization, StartsOnlyWithPositionAndHeading) {
  auto rig = rig_on(Course{.speed_mps = 0.0});
  const auto at_start = rig->tick();
  EXPECT_EQ(at_start.ego.validity, Validity::kNever);
  EXPECT_TRUE(std::isnan(at_start.ego.x_m));
  for (int i = 0; i < 12; ++i) EXPECT_EQ(rig->tick().ego.validity, Validity::kNever) << i;
  EXPECT_GT(rig->count(Source::kPosition, 0, Gate::kNotStarted), 0u);
  rig->run(0.5);  // the first heading is true at 0.1 s and arrives at 0.15 s
  EXPECT_EQ(rig->out.ego.validity, Validity::kGood);
}

TEST(Localization, AnyMixOfBothUnitsThatCompletesAStateIsUsed) {
  auto rig = rig_on(banked_turn());
  rig->sensors.no_heading[0] = rig->sensors.imu_silent[0] = true;
  rig->sensors.no_position[1] = true;
  rig->run(6.0);
  EXPECT_EQ(rig->out.ego.validity, Validity::kGood);
  EXPECT_LT(rig->position_error_m(), 0.06);
  EXPECT_EQ(rig->out.in_use[static_cast<std::size_t>(Source::kPosition)], 1);
  EXPECT_EQ(rig->out.in_use[static_cast<std::size_t>(Source::kHeading)], 2);
  EXPECT_EQ(rig->out.in_use[static_cast<std::size_t>(Source::kImu)], 2);
}

// The law of the acceptance: one unit bad by 0.3 m, or one whose variance jumps, moves the car by
// at most 0.10 m; it is refused with its reason, seen, and let in again only after a while.
TEST(Localization, OneUnitThatStepsNeverDragsTheSolution) {
  for (const FilterKind kind : kFilters) {
    for (const std::size_t bad : {0u, 1u}) {
      auto rig = rig_on(banked_turn(), kind);
      rig->run(8.0);
      rig->sensors.east_m[bad] = 0.3;
      rig->run(0.09);  // 30 ms late, 20 Hz
      EXPECT_TRUE(rig->out.seen.has(Monitor::kInnovation)) << bad;
      EXPECT_TRUE(rig->out.seen.has(Monitor::kUnitAgreement)) << bad;
      for (int i = 0; i < 1000; ++i) {
        rig->tick();
        ASSERT_LT(rig->position_error_m(), 0.10) << bad << " " << i;
        ASSERT_EQ(rig->out.ego.validity, Validity::kGood);
      }
      EXPECT_GE(rig->count(Source::kPosition, bad, Gate::kOutlier) +
                    rig->count(Source::kPosition, bad, Gate::kDisagrees),
                195u);
      EXPECT_EQ(rig->count(Source::kPosition, 1 - bad, Gate::kOutlier), 0u);
      EXPECT_EQ(rig->state.restarts, 0u);
      rig->sensors.east_m[bad] = 0.0;
      rig->run(0.5);
      EXPECT_EQ(rig->state.streams[0][bad].verdict, Gate::kProbation);
      rig->run(1.0);
      EXPECT_EQ(rig->state.streams[0][bad].verdict, Gate::kAccepted);
    }
  }
}

TEST(Localization, AUnitThatDriftsAwayIsToldFromTheOtherOne) {
  for (const std::size_t bad : {0u, 1u}) {
    auto rig = rig_on(banked_turn());
    rig->run(10.0);
    for (int i = 0; i < 2000; ++i) {
      rig->sensors.east_m[bad] += 0.0005;  // 5 cm/s, up to 1 m
      rig->tick();
      ASSERT_LT(rig->position_error_m(), 0.12) << bad << " " << i;
    }
    EXPECT_GT(rig->count(Source::kPosition, bad, Gate::kDisagrees) +
                  rig->count(Source::kPosition, bad, Gate::kOutlier),
              300u);
    EXPECT_LT(rig->count(Source::kPosition, 1 - bad, Gate::kDisagrees) +
                  rig->count(Source::kPosition, 1 - bad, Gate::kOutlier),
              20u);
  }
}

TEST(Localization, AVarianceThatJumpsIsRefusedOrWeighedLess) {
  for (const double factor : {20.0, 200.0}) {
    auto rig = rig_on(banked_turn());
    rig->run(8.0);
    rig->sensors.reported_sigma_factor[0] = factor;
    rig->sensors.east_m[0] = 0.5;
    for (int i = 0; i < 500; ++i) {
      rig->tick();
      ASSERT_LT(rig->position_error_m(), 0.10) << factor << " " << i;
    }
    EXPECT_TRUE(rig->out.seen.has(Monitor::kSolution));
    EXPECT_EQ(rig->state.streams[0][0].verdict, Gate::kTooUncertain);
  }
}

// Both become worse at once: there is nothing better, and they go on being used.
TEST(Localization, TwoVariancesThatJumpTogetherAreUsed) {
  auto rig = rig_on(banked_turn());
  rig->run(8.0);
  rig->sensors.reported_sigma_factor = {20.0, 20.0};
  rig->run(0.3);
  for (int i = 0; i < 300; ++i) {
    rig->tick();
    ASSERT_LE(rig->out.position_age_s, 0.2) << i;
  }
}

TEST(Localization, GoesOnWithEitherUnit) {
  for (const std::size_t lost : {0u, 1u}) {
    auto rig = rig_on(banked_turn());
    rig->run(6.0);
    rig->sensors.silent[lost] = true;  // with its IMU
    for (int i = 0; i < 1000; ++i) {
      ASSERT_EQ(rig->tick().ego.validity, Validity::kGood) << lost;
      ASSERT_LT(rig->position_error_m(), 0.10) << lost;
    }
    EXPECT_TRUE(rig->out.seen.has(Monitor::kStreamAge));
    EXPECT_EQ(rig->state.streams[0][lost].verdict, Gate::kSilent);
  }
}

TEST(Localization, DeadReckonsThenIsLostThenRecovers) {
  auto rig = rig_on(banked_turn());
  rig->run(15.0);
  rig->sensors.no_fix = true;
  rig->run(0.5);
  EXPECT_EQ(rig->out.ego.validity, Validity::kDeadReckoning);
  EXPECT_TRUE(rig->out.seen.has(Monitor::kSolution));
  const double sigma_before = rig->out.ego.position_sigma_m;
  rig->run(1.5);
  EXPECT_LT(rig->position_error_m(), 0.5);  // after 2 s
  rig->run(3.0);
  EXPECT_LT(rig->position_error_m(), 1.5);  // after 5 s
  EXPECT_GT(rig->out.ego.position_sigma_m, sigma_before);
  rig->run(11.0);
  EXPECT_EQ(rig->out.ego.validity, Validity::kLost);
  EXPECT_TRUE(std::isfinite(rig->out.ego.x_m));  // still an answer
  rig->sensors.no_fix = false;
  rig->run(30.0);
  EXPECT_EQ(rig->out.ego.validity, Validity::kGood);
  EXPECT_LT(rig->position_error_m(), 0.1);
}

TEST(Localization, AWrongBeliefIsGivenUp) {
  auto rig = rig_on(Course{});
  rig->run(5.0);
  rig->course.x0_m += 30.0;  // the world moves, both receivers agree
  rig->run(20.0);            // it slides there, it does not leap
  EXPECT_EQ(rig->out.ego.validity, Validity::kGood);
  EXPECT_LT(rig->position_error_m(), 0.1);
}

// Two worlds in which the units have changed their names: the same car.
TEST(Localization, ExchangingTheUnitsExchangesTheResult) {
  auto one = rig_on(banked_turn()), other = rig_on(banked_turn());
  for (Rig* rig : {one.get(), other.get()}) {
    rig->sensors.gyro_bias_rad_per_s = {0.001, -0.002};
    rig->sensors.no_heading[1] = true;
  }
  std::swap(other->params.units[0], other->params.units[1]);
  other->params.priorities.imu = Preference::kUnit1;
  other->name = {1, 0};
  for (int i = 0; i < 1500; ++i) {
    if (i == 700) one->sensors.east_m[0] = other->sensors.east_m[0] = 0.4;
    if (i == 1000) one->sensors.imu_silent[0] = other->sensors.imu_silent[0] = true;
    one->tick();
    other->tick();
    ASSERT_EQ(one->out.seen, other->out.seen) << i;
    ASSERT_EQ(one->out.ego.validity, other->out.ego.validity) << i;
    if (one->out.ego.validity == Validity::kNever) continue;
    ASSERT_NEAR(one->out.ego.x_m, other->out.ego.x_m, 1e-3) << i;
    ASSERT_NEAR(one->out.ego.yaw_rad, other->out.ego.yaw_rad, 1e-5) << i;
  }
  for (std::size_t unit = 0; unit < 2; ++unit)
    for (std::size_t gate = 0; gate < kGates; ++gate)
      EXPECT_EQ(one->state.tally[0][unit].by_gate[gate],
                other->state.tally[0][1 - unit].by_gate[gate]);
}

// Whatever an excluded sensor says, the car is where it would be without it, to the last bit.
TEST(Localization, AnExcludedSensorChangesNothing) {
  for (const Excludable what :
       {Excludable::kGnss0, Excludable::kGnss1, Excludable::kImu0, Excludable::kImu1}) {
    auto with = rig_on(banked_turn()), without = rig_on(banked_turn());
    const auto excluded = static_cast<std::uint8_t>(1U << static_cast<unsigned>(what));
    with->use = without->use = {excluded};
    const bool imu = what >= Excludable::kImu0;
    const auto unit = static_cast<std::uint8_t>(static_cast<unsigned>(what) % 2);
    for (int i = 0; i < 500; ++i) {
      without->ms += 10, with->ms += 10;
      without->turn_wheels(), with->turn_wheels();
      const world::SensorInput all = with->arrivals();
      world::SensorInput spoilt = all, rest = without->arrivals();
      const auto keep = [&](auto& list, bool affected, auto spoil) {
        auto copy = list;
        list.clear();
        for (auto sample : copy) {
          if (affected && sample.unit == unit && !spoil(sample)) continue;
          CHECK(list.push(sample));
        }
      };
      const auto gone = [](auto&) { return false; };
      keep(rest.imu, imu, gone);
      keep(rest.positions, !imu, gone);
      keep(rest.velocities, !imu, gone);
      keep(rest.headings, !imu, gone);
      keep(spoilt.positions, !imu, [&](auto& s) { return s.latitude_deg += 0.001 * i, true; });
      keep(spoilt.imu, imu, [&](auto& s) { return s.rate_rad_per_s[2] = kUnset, true; });
      with->take(spoilt);
      without->take(rest);
      ASSERT_EQ(with->out.seen, without->out.seen) << i;
      if (with->out.ego.validity == Validity::kNever) continue;
      ASSERT_EQ(with->out.ego.x_m, without->out.ego.x_m) << i;
      ASSERT_EQ(with->out.ego.yaw_rad, without->out.ego.yaw_rad) << i;
      ASSERT_EQ(with->out.ego.position_sigma_m, without->out.ego.position_sigma_m) << i;
    }
    EXPECT_EQ(with->out.ego.validity, Validity::kGood);
    const Source source = imu ? Source::kImu : Source::kPosition;
    EXPECT_GT(with->count(source, unit, Gate::kExcluded), 50u);
    EXPECT_EQ(with->state.streams[static_cast<std::size_t>(source)][unit].verdict, Gate::kExcluded);
  }
}

TEST(Localization, AReadmittedUnitIsOnProbationFirst) {
  auto rig = rig_on(banked_turn());
  rig->run(5.0);
  rig->use.excluded = 1;
  rig->run(5.0);
  rig->use.excluded = 0;
  rig->run(0.2);
  EXPECT_EQ(rig->state.streams[0][0].verdict, Gate::kProbation);
  rig->run(1.2);
  EXPECT_EQ(rig->state.streams[0][0].verdict, Gate::kAccepted);
}

TEST(Localization, TakesNothingFromTheHeap) {
  if (!pitwall::testing::kAllocationsCounted) GTEST_SKIP() << "the sanitizer has its own heap";
  auto rig = rig_on(banked_turn());
  EXPECT_EQ(pitwall::testing::allocations_of([&] { rig->run(3.0); }), 0u);
  EXPECT_EQ(rig->out.ego.validity, Validity::kGood);
}

TEST(Localization, IsAFunctionOfItsArguments) {
  auto rig = rig_on(banked_turn());
  rig->run(3.0);
  auto copy = std::make_unique<Rig>(*rig);
  rig->run(1.0);
  copy->run(1.0);
  EXPECT_EQ(rig->out.ego.x_m, copy->out.ego.x_m);
  EXPECT_EQ(rig->out.ego.position_sigma_m, copy->out.ego.position_sigma_m);
}

}  // namespace
}  // namespace pitwall::localization
