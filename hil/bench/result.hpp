// Result of a bench run: verdicts, cross-track error, laps, traffic, digest of its event log. The
// same for lockstep and live runs.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hil/bench/outcome.hpp"
#include "hil/bench/process_script.hpp"
#include "hil/bench/rig.hpp"
#include "hil/grading/cross_track.hpp"
#include "hil/grading/grader.hpp"
#include "protocol/transport/bench_clock/clock_waits.hpp"

namespace pitwall::bench {

struct Traffic {
  std::uint64_t to_car = 0, from_car = 0;  // frames put on the bus
  std::uint64_t car_received = 0, bench_received = 0;
  std::uint64_t lost = 0;    // sent by one side, never seen by the other
  double bus_load = kUnset;  // share of 500 kbit/s in the last second; unset where unknown
};

// Of a live run: how punctual the bench was, and how long the car took.
struct RealTime {
  static constexpr double kWakeBin_us = 10.0;  // width of one bin of wake_late
  static constexpr std::size_t kWakeBins = 200;

  double wake_late_p50_us = kUnset, wake_late_p99_us = kUnset, wake_late_max_us = kUnset;
  std::uint64_t caught_up_wakes = 0;           // began more than one wake-up late
  Duration behind_max{};                       // farthest behind its clock, whoever was to blame
  Instant behind_at{};                         // when that was, on the scenario's clock
  std::optional<transport::ClockWaits> waits;  // of bench time; none: a run by the wall clock
  double stolen_ms = kUnset;             // of all processors' time, by the virtual machine's host
  std::vector<std::uint64_t> wake_late;  // the last bin holds all later ones
  double step_p50_us = kUnset, step_p99_us = kUnset, step_max_us = kUnset;  // of the car
  std::uint64_t missed_deadlines = 0;                                       // of the car
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
  Outcome outcome;
  std::optional<RealTime> real_time;
  std::string refused_to_arm;  // why, if at the end the bus was not that of the car; else empty
  std::vector<Done> done;      // to processes, clock and disk: faults that were carried out
  std::vector<std::string> remarks;  // what else a reader must know, e.g. that the log has a gap
  std::string digest;

  bool passed() const;
  // A contact that the scenario does not name, or a harder one.
  bool failed_by_contact() const;
  // The bench kept up with its clock. One that stood still for longer than this was a bus without
  // frames for the car, which may then fail for no fault of its own.
  static constexpr Duration kBehindMax = milliseconds(40);
  bool timely() const { return !real_time || real_time->behind_max <= kBehindMax; }
};

// For a person: a table of brackets, laps, traffic, one line per expectation.
std::string to_text(const RunResult& result);
std::string to_json(const Outcome& outcome);
// One verdict as a JSON object; null for a number that there is none of.
std::string to_json(const grading::Verdict& verdict);
// The same as one JSON object.
std::string to_json(const RunResult& result);

}  // namespace pitwall::bench
