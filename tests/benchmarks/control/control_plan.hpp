// Plan of the control benchmark: one run drives a track at one speed after another, each held for a
// lap and at least a minute, by the round speeds of race control.
//   in     a scenario of flying laps (its start, tyres and first flags), length of the track
//   out    Scenario and its windows, slowest first; the worlds to drive in
//   units  m/s, s of scenario time
//   source the speeds are the middles of the brackets of hil/grading/cross_track.hpp
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hil/grading/cross_track.hpp"
#include "hil/scenario/scenario.hpp"
#include "protocol/vocabulary/result.hpp"
#include "tests/benchmarks/laps/lap_plan.hpp"

namespace pitwall::control_bench {

// Time in which one speed is held: from `from`, when the car has had time to reach it.
struct Window {
  std::size_t bracket = 0;  // of grading::kBrackets
  double speed_mps = kUnset;
  Duration from{}, until{};
};

struct Plan {
  scenario::Scenario scenario;
  std::vector<Window> windows;
};

Plan plan_of(const scenario::Scenario& like, double track_length_m);
// Of other speeds, mph.
Plan plan_of(const scenario::Scenario& like, double track_length_m,
             std::span<const double> speeds_mph);

// Null between the windows.
const Window* window_at(const Plan& plan, Instant now);

// A car and its surroundings: a plant file or a drawn plant (neither: the AV-21 of
// hil/plant/params.hpp), and what is different from what the car believes.
struct World {
  std::string name, plant_file;
  scenario::Perturbations perturb;
  std::optional<plant::Params> plant = std::nullopt;

  bool is_judged() const { return !plant; }  // a drawn car is printed alone
};

// Nominal first, then the other cars, then the perturbations of the lap benchmark.
std::vector<World> worlds();
// The first drawn cars of the family of `./pitwall long cars`, whose seed is 1.
std::vector<World> family_worlds(std::size_t count);

// Reads the plant file of the world; a Problem of it.
Result<scenario::Scenario, Problem> in_world(const scenario::Scenario& scenario,
                                             const World& world);

}  // namespace pitwall::control_bench
