// Run of one car in a time trial: alone on the track, as fast as its plan lets it.
//   in     scenario of the trial, the car as prepared for it
//   out    TrialRow, computed from the true state of the plant, up to a contact
//   invariants
//          the mean is that of consecutive laps, the length of the track's reference line over
//          their time, from the second flying lap on: the first one begins from the launch
//   units  m, m/s, s of scenario time
//   errors Problem of the scenario; a bad run is not an error but a row
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "hil/scenario/scenario.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::time_trial {

inline constexpr std::uint32_t kLaps = 10;

struct TrialRow {
  std::string name;
  std::uint64_t seed = 0;
  std::uint32_t laps = 0;  // that count, at most kLaps
  double mean_mps = kUnset, best_s = kUnset, worst_s = kUnset;
  double planned_s = kUnset;  // lap of the line, on warm tyres
  double speed_max_mps = 0.0;
  double slip_max_deg = 0.0;       // between heading and motion, above 10 m/s
  double cross_track_max_m = 0.0;  // from the line
  double wall_gap_m = 1e9;         // least
  bool contact = false, stopped = false;

  bool spun() const;
  bool is_clean() const { return laps == kLaps && !contact && !stopped && !spun(); }
};

Result<TrialRow, Problem> run_trial(const scenario::Scenario& scenario,
                                    const pipeline::Setup& setup);

}  // namespace pitwall::time_trial
