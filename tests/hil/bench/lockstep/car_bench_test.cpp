// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/lockstep/car_bench.hpp"

#include <gtest/gtest.h>

#include <array>
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

Stack stack_of(const scenario::Scenario& scenario) {
  return {scenario, lap().setup, {.log = nowhere()}};
}

std::vector<RunResult> had(Result<std::vector<RunResult>, Problem> results) {
  if (results) return *std::move(results);
  ADD_FAILURE() << to_string(results.error());
  return {};
}

// The cars of a run have nothing in common but the clock: each drives as if it were alone, at any
// number of cars and in any order.
TEST(CarBench, EachCarOfARunHasTheBytesThatItHasAlone) {
  const std::array parts{part_of_lap(2'250.0, 7), part_of_lap(2'200.0, 8), part_of_lap(1'000.0, 9)};
  std::vector<std::string> alone;
  for (const scenario::Scenario& part : parts)
    alone.push_back(had(run_lockstep(std::array{stack_of(part)})).at(0).digest);
  EXPECT_NE(alone[0], alone[1]);
  const auto three =
      had(run_lockstep(std::array{stack_of(parts[0]), stack_of(parts[1]), stack_of(parts[2])}));
  ASSERT_EQ(three.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(three[i].digest, alone[i]) << i;
  const auto turned = had(run_lockstep(std::array{stack_of(parts[2]), stack_of(parts[0])}));
  ASSERT_EQ(turned.size(), 2u);
  EXPECT_EQ(turned[0].digest, alone[2]);
  EXPECT_EQ(turned[1].digest, alone[0]);
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
