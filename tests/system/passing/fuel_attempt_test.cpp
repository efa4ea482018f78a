// Attempts on little fuel, the full stack in the loop: the operator enters what is in the tank
// before the start, the engine burns up to 13 % more or less than is reckoned.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "hil/bench/loading.hpp"
#include "hil/bench/lockstep/lockstep.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::bench {
namespace {

constexpr const char* kTree = PITWALL_SOURCE_DIR;

std::string attempt_with(double litres, const char* endings, const char* result) {
  return formatted(R"(schema: 1
name: attempt_on_%.1f_l
seed: 11
duration_s: 250
track: vehicle/config/tracks/tms.yaml
car: tests/system/passing/fuelled.yaml
start: {s_m: 2200, n_m: 0, speed_mps: 0, fuel_l: %.2f}
tyres: {temperature_c: 85}
perturb: {consumption_spread: 0.13}
operator:
  - {at_s: 1, say: take 1, every_s: 0.5, until_s: 8}
  - {at_s: 2, say: command fuel_entered %.1f}
race_control:
  - {at_s: 0.5, track: red}
  - {at_s: 4, track: orange}
  - {at_s: 9, track: yellow, round_target_speed_mph: 60}
  - {at_s: 14, track: green, round_target_speed_mph: 80}
cars:
  - name: rival
    number: 2
    kind: ghost
    start: {s_m: 2100, speed_mps: 25}
    offset_m: -5
    speed: {mps: 25}
    drift: {sigma_m: 0.2, most_m: 0.6}
match:
  rival: rival
  begins_s: 25
  first: own
  brackets_mph: [100]
  lanes: {inside_m: 0, outside_m: -5}
  attempts: [decline]
  defends: [hold]
  expect: [%s]
  result: %s
expect:
  - {kind: always, signal: wall_gap_m, is: ">", value: 0.5}
  - {kind: never, signal: mode, is: ">=", value: 3}
  - {kind: always, signal: fuel_l, is: ">", value: 0.1}
)",
                   litres, litres, litres, endings, result);
}

TEST(FuelAttempt, TheLastOneIsDeclinedOrFinished) {
  for (const auto& [litres, endings, result] : {std::tuple{12.0, "passed, declined", "own"},
                                                std::tuple{6.5, "declined, declined", "draw"}}) {
    const auto folder = transport::TemporaryFolder::create("pitwall-fuel-");
    ASSERT_TRUE(folder);
    const std::string path = folder->path() + "/attempt.yaml";
    ASSERT_TRUE(transport::write_file(path, attempt_with(litres, endings, result)));
    const auto loaded = load(path, kTree);
    ASSERT_TRUE(loaded) << to_string(loaded.error());
    const auto run = run_lockstep(*loaded, {});
    ASSERT_TRUE(run) << to_string(run.error());
    ASSERT_TRUE(run->match);
    for (std::size_t i = 0; i < run->match->attempts.size(); ++i)
      std::printf("%.1f l: %s\n", litres, to_text(*run->match, i).c_str());
    for (const grading::Verdict& verdict : run->verdicts)
      EXPECT_TRUE(verdict.pass) << verdict.name << ": " << verdict.text << ": " << verdict.reason;
  }
}

}  // namespace
}  // namespace pitwall::bench
