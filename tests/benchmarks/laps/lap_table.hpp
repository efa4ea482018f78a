// Table, JSON and gates of the lap benchmark: one row per track and perturbation, mean cross-track
// error per speed bracket, the paper's figures below.
//   in     rows of the runs; for each track the nominal one first
//   out    text of fixed width; one JSON object; which gates hold
//   gates  every nominal run completes its laps without contact; every perturbed run ends with a
//          verdict (lapped, or the place where the car left the track or stopped); every
//          perturbation reaches the model (its run is not equal to the nominal run to the last bit)
//   units  m, m/s
//   source the paper's rows: Saba et al., a real car on a real track; not a claim about this one
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/benchmarks/laps/lap_plan.hpp"
#include "tests/benchmarks/laps/lap_run.hpp"

namespace pitwall::laps {

struct Gates {
  bool nominal_laps = true, every_verdict = true, every_perturbation = true;

  bool held() const { return nominal_laps && every_verdict && every_perturbation; }
};

Gates gates_of(const std::vector<LapRow>& rows);

// "lapped", "left the track at s = 512 m at 63.1 m/s, 48.2 s", ...
std::string end_of(const LapRow& row);

std::string to_text(const std::vector<LapRow>& rows);
std::string to_json(const std::vector<LapRow>& rows);

}  // namespace pitwall::laps
