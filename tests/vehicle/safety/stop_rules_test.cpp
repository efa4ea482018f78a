// SPDX-License-Identifier: Apache-2.0
// The paper's five rules of its system executive, from samples to causes: each holds within its
// deadline when both units (or, of the connection, one) give reason, none when only one unit does,
// and none at all while nothing is wrong.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>
#include <optional>

#include "tests/vehicle/safety/situation.hpp"
#include "vehicle/safety/fault_detection.hpp"

namespace pitwall::safety {
namespace {

using testing::Situation;

struct Unit {
  bool sends = true, positions = true, imu = true;
  int every = 1;  // of its positions only every n-th comes
  std::uint32_t status = world::kSolutionComputed, type = world::kPositionNarrowInt;
  std::uint8_t satellites = 20;
  double sigma_m = 0.01;
};

// Two receivers at 20 Hz with an IMU at 100 Hz each, and whatever watches them.
struct Executive {
  WatchdogParams dog_params;
  WatchdogState watchdog;
  FaultParams params;
  FaultState state;
  Situation car;
  Random random{12};
  std::array<Unit, world::kGnssUnits> units{};
  std::array<std::optional<Instant>, world::kGnssUnits> byte_at{};
  Instant now = Instant{} + seconds(10);
  std::int64_t ticks = 0;

