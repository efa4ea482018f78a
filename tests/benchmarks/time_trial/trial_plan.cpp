// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/time_trial/trial_plan.hpp"

#include <utility>

namespace pitwall::time_trial {
namespace {

constexpr Duration kLongest = seconds(600);
constexpr double kWarm_c = 85.0;

// What a team changes for a trial. The frame gate's steering table ends at 80 m/s.
constexpr double kSpeedMax_mps = 80.0, kGreen_mph = 180.0;
constexpr planning::Pace kRacing{
    .accel_max_mps2 = 6.0, .decel_max_mps2 = 8.0, .jerk_max_mps3 = 12.0};

}  // namespace

std::vector<Change> changes() {
  return {{.name = "tyres free", .tyre_c = std::nullopt, .planned_friction = std::nullopt},
          {.name = "tyres at 85 C", .tyre_c = kWarm_c, .planned_friction = std::nullopt},
          {.name = "friction in the car", .tyre_c = kWarm_c, .planned_friction = kLittleFriction},
          {.name = "friction in the plant",
           .tyre_c = kWarm_c,
           .planned_friction = std::nullopt,
           .friction = kLittleFriction}};
}

Result<bench::Loaded, Problem> trial_of(const bench::Loaded& flying_laps, const Change& change,
                                        std::uint64_t seed) {
  bench::Loaded out = flying_laps;
  scenario::Scenario& s = out.scenario;
  s.seed = seed;
  s.duration = kLongest;
  s.expect.clear();
  s.perturb.friction = change.friction;
  if (change.tyre_c) {
    s.tyres.temperature_c = *change.tyre_c;
    scenario::Fault held;
    held.kind = "cold_tyres";
    held.lasts = kLongest;
    held.value = *change.tyre_c;
    s.faults = {held};
  }
  s.race_control.pop_back();  // the red flag at the end
  s.race_control.back().round_target_speed_mph = kGreen_mph;
  planning::Params& p = out.setup.params.planning;
  p.line.speed_max_mps = kSpeedMax_mps;
  p.racing = kRacing;
  if (change.planned_friction) p.line.friction.friction = *change.planned_friction;
  auto line = planning::prepare(p, out.setup.track);
  if (!line) return Unexpected{line.error()};
  out.setup.line = *std::move(line);
  return out;
}

}  // namespace pitwall::time_trial
