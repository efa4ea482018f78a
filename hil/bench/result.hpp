// Result of a bench run, lockstep or live: verdicts, cross-track error, laps, traffic, outcome,
// digest of the event log.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hil/bench/outcome.hpp"
#include "hil/bench/rig.hpp"
#include "hil/grading/cross_track.hpp"
#include "hil/grading/grader.hpp"
#include "hil/nodes/match_sheet.hpp"
#include "protocol/transport/bench_clock/clock_waits.hpp"

namespace pitwall::bench {

// An action that was carried out, with its time, for the event log and the result.
struct CompletedAction {
  Instant at{};
  std::string what;
};

struct Traffic {
  std::uint64_t to_car = 0, from_car = 0;  // frames put on the bus
  std::uint64_t car_received = 0, bench_received = 0;
  std::uint64_t lost = 0;    // sent by one side, never received by the other
  double bus_load = kUnset;  // share of 500 kbit/s in the last second; NaN if unknown
};

// Timing of a live run: of the bench's wake-ups and of the car's steps.
struct RealTime {
  static constexpr double kWakeBin_us = 10.0;  // width of one bin of wake_late
  static constexpr std::size_t kWakeBins = 200;

  double wake_late_p50_us = kUnset, wake_late_p99_us = kUnset, wake_late_max_us = kUnset;
  std::uint64_t caught_up_wakes = 0;  // began at least one period late
  Duration behind_max{};              // largest lateness, of any cause
  Instant behind_at{};                // its scenario time
  // pauses of bench time; nullopt: a run by the wall clock
  std::optional<transport::ClockWaits> waits;
  double stolen_ms = kUnset;  // time of all processors that the host of the virtual machine took
  std::vector<std::uint64_t> wake_late;  // the last bin holds all larger values
  // Of the car.
  double step_p50_us = kUnset, step_p99_us = kUnset, step_max_us = kUnset;
  std::uint64_t ticks = 0, missed_deadlines = 0;
  bool is_slowed = false;  // a fault of the scenario stops its process

  // Share of its ticks that the car missed by no fault of the scenario; 0 if unknown.
  double missed_share() const;
  static constexpr double kMissedShareMax = 0.01;
};

// Clouds or images that a live bench published for its car.
struct SensorFeed {
  std::uint64_t sent = 0, refused = 0;  // refused: DDS took them not
  std::uint64_t skipped = 0;            // times of all sensors for which none was made
  double late_p50_ms = kUnset, late_p99_ms = kUnset, late_max_ms = kUnset;  // after their time
};

struct RunResult {
  std::string scenario, mode;
  std::string car{};                          // name of another car than ours
  double simulated_s = 0.0, wall_s = kUnset;  // wall time: NaN if not measured
  std::vector<grading::Verdict> verdicts;
  grading::CrossTrack cross_track;
  Laps laps;
  Traffic traffic;
  std::uint64_t gate_refusals = 0, bus_refusals = 0;
  std::uint64_t bus_losses = 0;  // frames not received when due (live: also late ones)
  // Frames of detections that never reached the car's loop: lost on the way, no room, or no process
  // that waited.
  std::uint64_t detections_lost = 0;
  // Of LiDARs that are run ray by ray, else 0: sweeps on the map's ground, and on that of a cloth.
  std::uint64_t sweeps_on_map = 0, sweeps_by_cloth = 0;
  std::uint64_t images = 0;  // rendered, in which the car looked
  std::optional<SensorFeed> clouds, live_images;
  double speed_max_mps = 0.0;
  Outcome outcome;
  std::size_t other_cars = 0;             // on the track
  std::optional<CarContact> car_contact;  // the first one
  std::optional<race::MatchSheet> match;  // of a scenario with one
  std::optional<RealTime> real_time;
  std::string refused_to_arm;  // reason, if the bus did not match the car at the end; else empty
  std::vector<CompletedAction> done;  // faults on processes, clock and disk that were carried out
  std::vector<std::string> remarks;   // further notes, e.g. that the log has a gap
  std::string digest;
  std::vector<RunResult> others;  // of the other cars with a stack; each of these has none

  // Of all cars with a stack.
  bool passed() const;
  // True for a contact with a wall that the scenario does not expect, or a harder one, and for one
  // with another car that the car caused; of any car with a stack.
  bool failed_by_contact() const;
  // True if the bench kept up with its clock. A bench that was late by more than kBehindMax gave
  // the car a bus without frames, and the car may fail without a fault of its own.
  static constexpr Duration kBehindMax = milliseconds(40);
  bool timely() const { return !real_time || real_time->behind_max <= kBehindMax; }
  // Why the run has judged nothing, one sentence each: a bench that was late, if something failed;
  // a car that missed more than kMissedShareMax of its ticks, even if nothing failed.
  std::vector<std::string> not_judged() const;
};

// The result of our car with those of the other cars with a stack, whose names follow in order.
RunResult with_others(std::vector<RunResult> cars, std::span<const std::string> names);

// How late the bench was, in one sentence.
std::string late_text(const RealTime& time);
// Text report: a table of brackets, laps, traffic, one line per expectation.
std::string to_text(const RunResult& result);
std::string to_json(const CarContact& contact);
std::string to_json(const Outcome& outcome);
// One verdict as a JSON object; a missing number is null.
std::string to_json(const grading::Verdict& verdict);
// The whole result as one JSON object.
std::string to_json(const RunResult& result);

}  // namespace pitwall::bench
