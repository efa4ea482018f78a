// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/lockstep/car_bench.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "tests/hil/bench/flying_lap.hpp"

namespace pitwall::bench {
namespace {

scenario::Scenario part_of_lap(double start_s_m, std::uint64_t seed) {
  scenario::Scenario part = lap().scenario;
  part.duration = seconds(20);
  part.expect.clear();
  part.start.s_m = start_s_m;
  part.seed = seed;
  return part;
}

Stack stack_of(const scenario::Scenario& scenario, const std::string& name = "own") {
  return {scenario, lap().setup, {.log = nowhere()}, name};
}

std::vector<RunResult> had(Result<std::vector<RunResult>, Problem> results) {
  if (results) return *std::move(results);
  ADD_FAILURE() << to_string(results.error());
  return {};
}

// Only race control's report of the others tells that a car is not alone, and the order of the cars
// is nothing at all.
TEST(CarBench, TheOrderOfTheCarsChangesNoByte) {
  const std::array parts{part_of_lap(2'250.0, 7), part_of_lap(2'200.0, 8), part_of_lap(1'000.0, 9)};
  const Stack a = stack_of(parts[0], "a"), b = stack_of(parts[1], "b"), c = stack_of(parts[2], "c");
  const auto first = had(run_lockstep(std::array{a, b, c}));
  const auto turned = had(run_lockstep(std::array{c, a, b}));
  ASSERT_EQ(first.size(), 3u);
  ASSERT_EQ(turned.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(turned[(i + 1) % 3].digest, first[i].digest) << i;
  EXPECT_NE(first[0].digest, first[1].digest);
  EXPECT_NE(first[0].digest, had(run_lockstep(std::array{a})).at(0).digest)
      << "race control names the others";
}

TEST(CarBench, ACarIsToldOfItsNearestRival) {
  const scenario::Scenario own = part_of_lap(2'250.0, 7), near = part_of_lap(2'200.0, 8),
                           far = part_of_lap(1'000.0, 9);
  world::RivalReport seen;
  std::array stacks{stack_of(own), stack_of(near), stack_of(far)};
  stacks[0].options.watch = [&](const pipeline::Outputs& out, const Rig&, Instant) {
    seen = out.received.signals.rival.value;
  };
  ASSERT_EQ(had(run_lockstep(stacks)).size(), 3u);
  EXPECT_EQ(seen.number, lap().setup.params.outbound.vehicle_number);
  EXPECT_NEAR(seen.lap_distance_m, 2'200.0, 150.0);
}

// Both stand: the second one 25 m ahead, a lane to the left.
class ByRays : public ::testing::TestWithParam<scenario::LidarKind> {};

TEST_P(ByRays, ACarIsFound) {
  scenario::Scenario own = part_of_lap(2'250.0, 7), other = part_of_lap(2'275.0, 8);
  own.duration = other.duration = seconds(3);
  other.start.n_m = 4.0;
  own.lidars = GetParam();
  world::Opponents seen;
  std::array stacks{stack_of(own), stack_of(other, "other")};
  stacks[0].options.watch = [&](const pipeline::Outputs& out, const Rig&, Instant) {
    seen = out.opponents;
  };
  const auto results = had(run_lockstep(stacks));
  ASSERT_EQ(results.size(), 2u);
  EXPECT_GE(results[0].sweeps_on_map + results[0].sweeps_by_cloth, 60u);
  EXPECT_GE(results[0].sweeps_on_map, 20u) << "as soon as it knows its place";
  EXPECT_EQ(results[1].sweeps_on_map, 0u) << "the other one's are modelled";
  EXPECT_EQ(results[0].detections_lost, 0u);
  const bool is_there = std::ranges::any_of(seen.cars, [](const world::Opponent& car) {
    return std::abs(car.s_m - 2'275.0) < 1.5 && std::abs(car.n_m - 4.0) < 1.0;
  });
  EXPECT_TRUE(is_there);
}

INSTANTIATE_TEST_SUITE_P(CarBench, ByRays,
                         ::testing::Values(scenario::LidarKind::kRays,
                                           scenario::LidarKind::kRaysClusters),
                         [](const auto& kind) { return name_of(kind.param); });

// Cars that ours knows of when the other one stands ahead and these sensors are out.
std::size_t seen_without(scenario::LidarKind lidars, const std::vector<std::string>& kinds) {
  scenario::Scenario own = part_of_lap(2'250.0, 7), other = part_of_lap(2'275.0, 8);
  own.duration = other.duration = seconds(2);
  other.start.n_m = 4.0;
  own.lidars = lidars;
  for (const std::string& kind : kinds)
    for (std::uint32_t unit = 0; unit < (kind == "camera_outage" ? 5U : 3U); ++unit)
      own.faults.push_back({.kind = kind, .lasts = seconds(10), .unit = unit, .place = kind});
  std::size_t most = 0;
  std::array stacks{stack_of(own), stack_of(other, "other")};
  stacks[0].options.watch = [&](const pipeline::Outputs& out, const Rig&, Instant) {
    most = std::max(most, out.opponents.cars.size());
  };
  EXPECT_EQ(had(run_lockstep(stacks)).size(), 2u);
  return most;
}

TEST(CarBench, ASensorThatIsOutSeesNoOtherCar) {
  for (const auto lidars : {scenario::LidarKind::kModel, scenario::LidarKind::kRaysClusters}) {
    EXPECT_EQ(seen_without(lidars, {"lidar_outage", "camera_outage", "radar_outage"}), 0u)
        << name_of(lidars);
    EXPECT_GE(seen_without(lidars, {"camera_outage", "radar_outage"}), 1u) << name_of(lidars);
    EXPECT_GE(seen_without(lidars, {"lidar_outage", "radar_outage"}), 1u) << name_of(lidars);
  }
}

// A car that starts in another one touches it at once, and nobody moved.
TEST(CarBench, AContactEndsTheRunAndIsAttributed) {
  const scenario::Scenario own = part_of_lap(2'250.0, 7), other = part_of_lap(2'252.0, 8);
  std::array stacks{stack_of(own), stack_of(other)};
  stacks[1].name = "other";
  const auto results = had(run_lockstep(stacks));
  ASSERT_EQ(results.size(), 2u);
  for (const RunResult& result : results) {
    EXPECT_EQ(result.simulated_s, 0.0);
    ASSERT_TRUE(result.car_contact);
    EXPECT_EQ(result.other_cars, 1u);
  }
  EXPECT_EQ(results[0].car_contact->with, "other");
  EXPECT_EQ(results[1].car_contact->with, "own");
}

TEST(CarBench, ARunThatEndsForOneCarEndsForAll) {
  const scenario::Scenario first = part_of_lap(2'250.0, 7), second = part_of_lap(1'000.0, 8);
  const auto at = [](const RunView& run) { return run.now == Instant{} + seconds(12); };
  for (const std::size_t who : {0U, 1U}) {
    std::array stacks{stack_of(first), stack_of(second)};
    stacks[who].options.over = at;
    const auto results = had(run_lockstep(stacks));
    ASSERT_EQ(results.size(), 2u);
    for (const RunResult& result : results) EXPECT_EQ(result.simulated_s, 12.0) << who;
  }
}

// What the car's own computer is given, tick by tick, while a fault stops or kills it for 3 s from
// 10 s on. Another car is beside it all the time: nine sensors send 20 frames a second each.
struct Given {
  std::size_t most = 0;              // frames in one tick
  std::optional<Duration> age_most;  // on the first tick after the fault
  std::uint64_t lost = 0;
};

Given given_with(const std::string& fault) {
  scenario::Scenario own = part_of_lap(2'250.0, 7), near = part_of_lap(2'270.0, 8);
  own.duration = near.duration = seconds(14);
  if (!fault.empty()) {
    own.faults.emplace_back().kind = fault;
    own.faults.back().at = seconds(10), own.faults.back().lasts = seconds(3);
  }
  Given given;
  std::array stacks{stack_of(own), stack_of(near, "near")};
  stacks[0].options.step = [&](const pipeline::Setup& setup, pipeline::Car& car,
                               const pipeline::Inputs& in) {
    given.most = std::max(given.most, in.detections.size());
    if (in.now > Instant{} + seconds(12) && !given.age_most) {
      given.age_most = Duration{};
      for (const world::DetectionFrame& frame : in.detections)
        given.age_most = std::max(*given.age_most, in.now - frame.received);
    }
    return pipeline::step(setup, car, in);
  };
  const auto results = had(run_lockstep(stacks));
  if (!results.empty()) given.lost = results[0].detections_lost;
  return given;
}

TEST(CarBench, NoFrameOfDetectionsIsLostInATickAndWhatIsLostInAPauseIsCounted) {
  const Given whole = given_with("");
  EXPECT_LE(whole.most, 9U);
  EXPECT_EQ(whole.lost, 0U);
  // 540 epochs in 3 s, of which the car keeps 64. A frame is lost on its way with 2 % at most, 11
  // of 540 with a sigma of 3.3; an outage of a sensor costs some 4.
  const Given paused = given_with("computer_paused");
  EXPECT_EQ(paused.most, 64U);
  EXPECT_LE(paused.lost, 540U - 64U + 9U);
  EXPECT_GE(paused.lost, 540U - 64U - 11U - 17U - 12U);
}

TEST(CarBench, ARestartedProcessFindsNoFrameFromBefore) {
  const Given killed = given_with("computer_killed");
  ASSERT_TRUE(killed.age_most);
  EXPECT_LE(*killed.age_most, lap().setup.params.rates.tick);
  EXPECT_GT(killed.lost, 400U);
}

TEST(CarBench, CarsThatCannotShareARunAreRefusedByName) {
  struct Case {
    std::function<void(scenario::Scenario&)> change;
    const char* why;
  };
  for (const Case& c :
       {Case{[](auto& s) { s.duration = seconds(19); }, "another duration"},
        Case{[](auto& s) { s.race_control.pop_back(); }, "other flags of race control"},
        Case{[](auto& s) { s.race_control.back().round_target_speed_mph += 1.0; },
             "other flags of race control"}}) {
    const scenario::Scenario first = part_of_lap(2'250.0, 7);
    scenario::Scenario second = part_of_lap(1'000.0, 8);
    second.name = "second";
    c.change(second);
    const auto results = run_lockstep(std::array{stack_of(first), stack_of(second)});
    ASSERT_FALSE(results) << c.why;
    EXPECT_EQ(results.error().place, "second");
    EXPECT_NE(results.error().what.find(c.why), std::string::npos) << results.error().what;
  }
}

}  // namespace
}  // namespace pitwall::bench
