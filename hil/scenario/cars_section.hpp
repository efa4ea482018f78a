// Section `cars` of a scenario file: the other cars, at most eight.
//   name, number   of the car; number 2 to 99, each once; our car is number 1. Files of a car with
//              a stack are named after it: letters, digits, _ and -
//   kind       ghost, a car without a stack, with all keys below; or stack, a car with a computer,
//              bus and radio of its own, with car (file), plant (file, optional), start (s_m, n_m)
//              and seed. It hears the same flags, and nothing of the faults and operators
//   start      s_m, speed_mps, and n_m where the car begins beside its line and joins it
//   line, offset_m   a line of the bank that the car file names, or else the reference line, and a
//              distance beside it
//   speed      one of mps, lap_share (of the line's own lap), by_station (s_m and mps, rising)
//   limits     accel_mps2, brake_mps2, lateral_mps2
//   drift      of the offset: sigma_m, correlation_s, most_m
//   speed_drift  sigma_mps, correlation_s, most_mps
//   size       length_m, width_m
//   seed       of both drifts; without it derived from the seed of the scenario and the number
//   script     entries that fire in their order, each with one of at_s, at_station_m, gap_above_m,
//              gap_below_m, and do: speed (speed), line (line, offset_m, over_s), brake
//              (decel_mps2, to_mps), stand, spin (decel_mps2, turn_deg)
//   errors     thrown as yaml::InputError with the place, for read_scenario(); what needs track and
//              bank, build_ghost() refuses
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hil/traffic/ghost_plan.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall::scenario {

inline constexpr std::size_t kMaxCars = 8;

struct StackPlan {
  std::string car_file, plant_file;  // as written; no plant file: the AV-21
  double start_s_m = 0.0, start_n_m = 0.0;
  std::uint64_t seed = 0;
  std::string place{};  // for messages
};

struct OtherCar {
  std::string name;
  int number = 0;
  traffic::GhostPlan ghost;        // of a car without a stack
  std::optional<StackPlan> stack;  // of a car with one
};

std::vector<OtherCar> read_cars(yaml::StrictMap& map, std::uint64_t scenario_seed);

}  // namespace pitwall::scenario
