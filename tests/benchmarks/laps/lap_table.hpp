// The lap bench for a person and for a program: one row per track and perturbation, mean
// cross-track error per speed bracket, the paper's figures below, and the gates.
//   in     rows as the bench drove them, for each track the nominal one first
//   out    text of fixed width; one JSON object; which gates hold
//   gates  every nominal run laps its track without contact; every perturbed run ended with a
//          verdict (lapped, or the place where it left or stopped); every perturbation reached the
//          model (its run is not the nominal run to the last bit)
//   units  m, m/s
//   source the paper's rows: Saba et al., a real car on a real track; not a claim about this one
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/benchmarks/laps/lap_run.hpp"

namespace pitwall::laps {

struct Gates {
  bool nominal_laps = true, every_verdict = true, every_perturbation = true;

  bool held() const { return nominal_laps && every_verdict && every_perturbation; }
};

inline constexpr const char* kNominal = "nominal";

Gates gates_of(const std::vector<LapRow>& rows);

// "lapped", "left the track at s = 512 m at 63.1 m/s, 48.2 s", ...
std::string end_of(const LapRow& row);

std::string to_text(const std::vector<LapRow>& rows);
std::string to_json(const std::vector<LapRow>& rows);

}  // namespace pitwall::laps
