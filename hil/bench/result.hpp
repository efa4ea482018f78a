// What a bench run found: verdicts, cross-track error, laps, traffic, digest of its event log. The
// same for lockstep and live runs.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hil/bench/rig.hpp"
#include "hil/grading/cross_track.hpp"
#include "hil/grading/grader.hpp"

namespace pitwall::bench {

struct Traffic {
  std::uint64_t to_car = 0, from_car = 0;  // frames put on the bus
  std::uint64_t car_received = 0, bench_received = 0;
  std::uint64_t lost = 0;    // sent by one side, never seen by the other
  double bus_load = kUnset;  // share of 500 kbit/s in the last second; unset where unknown
};

struct RunResult {
  std::string scenario, mode;
  double simulated_s = 0.0, wall_s = kUnset;  // wall time only where somebody measured it
  std::vector<grading::Verdict> verdicts;
  grading::CrossTrack cross_track;
  Laps laps;
  Traffic traffic;
  std::uint64_t gate_refusals = 0, bus_refusals = 0;
  std::uint64_t bus_losses =
      0;  // frames that the car missed when they were due (live: late ones too)
  double speed_max_mps = 0.0;
  std::string refused_to_arm;  // why, if at the end the bus was not that of the car; else empty
  std::string digest;

  bool passed() const;
};

// For a person: a table of brackets, laps, traffic, one line per expectation.
std::string to_text(const RunResult& result);
// The same as one JSON object.
std::string to_json(const RunResult& result);

}  // namespace pitwall::bench