  void speak(std::uint8_t unit, world::SensorInput& out) {
    const Unit& u = units[unit];
    if (!u.sends) return;
    const Instant received = now - microseconds(static_cast<std::int64_t>(random.below(9'000)));
    byte_at[unit] = received;
    if (u.imu) {
      EXPECT_TRUE(out.imu.push({.unit = unit, .at = received - milliseconds(2)}));
    }
    const bool due = ticks % 5 == unit && (ticks / 5) % u.every == 0;
    if (!due || !u.positions) return;
    EXPECT_TRUE(out.positions.push({.unit = unit,
                                    .at = received - milliseconds(30),
                                    .solution_status = u.status,
                                    .position_type = u.type,
                                    .latitude_sigma_m = u.sigma_m,
                                    .longitude_sigma_m = u.sigma_m,
                                    .satellites = u.satellites}));
  }
  CauseSet tick() {
    now += milliseconds(10);
    ++ticks;
    world::SensorInput sensors;
    for (std::uint8_t unit = 0; unit < world::kGnssUnits; ++unit) speak(unit, sensors);
    car.at(now, 60.0);
    car.watchdog = watch(dog_params, watchdog,
                         {.sensors = sensors,
                          .signals = car.signals,
                          .race_control = car.race_control,
                          .gnss_byte_at = byte_at,
                          .planner_at = {},
                          .radio_at = {}},
                         now);
    return detect(params, state,
                  {.signals = car.signals,
                   .bus = car.bus,
                   .race_control = car.race_control,
                   .ego = car.ego,
                   .watchdog = car.watchdog,
                   .operator_requests = {},
                   .sensors = &sensors},
                  now)
        .causes;
  }
  // How long until the cause holds.
  std::optional<Duration> until(Cause cause, Duration limit) {
    for (const Instant began = now; now - began < limit;)
      if (tick().has(cause)) return now - began;
    return std::nullopt;
  }
  bool any_rule(Duration span) {
    bool any = false;
    for (const Instant end = now + span; now < end;) {
      const CauseSet causes = tick();
      for (const CauseRow& row : kCauseTable)
        any = any || (row.listed_in_paper && causes.has(row.cause));
    }
    return any;
  }
};

struct Rule {
  Cause cause;
  std::function<void(Unit&)> spoil;
};
const std::array<Rule, 6> kOfBothUnits{{
    {Cause::kGnssRateLost, [](Unit& u) { u.positions = false; }},
    {Cause::kGnssRateLost, [](Unit& u) { u.every = 4; }},  // 5 Hz
    {Cause::kGnssSolutionLost, [](Unit& u) { u.status = 1; }},
    {Cause::kGnssSolutionLost, [](Unit& u) { u.satellites = 3; }},
    {Cause::kGnssRtkLost, [](Unit& u) { u.type = world::kPositionSingle, u.sigma_m = 0.51; }},
    {Cause::kGnssRtkLost, [](Unit& u) { u.sigma_m = std::numeric_limits<double>::infinity(); }},
}};

TEST(StopRules, ADayWithoutFaultsHasNone) {
  Executive e;
  EXPECT_FALSE(e.any_rule(seconds(600)));
  EXPECT_TRUE(e.tick()
                  .at_least(Reaction::kCoast)
                  .without([] {
                    CauseSet unreceived;  // what this bench does not play
                    for (const Cause cause :
                         {Cause::kBusMessageLost, Cause::kPlanLost, Cause::kRaceControlLost,
                          Cause::kRadioLost, Cause::kDisarmRequest, Cause::kBusDead})
                      unreceived.add(cause);
                    return unreceived;
                  }())
                  .empty());
}

TEST(StopRules, BothUnitsWithinTheDeadlineAndOneAloneNever) {
  for (const Rule& rule : kOfBothUnits) {
    for (const bool both : {true, false}) {
      Executive e;
      ASSERT_FALSE(e.any_rule(seconds(3)));
      rule.spoil(e.units[0]);
      if (both) rule.spoil(e.units[1]);
      const auto took = e.until(rule.cause, seconds(10));
      ASSERT_EQ(took.has_value(), both) << text_of(rule.cause);
      if (both) {
        EXPECT_LE(*took, row_of(rule.cause).deadline) << text_of(rule.cause);
      } else {
        EXPECT_TRUE(e.tick().has(Cause::kGnssDegraded)) << "but the operator is told";
        EXPECT_FALSE(e.any_rule(seconds(1)));
      }
    }
  }
}

// One unit bad in one way and the other in another: nobody is left.
TEST(StopRules, NoTwoReasonsAddUpToAGoodUnit) {
  for (const Rule& first : kOfBothUnits)
    for (const Rule& second : kOfBothUnits) {
      Executive e;
      ASSERT_FALSE(e.any_rule(seconds(3)));
      first.spoil(e.units[0]);
      second.spoil(e.units[1]);
      EXPECT_TRUE(e.any_rule(milliseconds(1'300)))
          << text_of(first.cause) << " and " << text_of(second.cause);
    }
}

TEST(StopRules, OneConnectionThatIsLostTotallyStopsWhateverTheOtherSays) {
  for (const std::size_t unit : {0U, 1U}) {
    Executive e;
    ASSERT_FALSE(e.any_rule(seconds(3)));
    e.units[unit].sends = false;
    const auto took = e.until(Cause::kGnssUnitDisconnected, seconds(2));
    ASSERT_TRUE(took);
    EXPECT_LE(*took, row_of(Cause::kGnssUnitDisconnected).deadline);
    EXPECT_GT(*took, milliseconds(450)) << "its timeout is respected";
  }
}

TEST(StopRules, BytesThatAreLateBadOrWithoutFixOnOneUnitDriveOn) {
  for (const std::size_t unit : {0U, 1U}) {
    Executive e;
    ASSERT_FALSE(e.any_rule(seconds(3)));
    Unit& u = e.units[unit];
    u = {.imu = false, .every = 9, .status = 1, .type = 0, .satellites = 0, .sigma_m = 99.0};
    EXPECT_FALSE(e.any_rule(seconds(20)));
    u.sends = false;
    EXPECT_TRUE(e.any_rule(seconds(1))) << "not a byte more: the connection is lost";
  }
}

TEST(StopRules, RtkMayBeLostAsLongAsTheAccuracyIsThere) {
  Executive e;
  for (Unit& u : e.units) u.type = world::kPositionNarrowFloat, u.sigma_m = 0.15;
  EXPECT_FALSE(e.any_rule(seconds(30)));
  for (Unit& u : e.units) u.sigma_m = 0.499;
  EXPECT_FALSE(e.any_rule(seconds(5)));
  for (Unit& u : e.units) u.sigma_m = 0.501;
  EXPECT_TRUE(e.any_rule(milliseconds(220)));
}

TEST(StopRules, OneBadSampleOfBothIsNoLoss) {
  Executive e;
  ASSERT_FALSE(e.any_rule(seconds(3)));
  for (Unit& u : e.units) u.sigma_m = 5.0;
  EXPECT_FALSE(e.any_rule(milliseconds(100)));
  for (Unit& u : e.units) u.sigma_m = 0.01;
  EXPECT_FALSE(e.any_rule(seconds(1)));
}

TEST(StopRules, TheFusedPositionItself) {
  Executive e;
  e.car.ego.position_sigma_m = e.params.position_sigma_max_m;
  EXPECT_FALSE(e.any_rule(seconds(1)));
  e.car.ego.position_sigma_m = e.params.position_sigma_max_m + 0.001;
  EXPECT_LE(*e.until(Cause::kLocalizationUncertain, seconds(1)),
            row_of(Cause::kLocalizationUncertain).deadline);
}

TEST(StopRules, AUnitThatTheOperatorExcludedCountsForNothing) {
  Executive e;
  ASSERT_FALSE(e.any_rule(seconds(3)));
  e.dog_params[Stream::kGnss1Link].watched = e.dog_params[Stream::kGnss1Position].watched =
      e.dog_params[Stream::kGnss1Solution].watched = false;
  e.units[1].sends = false;
  EXPECT_FALSE(e.any_rule(seconds(5)));
  e.units[0].positions = false;
  EXPECT_TRUE(e.until(Cause::kGnssRateLost, seconds(1)));
}

}  // namespace
}  // namespace pitwall::safety
