// Table, JSON and gates of the speed benchmark: a row per track, car and controller.
//   gates  of ours, in every car; each is printed with the figure that is worst for it
//          steady     rms of the speed error at a held speed
//          overshoot  of the step from 30 to 40 m/s: 5 % of it
//          pedals     none brakes at a held speed, nor more often than the plan slows down
//          gears      no more shifts than the governed reference crosses, and none missed
//          nothing is refused and every run ends as planned
//   units  m/s
//   source the bounds were given before the law was written
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/benchmarks/control/control_table.hpp"
#include "tests/benchmarks/control/speed_run.hpp"

namespace pitwall::speed_bench {

inline constexpr double kSteadyRms_mps = 0.3, kOvershoot_mps = 0.5;

using control_bench::Gate;

std::vector<Gate> gates_of(const std::vector<SpeedRow>& rows);
bool all_held(const std::vector<SpeedRow>& rows);

std::string to_text(const std::vector<SpeedRow>& rows);
std::string to_json(const std::vector<SpeedRow>& rows);

}  // namespace pitwall::speed_bench
