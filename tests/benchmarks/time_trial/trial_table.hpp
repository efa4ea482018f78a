// Table, JSON and gates of the time trial.
//   in     rows of the runs, in any order
//   out    text of fixed width; one JSON object; which gates hold
//   gates  every run but those with little friction in the plant drives kLaps laps without a spin,
//          a contact or a stop; with the car's own friction each has a mean of kMeanLeast_mps;
//          with little friction in the car's file each is slower than all of those
//   units  m, m/s
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "protocol/vocabulary/units.hpp"
#include "tests/benchmarks/time_trial/trial_run.hpp"

namespace pitwall::time_trial {

inline constexpr double kMeanLeast_mph = 168.2;

struct Gates {
  bool clean = true, fast = true, careful = true;

  bool held() const { return clean && fast && careful; }
};

Gates gates_of(const std::vector<TrialRow>& rows);

std::string to_text(const std::vector<TrialRow>& rows);
std::string to_json(const std::vector<TrialRow>& rows);

}  // namespace pitwall::time_trial
