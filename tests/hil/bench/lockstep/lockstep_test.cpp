// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/lockstep/lockstep.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/hil/bench/flying_lap.hpp"
#include "tests/support/allocation_guard.hpp"

namespace pitwall::bench {
namespace {

// One full run serves every test that only looks at its result.
const RunResult& full_run() {
  static const RunResult result = [] {
    auto run = run_lockstep(lap().scenario, lap().setup, {.log = nowhere()});
    if (!run) ADD_FAILURE() << to_string(run.error());
    return *std::move(run);
  }();
  return result;
}

TEST(Lockstep, AFlyingLapOfLasVegasHoldsEveryExpectationAndLosesNothing) {
  for (const grading::Verdict& verdict : full_run().verdicts)
    EXPECT_TRUE(verdict.pass) << verdict.text << ": " << verdict.reason;
  EXPECT_GE(full_run().laps.flying, 1u);
  EXPECT_GT(full_run().laps.best_flying_mean_mps, 60.0);
  const Traffic& traffic = full_run().traffic;
  EXPECT_EQ(traffic.lost, 0u);
  EXPECT_EQ(full_run().gate_refusals, 0u);
  EXPECT_EQ(full_run().bus_refusals, 0u);
  EXPECT_GT(traffic.to_car, 100'000u);
  // What the last tick put on the bus may still be on its way.
  EXPECT_NEAR(static_cast<double>(traffic.bench_received), static_cast<double>(traffic.from_car),
              8.0);
  EXPECT_NEAR(static_cast<double>(traffic.car_received), static_cast<double>(traffic.to_car), 32.0);
}

TEST(Lockstep, TheEventLogNamesModesCausesAndAContact) {
  struct LogTexts {
    const char* scenario;
    std::vector<const char*> texts;
  };
  for (const auto& [name, texts] :
       {LogTexts{"gnss_both_out", {"\"standby\"", "\"controlled stop, IMU: both units lost\""}},
        LogTexts{"computer_and_guardian_killed",
                 {"\"driving\"", "\"the car hit the wall on the "}}}) {
    auto loaded = load(kRoot + "/hil/scenarios/" + name + ".yaml", kRoot);
    ASSERT_TRUE(loaded) << to_string(loaded.error());
    std::string log;
    const auto run = run_lockstep(loaded->scenario, loaded->setup,
                                  {.log = [&log](std::span<const std::uint8_t> bytes) {
                                    log.append(bytes.begin(), bytes.end());
                                    return true;
                                  }});
    ASSERT_TRUE(run) << to_string(run.error());
    for (const char* text : texts)
      EXPECT_NE(log.find(std::string{"\"text\":"} + text), std::string::npos) << name << text;
  }
}

TEST(Lockstep, TheSameScenarioGivesTheSameBytes) {
  scenario::Scenario part = lap().scenario;
  part.duration = seconds(20);
  const auto first = run_lockstep(part, lap().setup, {.log = nowhere()});
  ASSERT_TRUE(first);
  for (int i = 1; i < 10; ++i) {
    const auto again = run_lockstep(part, lap().setup, {.log = nowhere()});
    ASSERT_TRUE(again);
    EXPECT_EQ(again->digest, first->digest) << "run " << i;
  }
  part.seed += 1;
  const auto other = run_lockstep(part, lap().setup, {.log = nowhere()});
  ASSERT_TRUE(other);
  EXPECT_NE(other->digest, first->digest) << "another seed must be another run";
}

TEST(Lockstep, ARunThatIsEndedIsAShorterOne) {
  scenario::Scenario part = lap().scenario;
  part.expect.clear();  // they are told with their windows, which end with the plan
  part.duration = seconds(16);
  const auto ended =
      run_lockstep(part, lap().setup,
                   {.over = [](const RunView& run) { return run.now == Instant{} + seconds(14); }});
  part.duration = seconds(14);
  const auto shorter = run_lockstep(part, lap().setup, {});
  ASSERT_TRUE(ended && shorter);
  EXPECT_EQ(to_json(*ended), to_json(*shorter));
}

TEST(Lockstep, AStepNeverAllocates) {
  if (!testing::kAllocationsCounted) GTEST_SKIP() << "the sanitizer has a heap of its own";
  scenario::Scenario part = lap().scenario;
  part.duration = seconds(40);
  std::size_t allocations = 0, steps = 0;
  LockstepOptions options;
  options.step = [&](const pipeline::Setup& setup, pipeline::Car& car, const pipeline::Inputs& in) {
    pipeline::Outputs out;
    allocations += testing::allocations_of([&] { out = pipeline::step(setup, car, in); });
    ++steps;
    return out;
  };
  ASSERT_TRUE(run_lockstep(part, lap().setup, options));
  EXPECT_GT(steps, 3'900u);
  EXPECT_EQ(allocations, 0u);
}

TEST(Lockstep, ASnapshotOfTheCarGoesOnLikeTheCar) {
  // GIVEN a copy of the car's state taken in the middle of a run
  scenario::Scenario part = lap().scenario;
  part.duration = seconds(16);
  pipeline::Car copy;
  bool copied = false;
  std::size_t compared = 0;
  LockstepOptions options;
  options.step = [&](const pipeline::Setup& setup, pipeline::Car& car, const pipeline::Inputs& in) {
    if (in.now == Instant{} + seconds(14)) {
      copy = car;
      copied = true;
    }
    pipeline::Outputs twin;
    if (copied) twin = pipeline::step(setup, copy, in);
    const pipeline::Outputs out = pipeline::step(setup, car, in);
    // WHEN both get the same inputs THEN they say the same
    if (copied) {
      EXPECT_EQ(twin.passed.frames.size(), out.passed.frames.size());
      for (std::size_t i = 0; i < out.passed.frames.size(); ++i)
        EXPECT_EQ(twin.passed.frames[i], out.passed.frames[i]);
      ++compared;
    }
    return out;
  };
  ASSERT_TRUE(run_lockstep(part, lap().setup, options));
  EXPECT_GT(compared, 150u);
}

TEST(Lockstep, WhatTheBenchDoesNotKnowIsRefusedWithItsPlace) {
  scenario::Scenario wrong = lap().scenario;
  wrong.expect[0].condition.signal = "speed_of_light";
  const auto signal = run_lockstep(wrong, lap().setup, {});
  ASSERT_FALSE(signal);
  EXPECT_NE(to_string(signal.error()).find("speed_of_light"), std::string::npos);

  wrong = lap().scenario;
  wrong.faults.push_back({.kind = "earthquake", .at = {}, .lasts = {}, .place = "x.yaml:3:1"});
  const auto fault = run_lockstep(wrong, lap().setup, {});
  ASSERT_FALSE(fault);
  EXPECT_NE(to_string(fault.error()).find("x.yaml:3:1"), std::string::npos);

  wrong = lap().scenario;
  wrong.start.n_m = 40.0;
  EXPECT_FALSE(run_lockstep(wrong, lap().setup, {}));
}

struct FaultCase {
  const char* kind;
  double value;
  std::uint32_t unit;
};

// Each of these must bring the car to a stop on the track, without a wall and without a spin.
TEST(Lockstep, AFaultOnTrackEndsInASmoothStop) {
  for (const FaultCase& c :
       {FaultCase{"race_heartbeat_stop", kUnset, 0}, FaultCase{"bus_silent", kUnset, 0}}) {
    scenario::Scenario s = lap().scenario;
    s.duration = seconds(75);
    s.expect.clear();
    s.faults = {{.kind = c.kind,
                 .at = seconds(40),
                 .lasts = seconds(100),
                 .unit = c.unit,
                 .value = c.value,
                 .place = "test"}};
    double least_gap_m = 1e9, end_speed_mps = 1e9, slip_rad = 0.0;
    LockstepOptions options;
    options.watch = [&](const pipeline::Outputs&, const Rig& rig, Instant) {
      least_gap_m =
          std::min({least_gap_m, rig.road().wall_gap_left_m, rig.road().wall_gap_right_m});
      end_speed_mps = rig.truth().speed_mps;
      if (rig.truth().vx_mps > 10.0)
        slip_rad = std::max(slip_rad, std::abs(std::atan2(rig.truth().vy_mps, rig.truth().vx_mps)));
    };
    ASSERT_TRUE(run_lockstep(s, lap().setup, options)) << c.kind;
    EXPECT_GT(least_gap_m, 0.3) << c.kind;
    EXPECT_LT(end_speed_mps, 0.5) << c.kind;
    EXPECT_LT(slip_rad, 0.15) << c.kind;
  }
}

}  // namespace
}  // namespace pitwall::bench
