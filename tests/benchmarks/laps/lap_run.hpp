// Run of one car on one track, until it has driven its laps, stopped, or touched a wall: one row of
// the lap benchmark.
//   in     scenario of flying laps with its perturbations, the car as prepared for the track
//   out    LapRow: figures up to the end of the run or up to the contact; after a contact the model
//          is not valid
//   invariants
//          lapped: at least two flying laps, no contact, no stop before race control's red flag
//   units  m, m/s, s of scenario time
//   errors Problem of the scenario; a bad run is not an error but a row
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "hil/grading/cross_track.hpp"
#include "hil/scenario/scenario.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::laps {

enum class Outcome : std::uint8_t {
  kUnfinished,  // the car drove, but the time was over before its laps were complete: no verdict
  kLapped,
  kContact,  // a corner of the car met a wall
  kStopped   // the car's own supervisor stopped it
};

struct LapRow {
  std::string track, perturbation;
  Outcome outcome = Outcome::kUnfinished;
  std::uint32_t laps = 0, flying = 0;
  double flying_mean_mps = kUnset;  // over all flying laps
  double speed_max_mps = 0.0;
  double slip_max_rad = 0.0;  // side slip of the body above 10 m/s
  grading::CrossTrack cross_track;
  // At the contact, or at the beginning of the stop.
  double at_s = kUnset, station_m = kUnset, speed_mps = kUnset;
  std::string cause;  // of a stop, as the supervisor reports it
};

Result<LapRow, Problem> run_laps(const scenario::Scenario& scenario, const pipeline::Setup& setup);

// True if two runs are equal to the last bit: then the perturbation did not reach the model.
bool same_run(const LapRow& a, const LapRow& b);

}  // namespace pitwall::laps
