// Runs of the time trial at Las Vegas, and the changes that they make to car and world.
//   in     the scenario of flying laps, with the car as prepared for it
//   out    a scenario and a car for each run
//   errors Problem of a car that cannot be prepared
//   source the mean: 168.2 mph, the fastest published lap of a driverless AV-21 there
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hil/bench/loading.hpp"

namespace pitwall::time_trial {

inline constexpr const char* kScenario = "hil/scenarios/lvms_flying_lap.yaml";

struct Change {
  std::string name;
  std::optional<double> tyre_c;            // held; else they warm and cool as they are driven
  std::optional<double> planned_friction;  // what the car believes of its tyres
  double friction = 1.0;                   // factor on that of the modelled tyres
};

inline constexpr double kLittleFriction = 0.8;

// Tyres free; held at 85 degrees; little friction in the car's file; as little in the plant alone.
std::vector<Change> changes();

Result<bench::Loaded, Problem> trial_of(const bench::Loaded& flying_laps, const Change& change,
                                        std::uint64_t seed);

}  // namespace pitwall::time_trial
