// Our car with its full stack, estimator and tracker in the loop, attacks a ghost that defends the
// inside lane: it passes in every bracket, as the judge has it, without a contact.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "hil/bench/loading.hpp"
#include "hil/bench/lockstep/lockstep.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::bench {
namespace {

const std::string kTree = PITWALL_SOURCE_DIR;

template <class T>
T had(Result<T, Problem> result) {
  if (!result) throw std::runtime_error(to_string(result.error()));
  return *std::move(result);
}

std::string with(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) throw std::runtime_error("no " + what);
  return text.replace(at, what.size(), by);
}

// The car that ships, with a racing pace and a line to pass on.
std::string racing_car() {
  std::string text = had(transport::read_file(kTree + "/vehicle/config/cars/av21.yaml"));
  text = with(text, "speed_max_mps: 68.0", "speed_max_mps: 80.0");
  return with(text, "  merge_least_m: 60.0\n", R"(  merge_least_m: 60.0
  racing: {accel_max_mps2: 6.0, decel_max_mps2: 8.0, jerk_max_mps3: 12.0}
  passing:
    lines: [{offset_m: -5.0}]
    watch_ahead_m: 150.0
    watch_behind_m: 80.0
    forget_s: 3.0
    trail_gap_m: 25.0
    complete_gap_m: 37.0
    side_gap_m: 6.0
    side_clear_m: 3.5
    trail_gain_per_s: 0.25
    close_extra_mps: 4.0
    pass_extra_mps: 8.0
    brake_mps2: 4.0
    merge_time_s: 3.5
    dwell_s: 0.5
)");
}

std::string match(const std::string& car, int mph) {
  return R"(schema: 1
name: attempt
seed: 11
duration_s: 250
track: vehicle/config/tracks/tms.yaml
car: )" + car +
         R"(
start: {s_m: 2200, n_m: 0, speed_mps: 0}
tyres: {temperature_c: 85}
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
  brackets_mph: [)" +
         std::to_string(mph) + R"(]
  lanes: {inside_m: 0, outside_m: -5}
  attempts: [decline]
  defends: [hold]
  expect: [passed, declined]
  result: own
expect:
  - {kind: always, signal: wall_gap_m, is: ">", value: 0.5}
  - {kind: never, signal: mode, is: ">=", value: 3}
)";
}

class Bracket : public ::testing::TestWithParam<int> {};

TEST_P(Bracket, OurCarPassesADefenderWhoHoldsTheInsideLane) {
  const auto folder = had(transport::TemporaryFolder::create("pitwall-passing-"));
  const std::string car = folder.path() + "/car.yaml", scenario = folder.path() + "/attempt.yaml";
  had(transport::write_file(car, racing_car()));
  had(transport::write_file(scenario, match(car, GetParam())));
  const RunResult run = had(run_lockstep(had(load(scenario, kTree)), {}));
  ASSERT_TRUE(run.match);
  ASSERT_FALSE(run.match->attempts.empty());
  std::printf("%s\n", to_text(*run.match, 0).c_str());
  EXPECT_LE(run.match->attempts[0].laps_used, 2.0);
  EXPECT_FALSE(run.car_contact);
  EXPECT_EQ(run.gate_refusals, 0u);
  for (const grading::Verdict& verdict : run.verdicts)
    EXPECT_TRUE(verdict.pass) << verdict.name << ": " << verdict.text << ": " << verdict.reason;
}

INSTANTIATE_TEST_SUITE_P(All, Bracket, ::testing::Values(80, 100, 115, 125, 135, 150));

}  // namespace
}  // namespace pitwall::bench
